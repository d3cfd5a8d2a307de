// Index cube shadow mapping with register combiners, after Ron Frazier's article.
#pragma once

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/shadow/technique.h"

namespace NINEBIT_PUBLIC ninebit {

// Two general combiners and the final combiner, set through the entry points of gl_nv.h: alpha is 0 where the primary
// colour and texture 0 agree in all channels of the format, and above 0 where the combiners resolve a difference. For
// rgb these are the article's calls. Luminance-alpha takes the difference of the luminances in stage 0's RGB portion
// and that of the alphas in its alpha portion, and sums both squares in stage 1's alpha portion; one channel is
// compared in the alpha portions alone. `scales` leaves out a scale by four. Reports a profile that refuses a call.
[[nodiscard]] Result<CombinerState> index_comparison_state(const HardwareProfile& profile,
                                                           IndexFormat format = IndexFormat::rgb,
                                                           IndexScales scales = IndexScales::both);

// The pipeline state of each pass, in the order of drawing.
struct IndexCubePasses {
  PipelineState map;         // from the light: indices, depth-tested, into six faces
  PipelineState depth;       // from the camera: depth only
  PipelineState comparison;  // from the camera: stencil 1 where the indices differ
  PipelineState averted;     // from the camera, with light_facing: stencil 1 where a polygon faces away from the light
  PipelineState lit;         // from the camera: colour where the stencil is 0
  PipelineState shadow;      // from the camera: colour where the stencil is not 0
  PipelineState selection;   // from the camera, with pick: indices of the visible surfaces, as colours
};

// The passes for these settings. Reports what index_comparison_state reports.
[[nodiscard]] Result<IndexCubePasses> index_cube_passes(const RenderSettings& settings);

// Draws the scene's shadows in the article's passes:
//   1. six 90° views from the light, every polygon flat in the colour of its index, into a cube map;
//   2. the camera's depth;
//   3. every polygon again with its index as primary colour and the cube map on unit 0, fetched NEAREST along the
//      vector from the light; alpha test GREATER 0, stencil REPLACE 1, depth test EQUAL;
//   4. the lit pass where the stencil is 0, then the shadow pass where it is not.
//
// Facts: `vanished_polygons`, the number of polygons that should be in the map but are too small or too thin to cover
// the centre of any texel; `vanished_texels`, their total area on the faces, in texels; `vanished_pixels`, the camera's
// pixels that show them. With settings.pick, `picked`.
//
// Besides what Technique::render reports, reports more polygons, sections or objects than the format and the step have
// codes for, a section size out of range, and a picked pixel outside of the frame.
[[nodiscard]] Result<Rendering> render_index_cube(const Scene& scene, const RenderSettings& settings,
                                                  const Progress& progress);

}  // namespace ninebit

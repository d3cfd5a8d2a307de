// Shadow maps: the depths that a spot or directional light sees, looked up by each of the camera's fragments.
#pragma once

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/shadow/technique.h"

namespace NINEBIT_PUBLIC ninebit {

// The polygon offset while the map is drawn, unless the settings have one. A fragment lies at most half a texel away
// from the centre of the texel that it looks up, in s and in t: its depth differs by at most (|dz/ds| + |dz/dt|) / 2,
// which the slope m, the larger of the two, covers. Snapping to 1/16 texel turns the polygon by at most another eighth
// of m. The units cover the rounding of the depth code and of r/q, which is interpolated and divided in floats.
inline constexpr OffsetArguments kShadowMapOffset{.factor = 1.125F, .units = 16.0F};

// One general combiner: alpha is 1 where texture 0 (the depth comparison) or texture 1 (the light's beam) has alpha 0,
// and 0 where both have 1. Made with the entry points of gl_nv.h; reports a profile that refuses one of them.
[[nodiscard]] Result<CombinerState> shadow_map_comparison_state(const HardwareProfile& profile);

// The pipeline states of this technique's own passes.
struct ShadowMapPasses {
  PipelineState map;         // from the light: depth only, the nearest stays, with polygon offset
  PipelineState comparison;  // from the camera: stencil 1 where the fragment is farther than the map's depth
  PipelineState coordinate;  // from the camera, for packed depths: no alpha or stencil test, for output planes
  PipelineState averted;     // from the camera, with light_facing: stencil 1 where a polygon faces away from the light
};

// The passes for these settings. Reports what shadow_map_comparison_state reports.
[[nodiscard]] Result<ShadowMapPasses> shadow_map_passes(const RenderSettings& settings);

// Draws the scene's shadows with a shadow map of map_size² texels over the light's beam: the square pyramid of a spot
// light's opening angle, or a parallel beam around the whole scene. Outside the beam and behind a spot light there is
// no light.
//   1. the depth from the light, with polygon offset;
//   2. the camera's depth;
//   3. every polygon again, each fragment compared with the map's depth at (s/q, t/q), stencil REPLACE 1 where its r/q
//      is farther: for d24 and d16 a depth texture with comparison (ARB_shadow) on unit 0 and the beam as a cube map on
//      unit 1; for packed depths in floats, fragment by fragment, beyond the combiners;
//   4. the lit pass where the stencil is 0, then the shadow pass where it is 1.
// The map goes into Rendering::maps as shadow_map (channel depth: codes, with the offset) and, packed, as packed_depth
// (R G B A); the picture is shadow_map.png. Facts: polygon_offset_factor, polygon_offset_units; texel_size and
// depth_step, in world units across and along the light's axis at the middle of the scene's bounding box; with d24 and
// d16 texture_units, the number that the comparison reads; with packed depths encoding_error, the largest change of a
// depth in the map by packing it, in the range [0, 1].
[[nodiscard]] Result<Rendering> render_shadow_map(const Scene& scene, const RenderSettings& settings,
                                                  const Progress& progress);

}  // namespace ninebit

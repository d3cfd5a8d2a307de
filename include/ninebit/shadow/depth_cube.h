// Depth cube shadow mapping: the distance to the light in a cube map, compared by the register combiners.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/shadow/technique.h"

namespace NINEBIT_PUBLIC ninebit {

// How a distance is encoded as the luminance, or as the high and the low byte, of a texel: by a ramp, a texture whose
// texel i holds the code of the i-th equal part of the range. Codes and bias are whole numbers of ramp texels, so only
// the ramp decides the result.
struct DistanceCode {
  float low = 0.0F;          // world units: the distance at which the ramp begins
  float high = 1.0F;         // world units: the distance at which the ramp ends
  int code_bits = 8;         // 8 or 16
  int ramp_bits = 11;        // the ramp has 2^ramp_bits texels; not fewer than codes
  std::uint32_t offset = 0;  // ramp texels by which the camera's ramp lags behind that of the map: the bias

  // Texels of the ramp.
  [[nodiscard]] std::uint32_t ramp_size() const { return std::uint32_t{1} << ramp_bits; }
  // World units per ramp texel, and per code.
  [[nodiscard]] double ramp_step() const { return (double{high} - double{low}) / ramp_size(); }
  [[nodiscard]] double code_step() const { return ramp_step() * (1 << (ramp_bits - code_bits)); }
  // The bias in world units.
  [[nodiscard]] double bias() const { return offset * ramp_step(); }

  // The code in texel i of the map's ramp, and of the camera's.
  [[nodiscard]] std::uint32_t map_code(std::uint32_t i) const { return i >> (ramp_bits - code_bits); }
  [[nodiscard]] std::uint32_t camera_code(std::uint32_t i) const { return i < offset ? 0 : map_code(i - offset); }
};

// The code for a scene around its light. settings.depth_cube.bits is eight or sixteen, since `real` has no code. A bias
// in the settings is rounded up to whole texels of the ramp; without one, default_depth_cube_bias is used. That is
// three texels of the map, at their width at the far end of the range.
[[nodiscard]] DistanceCode distance_code(const Scene& scene, const RenderSettings& settings);
[[nodiscard]] float default_depth_cube_bias(const Scene& scene, const RenderSettings& settings);

// The combiners' set-ups, set call for call through the entry points of gl_nv.h. Texture 0 is the ramp, texture 1 the
// cube map; alpha is above 0 where the function's comparison is true. Each reports a profile that refuses a call.
[[nodiscard]] Result<CombinerState> ramp_copy_state(const HardwareProfile& profile);        // colour = texture 0
[[nodiscard]] Result<CombinerState> luminance_above_state(const HardwareProfile& profile);  // L0 > L1
[[nodiscard]] Result<CombinerState> high_byte_above_state(const HardwareProfile& profile);  // A0 > A1
// A0 >= A1 and L0 > L1: the mux of NVIDIA's 16-bit comparison.
[[nodiscard]] Result<CombinerState> low_byte_above_state(const HardwareProfile& profile);

// A pass that marks shadow, drawn once for each face of the cube map.
struct DepthCubeComparison {
  std::string name;     // "comparison"; with 16 bits "high byte", then "low byte"
  PipelineState state;  // changes only the stencil plane
};

// The pipeline state of each pass, in the order of drawing.
struct DepthCubePasses {
  PipelineState map;    // from the light: distances, depth-tested, into a face
  PipelineState depth;  // from the camera: depth only
  // From the camera: stencil 1 behind the map's distance; none for floats.
  std::vector<DepthCubeComparison> comparisons;
  PipelineState averted;  // from the camera, with light_facing: stencil 1 where a polygon faces away from the light
};

// The passes for these settings. Reports what the combiners' states report.
[[nodiscard]] Result<DepthCubePasses> depth_cube_passes(const RenderSettings& settings);

// Draws the scene's shadows. The distance is the planar one of a cube face, the largest of |x|, |y|, |z| from the
// light, because it is linear on a polygon within a face:
//   1. six 90° views from the light, every polygon textured with the ramp, into a cube map;
//   2. the camera's depth;
//   3. for each face of the map, every polygon again: the camera's ramp on unit 0 along this face's axis, on unit 1 a
//      cube map with only this face; its other faces hold the farthest code, which nothing is behind; alpha test
//      GREATER 0, stencil REPLACE 1, depth test EQUAL; with 16 bits once for the high and once for the low byte;
//   4. the lit pass where the stencil is 0, then the shadow pass where it is 1.
// With floats, step 3 compares interpolated planes in C++, because no combiner holds that many bits.
// Besides what Technique::render reports, reports a bias that is negative or not finite.
[[nodiscard]] Result<Rendering> render_depth_cube(const Scene& scene, const RenderSettings& settings,
                                                  const Progress& progress);

}  // namespace ninebit

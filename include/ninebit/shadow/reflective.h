// Reflective shadow maps: one bounce of diffuse light, gathered from what the light sees, after Dachsbacher and
// Stamminger (2005) and a text that follows them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ninebit/numerics/half.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/shadow/technique.h"

namespace NINEBIT_PUBLIC ninebit {

// The factor on the scene's light colour in the flux: the value of a white light.
inline constexpr float kFluxOfWhiteLight = 0.3F;
// The largest map, in texels a side.
inline constexpr int kMaxReflectiveMapSize = 8192;

// The surface that the light sees at each texel, rows from t = 0 (the lowest). Texels without a surface hold zeros and
// the farthest depth.
struct ReflectiveMap {
  int size = 0;                                 // texels a side
  glm::mat4 clip_from_world{1.0F};              // of the light
  std::array<std::vector<Half>, 3> position{};  // x, y, z in world space
  std::array<std::vector<Half>, 3> normal{};    // x, y, z in world space, interpolated, then unit length
  std::array<std::vector<Half>, 3> flux{};      // base colour × light colour × kFluxOfWhiteLight: no cosine
  std::vector<std::uint32_t> depth{};           // codes of 24 bits
};

// Reports a map size that is not a power of two or is above kMaxReflectiveMapSize, and scenes with a coordinate beyond
// 65,504, the largest half float.
[[nodiscard]] Status check_reflective_map(const Scene& scene, int map_size);

// The pipeline state of the map's one pass: nearest depth, no polygon offset.
[[nodiscard]] PipelineState reflective_map_pass(const RenderSettings& settings);

// Draws the map of settings.map_size from the scene's first light, which is a spot or a directional light. Reports what
// check_reflective_map reports.
[[nodiscard]] Result<ReflectiveMap> draw_reflective_map(const Scene& scene, const RenderSettings& settings);

// The world positions of all texels, computed in doubles from the depth and the inverse of clip_from_world; the origin
// where there is no surface.
[[nodiscard]] std::vector<glm::dvec3> positions_from_depth(const ReflectiveMap& map);

// Draws the direct light and its shadows as render_shadow_map does, from a depth map of the same view with polygon
// offset, and adds the light of one diffuse bounce, without occlusion:
//   E(x, n) = sum over samples p of w_p Φ_p max(0, n_p · (x - x_p)) max(0, n · (x_p - x)) / |x - x_p|^4
// The picture is the direct light plus base colour × E, with E clamped to [0, 1]. settings.reflective.pattern selects
// the samples:
//   poisson  a Poisson disk rotated at each pixel; w_p is the square of the rotated offset's x in the unit disk,
//            Φ_p the map's flux; lengths are in world units; not normalised
//   polar    radius ξ1 and angle ξ2, w_p = ξ1², normalised so that a constant field gives the sum over all texels in
//            the kernel; Φ_p is the map's flux scaled to the light that a texel's beam carries in the direct passes
//
// Outputs besides those of render_shadow_map:
//   pictures  direct.png, indirect.png (E), difference.png (the picture minus direct.png)
//   layers    surface_position, surface_normal, surface_color, direct, indirect
//   maps      rsm_position, rsm_normal, rsm_flux, rsm_depth
//   facts     pixel_lights (texels that hold a surface), gathered_pixels, interpolated_pixels; with settings.evidence
//             indirect_reference_pixels, indirect_reference_mean, indirect_mean_error and indirect_max_error (E against
//             the sum over the whole map, on a coarse grid of pixels, before clamping), and position_max_difference
//             (between the map's positions and those computed from its depth)
//
// Reports what render_shadow_map and check_reflective_map report, and samples, kernel or gather_scale out of range.
[[nodiscard]] Result<Rendering> render_reflective(const Scene& scene, const RenderSettings& settings,
                                                  const Progress& progress);

}  // namespace ninebit

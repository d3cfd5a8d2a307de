// The light of all texels, of which reflective shadow maps gather samples.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ninebit/numerics/result.h"
#include "src/shadow/reflective/indirect_light.h"

namespace ninebit {

// The irradiance that all pixel lights together give a point with a normal of unit length, in doubles, without
// occlusion: the gathering of gather_pattern.h over the whole map, each texel once with weight 1.
[[nodiscard]] glm::dvec3 whole_map_irradiance(const PixelLights& lights, const glm::dvec3& position,
                                              const glm::dvec3& normal);

// The difference between the gathered light and the whole map's, over pixels of a coarse grid and their three colours.
struct IndirectError {
  std::uint64_t pixels = 0;
  double reference_mean = 0.0;  // of the whole map's irradiance, in the pattern's scale
  double mean = 0.0;            // of the absolute differences
  double max = 0.0;
};

// Compares at up to kReferenceColumns × kReferenceRows of the drawn pixels.
inline constexpr int kReferenceColumns = 16, kReferenceRows = 12;
[[nodiscard]] Result<IndirectError> indirect_error(const PixelLights& lights, const VisibleSurface& surface,
                                                   const std::vector<bool>& drawn, const IndirectLight& indirect,
                                                   const Continue& go_on);

}  // namespace ninebit

// Level of detail (OpenGL 1.3, 3.8.8): how many texels a pixel covers, and which levels are read.
#pragma once

#include <array>
#include <string>

#include "ninebit/raster/sampler.h"

namespace ninebit {

// lambda in 1/256: log2(rho_squared) / 2, rounded down, as sampler.h says; kNoTexels where rho is 0, kAllTexels where
// it is infinite. Both leave room for a bias.
inline constexpr int kNoTexels = -(1 << 20);
inline constexpr int kAllTexels = 1 << 20;
[[nodiscard]] int level_of_detail_q8(double rho_squared);

// rho² from the changes of s, t and, in 3D textures, r, in texels.
struct TexelChanges {
  double ux = 0, vx = 0, uy = 0, vy = 0, wx = 0, wy = 0;
};
[[nodiscard]] double rho_squared(const TexelChanges& changes);

// The changes of (s, t) on the face that the direction selects, from those of the direction; without the sizes.
[[nodiscard]] TexelChanges cube_changes(const std::array<float, 3>& r, const std::array<float, 3>& dx,
                                        const std::array<float, 3>& dy);

// The largest lambda in 1/256 at which a texture is magnified (OpenGL 1.3, 3.8.10).
[[nodiscard]] int magnification_ends_q8(MinFilter min_filter, MagFilter mag_filter);

// The levels that a filter reads: one, or two with a weight between them.
struct LevelChoice {
  int level = 0;
  bool linear = false;      // within a level
  int between_q8 = 0;       // weight of level + 1 in 1/256
  bool two_levels = false;  // the filter is one that weighs two levels, even if between_q8 is 0
};
[[nodiscard]] LevelChoice choose_level(MinFilter min_filter, MagFilter mag_filter, int lambda_q8, int last_level);

[[nodiscard]] constexpr bool uses_mipmaps(MinFilter filter) {
  return filter != MinFilter::nearest && filter != MinFilter::linear;
}
// Whether the minifying filter is linear within a level.
[[nodiscard]] constexpr bool is_linear(MinFilter filter) {
  return filter == MinFilter::linear || filter == MinFilter::linear_mipmap_nearest ||
         filter == MinFilter::linear_mipmap_linear;
}

// Why is_complete() is false, as a part of a sentence: "it has no level 0"; empty if it is true.
[[nodiscard]] std::string why_incomplete(const Texture& texture, bool with_mipmaps);

}  // namespace ninebit

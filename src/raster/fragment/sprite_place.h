// Texture coordinates that run across points (rule 46).
#pragma once

#include <array>
#include <cstddef>

#include "ninebit/raster/pipeline_state.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// The coordinates of a pixel's centre across its point.
struct SpritePlace {
  float s, t;
};

// Their change from pixel to pixel: of s in x, of t downwards.
[[nodiscard]] inline float sprite_change(int eighths) {
  return eighths == 0 ? 0.0F : 16.0F / static_cast<float>(2 * eighths);
}

// A point of size 0 has one pixel, the middle of the texture (assumed).
[[nodiscard]] inline SpritePlace sprite_place(const SetupPrimitive& point, int eighths, int x, int y) {
  if (eighths == 0) return {0.5F, 0.5F};
  // In sixteenths of a pixel half the size is `eighths`.
  const int from_left = 16 * x + 8 - (point.x_q4()[0] - eighths), from_top = point.y_q4()[0] + eighths - (16 * y + 8);
  const auto size = static_cast<float>(2 * eighths);
  return {static_cast<float>(from_left) / size, static_cast<float>(from_top) / size};
}

// s, t, r, q; their changes in x; and in y.
[[nodiscard]] inline std::array<std::array<float, 4>, 3> sprite_coordinates(const SpritePlace& at, float change) {
  return {{{at.s, at.t, 0.0F, 1.0F}, {change, 0.0F, 0.0F, 0.0F}, {0.0F, -change, 0.0F, 0.0F}}};
}

// Whether a unit's coordinates run across points.
[[nodiscard]] inline bool has_sprites(const PipelineState& state, std::size_t unit) {
  return state.point_sprite.enabled && state.point_sprite.coord_replace[unit];
}

}  // namespace ninebit

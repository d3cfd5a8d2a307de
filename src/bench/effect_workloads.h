// Effects of the gallery on a rectangle, and the same in GLSL.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "ninebit/effect/effect_renderer.h"

namespace ninebit::bench {

// An effect of one pass. Every texture is a picture of kEffectTexels texels a side.
struct EffectWorkload {
  std::string name;      // of the gallery's effect
  Effect effect{};       // units 0 and 1 have the textures of the same number
  std::string fragment;  // of GLSL 3.30: reads `uv`, tex0 and tex1, writes `color`
};
inline constexpr int kEffectTexels = 256;

// The measured effects: sepia reads one nearest texel, emboss twice four, light_map_detail twice eight (trilinear).
[[nodiscard]] std::vector<EffectWorkload> effect_workloads(int width, int height);

// The texels of a texture of an effect: red, green, blue, alpha, the first row at t = 0.
[[nodiscard]] std::vector<std::uint8_t> effect_texels(std::size_t number);

// Readers of the workloads' programs and textures, which are not files.
[[nodiscard]] EffectReaders workload_readers();

}  // namespace ninebit::bench

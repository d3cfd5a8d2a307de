// A slow and naive model of texture sampling. Its only job is to judge the library's.
//
// It is written from chapter 3.8 of the OpenGL 1.3 and 1.4 specifications, from ARB_texture_cube_map and ARB_shadow,
// from what pictures of an NV2A show of border texels and colour keys, and from the choices that sampler.h documents,
// and shares no code with what it judges: of the library's headers it includes those of plain data, for the texture and
// the sampler as the question. Coordinates and weights are exact fractions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ninebit/raster/sampler.h"

namespace ninebit::oracle {

struct TextureQuestion {
  int weight_bits = 8;        // profile.texture_weight_bits
  bool cuts_weights = false;  // profile.texture_weight_narrowing is toward zero
  bool rounds_each = false;   // profile.texture_filter_rounding: each blend
  bool cuts_bias = false;     // profile.texture_bias_narrowing is toward zero
  const Texture* texture = nullptr;
  Sampler sampler;
  std::array<float, 3> coordinate{};  // s, t, r
  std::array<float, 3> dx{};
  std::array<float, 3> dy{};
};

struct TextureAnswer {
  // Bytes of a texel, as Texel::value has them, and the alpha that RGB does not store; of float formats see `real`.
  std::array<std::uint8_t, 4> value{};
  std::array<std::uint32_t, 4> code{};     // before depth became a byte
  std::array<long double, 4> real{};       // of float formats: the weighted sum
  std::array<long double, 4> magnitude{};  // and the same sum of absolute values, to judge its rounding
  bool border = false;                     // whether the border took part
  bool killed = false;                     // by the colour key
  int level = 0;                           // the finer level that was read
};

// The possible answers: one, or two where the level of detail lies so near to a step of 1/256 that only exact
// arithmetic beyond this model's could tell on which side; none where the texture is incomplete.
[[nodiscard]] std::vector<TextureAnswer> sample(const TextureQuestion& question);

}  // namespace ninebit::oracle

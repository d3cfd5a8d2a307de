// Random stages for texts that are emitted for them, and textures that both texts and evaluators read.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "combiner_tests/support/random.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/evaluate_stages.h"
#include "ninebit/texture_shader/stage_program.h"

namespace ninebit::test {

inline constexpr int kStageOperations = static_cast<int>(TextureOperation::brdf);

// The textures: bytes from coordinates. Equal where the floats are.
inline Bytes4 texel_of(const std::array<float, 3>& at, int unit) {
  constexpr unsigned kOfNan = 0x80000000U;  // as processors convert it
  std::array<unsigned, 3> n{};
  for (std::size_t k = 0; k < 3; ++k) {
    const float scaled = std::floor(std::clamp(at[k], -64.0F, 64.0F) * 512.0F);
    n[k] = std::isnan(at[k]) ? kOfNan : static_cast<unsigned>(static_cast<int>(scaled));
  }
  const unsigned h = n[0] * 73 + n[1] * 151 + n[2] * 283 + static_cast<unsigned>(unit) * 31;
  return {static_cast<std::uint8_t>(h & 255), static_cast<std::uint8_t>((h * 3 + 1) & 255),
          static_cast<std::uint8_t>((h * 7 + 2) & 255), static_cast<std::uint8_t>((h * 13 + 5) & 255)};
}

// Numbers and choices of a stage.
inline TextureStage random_stage(Random& random, int place, TextureOperation operation) {
  TextureStage stage{.operation = operation};
  stage.previous = place == 0 || random.one_in(2) ? 0 : random.below(place);
  do {
    stage.mapping = static_cast<DotMapping>(random.below(8));
  } while (stage.mapping == DotMapping::hilo_hemisphere_d3d || stage.mapping == DotMapping::hilo_hemisphere_gl);
  for (CullMode& mode : stage.cull) mode = random.pick({CullMode::kills_negative, CullMode::kills_not_negative});
  for (float& entry : stage.matrix) entry = random.real_f(-2, 2);
  stage.scale = random.real_f(-2, 3);
  stage.bias = random.real_f(-1, 1);
  for (float& e : stage.eye) e = random.real_f(-1, 1);
  return stage;
}

// Stages with the wanted operation, after what it needs; the others are texture reads, or anything that may stand
// there.
inline std::array<TextureStage, kTextureStages> random_stages(Random& random, TextureOperation wanted) {
  const TextureOperationInfo& info = info_of(wanted);
  const int place = random.between(info.first, info.last);
  std::array<TextureStage, kTextureStages> stages;
  for (int i = 0; i < kTextureStages; ++i) {
    auto operation = random.pick({TextureOperation::texture_2d, TextureOperation::pass_through,
                                  TextureOperation::cull_fragment, TextureOperation::texture_cube_map});
    if (i == 0) operation = TextureOperation::texture_2d;
    if (i < place && i >= place - info.dots_before) operation = TextureOperation::dot_product;
    if (i == place) operation = wanted;
    if (i == 3 && wanted == TextureOperation::dot_product_diffuse_cube_map) {
      operation = random.pick(
          {TextureOperation::dot_product_reflect_cube_map, TextureOperation::dot_product_const_eye_reflect_cube_map});
    }
    stages[static_cast<std::size_t>(i)] = random_stage(random, i, operation);
    if (i <= place || i == 3) stages[static_cast<std::size_t>(i)].previous = 0;
  }
  return stages;
}

struct StageCase {
  HardwareProfile profile = profiles::nv2a;
  TextureShaderState state{.enabled = true, .rules = StageRules::nv2a};
  StageTextures textures;
};

inline StageCase random_stage_case(Random& random, TextureOperation wanted) {
  StageCase c;
  c.state.stage = random_stages(random, wanted);
  c.state.converts_yuv = random.one_in(6);
  c.state.depth_unit = DepthUnit::codes;
  if (random.one_in(3)) {
    c.state.rules = StageRules::open_gl;
    c.state.converts_yuv = false;
  }
  if (random.one_in(2)) c.profile.stage_byte.value = StageByte::nearest;
  if (random.one_in(2)) {
    c.profile.dot_divisors.value = DotDivisors::even;
    c.profile.negative_stage_number.value = NegativeNumber::size;
  }
  if (random.one_in(2)) {
    c.profile.dependent_divisor.value = 256;
    c.profile.cull_zero.value = CullZero::by_sign;
  }
  if (random.one_in(3)) {
    c.profile.byte_shift.value = 3;
    c.profile.one.value = 31;
    c.profile.lowest.value = -32;
  }
  for (std::size_t i = 0; i < c.textures.size(); ++i) {
    StageTexture texture{.target = info_of(c.state.stage[i].operation).target};
    if (random.one_in(3)) texture.is_signed = {random.one_in(2), random.one_in(2), random.one_in(2), random.one_in(2)};
    if (c.state.rules == StageRules::open_gl) {
      const StageInput input = info_of(wanted).input;
      const bool is_offset = input == StageInput::offset || input == StageInput::luminance;
      if (is_offset) texture.is_signed = {};
      if (i == 0 && is_offset) texture.format = TextureFormat::dsdt_mag;
      if (i == 0 && input == StageInput::normal && random.one_in(2)) texture.format = TextureFormat::hilo;
    }
    c.textures[i] = texture;
  }
  return c;
}

}  // namespace ninebit::test

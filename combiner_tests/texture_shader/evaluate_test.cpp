// Stages without textures' arithmetic: the rules at their edges, NaN and infinity.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/evaluate_stages.h"

namespace ninebit::test {
namespace {

using Op = TextureOperation;
constexpr float kNotANumber = std::numeric_limits<float>::quiet_NaN(),
                kInfinite = std::numeric_limits<float>::infinity();

TextureShaderResult run(const TextureShaderState& state, const StageCoordinates& at, const Bytes4& texel,
                        const HardwareProfile& profile = profiles::nv2a) {
  StageTextures textures;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    textures[i] = StageTexture{.target = info_of(state.stage[i].operation).target};
  }
  const auto program = compile(state, textures, profile);
  EXPECT_TRUE(program.ok());
  return evaluate(*program, profile, {at, at, at}, [&](int, const TexturePlace&) { return texel; });
}

TextureShaderState nv2a_state(Op zero, Op one = Op::none, Op two = Op::none) {
  TextureShaderState state;
  state.enabled = true;
  state.rules = StageRules::nv2a;
  state.depth_unit = DepthUnit::codes;
  state.stage[0].operation = zero;
  state.stage[1].operation = one;
  state.stage[2].operation = two;
  return state;
}

// Rule 33.
TEST(TextureShaderEvaluate, PassThroughCutsTwelveBits) {
  const auto bytes = [](const std::array<float, 4>& at, const HardwareProfile& profile) {
    return run(nv2a_state(Op::pass_through), {at}, {}, profile).stage[0].texel;
  };
  EXPECT_EQ(bytes({0.0F, 1.0F, 0.5F, 1.0F / 255.0F}, profiles::nv2a), (Bytes4{0, 255, 127, 1}));
  EXPECT_EQ(bytes({-1.0F, 2.0F, kInfinite, -kInfinite}, profiles::nv2a), (Bytes4{0, 255, 255, 0}));
  EXPECT_EQ(bytes({kNotANumber, -0.0F, 0.996F / 255.0F, 0.9961F}, profiles::nv2a)[0], 0);
  EXPECT_EQ(bytes({0.5F, 0.9F / 255.0F, kNotANumber, 9.0F}, profiles::ideal), (Bytes4{128, 1, 0, 255}));
}

TEST(TextureShaderEvaluate, NanIsNotCulled) {
  TextureShaderState state = nv2a_state(Op::cull_fragment);
  EXPECT_FALSE(run(state, {std::array{kNotANumber, 0.0F, -0.0F, 1.0F}}, {}).is_culled);
  EXPECT_TRUE(run(state, {std::array{0.0F, 0.0F, 0.0F, -1e-30F}}, {}).is_culled);
  state.stage[0].cull.fill(CullMode::kills_not_negative);
  EXPECT_FALSE(run(state, {std::array{kNotANumber, -1.0F, -2.0F, -kInfinite}}, {}).is_culled);
  EXPECT_TRUE(run(state, {std::array{-1.0F, -1.0F, -0.0F, -1.0F}}, {}).is_culled);
}

// Nobody has seen numbers below 0, nor exactly 0 and -0; each has its rival.
TEST(TextureShaderEvaluate, FieldsThatNoPictureDecides) {
  HardwareProfile rival = profiles::nv2a;
  rival.negative_stage_number.value = NegativeNumber::size;
  rival.cull_zero.value = CullZero::by_sign;
  EXPECT_EQ(run(nv2a_state(Op::pass_through), {std::array{-1.0F, -0.5F, 0.5F, -kInfinite}}, {}, rival).stage[0].texel,
            (Bytes4{255, 127, 127, 255}));
  TextureShaderState scaled = nv2a_state(Op::texture_2d, Op::offset_2d_scale);
  scaled.stage[1].scale = 0.0F;
  scaled.stage[1].bias = -1.0F;
  EXPECT_EQ(run(scaled, {}, {10, 20, 30, 40}).stage[1].texel, (Bytes4{0, 0, 0, 40}));
  EXPECT_EQ(run(scaled, {}, {10, 20, 30, 40}, rival).stage[1].texel, (Bytes4{10, 20, 30, 40}));
  for (const CullMode mode : {CullMode::kills_negative, CullMode::kills_not_negative}) {
    TextureShaderState state = nv2a_state(Op::cull_fragment);
    state.stage[0].cull.fill(mode);
    const bool kills_negative = mode == CullMode::kills_negative;
    const auto is_culled = [&](float component, const HardwareProfile& profile) {
      std::array<float, 4> at{};
      at.fill(component);
      return run(state, {at}, {}, profile).is_culled;
    };
    EXPECT_EQ(is_culled(0.0F, rival), !kills_negative);
    EXPECT_EQ(is_culled(-0.0F, rival), kills_negative);
    EXPECT_EQ(is_culled(-0.0F, profiles::nv2a), !kills_negative);
    EXPECT_FALSE(is_culled(kNotANumber, rival));
  }
}

// Rule 39.
TEST(TextureShaderEvaluate, DepthsAreCutAndClamped) {
  const TextureShaderState state = nv2a_state(Op::texture_2d, Op::dot_product, Op::dot_product_depth_replace);
  const auto depth = [&](float numerator, float denominator, bool in_codes = true) {
    TextureShaderState with = state;
    if (!in_codes) with.depth_unit = DepthUnit::window;
    StageTextures textures{StageTexture{}};
    const auto program = compile(with, textures, profiles::nv2a);
    const StageCoordinates at{std::array{0.0F, 0.0F, 0.0F, 1.0F}, std::array{numerator, 0.0F, 0.0F, 1.0F},
                              std::array{denominator, 0.0F, 0.0F, 1.0F}};
    const auto result = evaluate(*program, profiles::nv2a, {at, at, at}, [](int, const TexturePlace&) {
      return Bytes4{255, 0, 0, 0};
    });
    return replaced_depth_code(*program, *result.depth, 0xFFFF);
  };
  EXPECT_EQ(depth(999.75F, 1.0F), 999U);
  EXPECT_EQ(depth(-3.0F, 1.0F), 0U);
  EXPECT_EQ(depth(1e9F, 1.0F), 0xFFFFU);
  EXPECT_EQ(depth(1.0F, 0.0F), 0xFFFFU);
  EXPECT_EQ(depth(0.0F, 0.0F), 0U);  // NaN
  EXPECT_EQ(depth(0.5F, 1.0F, false), 0x7FFFU);
  EXPECT_EQ(depth(2.0F, 1.0F, false), 0xFFFFU);
}

// Rule 36.
TEST(TextureShaderEvaluate, MappingsOfDotProducts) {
  const auto normal = [](DotMapping mapping, const Bytes4& texel) {
    TextureShaderState state = nv2a_state(Op::texture_2d, Op::dot_product);
    state.stage[1].mapping = mapping;
    return *run(state, {}, texel).stage[1].normal;
  };
  using Normal = std::array<float, 3>;
  const Bytes4 texel{0, 128, 255, 64};
  EXPECT_EQ(normal(DotMapping::zero_to_one, texel), (Normal{0.0F, 128.0F / 255.0F, 1.0F}));
  EXPECT_EQ(normal(DotMapping::minus1_to_1_d3d, texel), (Normal{-128.0F / 127.0F, 0.0F, 1.0F}));
  EXPECT_EQ(normal(DotMapping::minus1_to_1_gl, texel), (Normal{1.0F / 255.0F, -1.0F, -1.0F / 255.0F}));
  EXPECT_EQ(normal(DotMapping::minus1_to_1, texel), (Normal{0.0F, -128.0F / 127.0F, -1.0F / 127.0F}));
  EXPECT_EQ(normal(DotMapping::hilo_1, texel), (Normal{16384.0F / 65535.0F, 33023.0F / 65535.0F, 1.0F}));
  EXPECT_EQ(normal(DotMapping::hilo_hemisphere, {0, 0, 0, 0}), (Normal{0.0F, 0.0F, 1.0F}));
  EXPECT_EQ(normal(DotMapping::hilo_hemisphere, {255, 127, 255, 127})[2], 0.0F);  // outside the circle
}

TEST(TextureShaderEvaluate, AStageThatIsOffReadsAsAUnitThatIs) {
  const auto result = run(nv2a_state(Op::none), {}, {1, 2, 3, 4});
  EXPECT_EQ(result.stage[0].codes, (Rgba9{0, 0, 0, 255}));
}

TEST(TextureShaderEvaluate, AnInconsistentStageGivesNothing) {
  const TextureShaderState state = nv2a_state(Op::texture_2d);
  const auto program = compile(state, {}, profiles::nv2a);
  ASSERT_TRUE(program.ok());
  EXPECT_EQ(program->warnings().size(), 1U);
  const auto result = evaluate(*program, profiles::nv2a, {}, [](int, const TexturePlace&) {
    return Bytes4{9, 9, 9, 9};
  });
  EXPECT_EQ(result.stage[0].codes, (Rgba9{0, 0, 0, 0}));
}

// A coordinate that is not a number moves nothing: the texture reads it as 0.
TEST(TextureShaderEvaluate, OffsetsKeepWhatIsNotANumber) {
  const TextureShaderState state = nv2a_state(Op::texture_2d, Op::offset_2d);
  const auto result =
      run(state, {std::array{0.0F, 0.0F, 0.0F, 1.0F}, std::array{kNotANumber, kInfinite, 0.0F, 1.0F}}, {0, 64, 192, 0});
  EXPECT_TRUE(std::isnan((*result.stage[1].at)[0]));
  EXPECT_EQ((*result.stage[1].at)[1], kInfinite);
}

}  // namespace
}  // namespace ninebit::test

// What is refused, with OpenGL's errors, and which stages are inconsistent.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <set>
#include <string>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/stage_program.h"
#include "ninebit/texture_shader/validate_stages.h"

namespace ninebit::test {
namespace {

using Op = TextureOperation;

TextureShaderState state_of(Op zero, Op one = Op::none, Op two = Op::none, Op three = Op::none) {
  TextureShaderState state;
  state.enabled = true;
  state.stage[0].operation = zero;
  state.stage[1].operation = one;
  state.stage[2].operation = two;
  state.stage[3].operation = three;
  return state;
}

void expect_fault(const TextureShaderState& state, GlError error, const std::string& words, std::optional<int> stage,
                  const HardwareProfile& profile = profiles::nv2a) {
  const auto found = validate(state, profile);
  ASSERT_FALSE(found.empty()) << words;
  EXPECT_EQ(found[0].gl_error, error) << found[0].message;
  EXPECT_EQ(found[0].stage, stage) << found[0].message;
  EXPECT_NE(found[0].message.find(words), std::string::npos) << found[0].message;
  EXPECT_FALSE(compile(state, {}, profile).ok());
}

TEST(TextureShaderValidate, DefaultsAreValidWhereTheChipHasStages) {
  EXPECT_TRUE(validate(TextureShaderState{}, profiles::geforce2).empty());
  EXPECT_TRUE(validate(state_of(Op::none), profiles::nv2a).empty());
  EXPECT_TRUE(validate(state_of(Op::none), profiles::ideal).empty());
  expect_fault(state_of(Op::none), GlError::invalid_enum, "geforce2 has no texture shaders", std::nullopt,
               profiles::geforce2);
}

TEST(TextureShaderValidate, OperationsStandOnTheirStages) {
  for (const TextureOperationInfo& info : texture_operations()) {
    for (int place = 0; place < kTextureStages; ++place) {
      TextureShaderState state = state_of(Op::none);
      state.stage[static_cast<std::size_t>(place)].operation = info.operation;
      const bool may_stand = place >= info.first && place <= info.last && info.operation != Op::brdf;
      EXPECT_EQ(validate(state, profiles::nv2a).empty(), may_stand) << info.name << ' ' << place;
    }
  }
  expect_fault(state_of(Op::offset_2d), GlError::invalid_operation, "offset_2d is for stages 1 to 3 only", 0);
  expect_fault(state_of(Op::none, Op::dot_product_diffuse_cube_map), GlError::invalid_operation,
               "dot_product_diffuse_cube_map is for stage 2 only", 1);
  expect_fault(state_of(Op::none, Op::none, Op::none, Op::brdf), GlError::invalid_enum, "brdf is not modelled", 3);
  EXPECT_EQ(validate(state_of(Op::none, Op::none, Op::brdf), profiles::nv2a).size(), 1U)
      << "the Xbox has it there, too";
  EXPECT_EQ(validate(state_of(Op::none, Op::brdf), profiles::nv2a).size(), 2U);
}

TEST(TextureShaderValidate, AllFaultsAreReportedEnumerantsFirst) {
  TextureShaderState state = state_of(Op::none, Op::dependent_ar, Op::offset_2d);
  state.stage[1].previous = 1;
  state.stage[1].mapping = static_cast<DotMapping>(9);
  state.stage[2].previous = 4;
  state.stage[2].matrix[3] = std::numeric_limits<float>::quiet_NaN();
  state.stage[3].mapping = DotMapping::hilo_hemisphere_gl;
  const auto found = validate(state, profiles::nv2a);
  ASSERT_EQ(found.size(), 5U);
  EXPECT_EQ(found[0].message, "texture stage 1: unknown dot-product mapping; expected an enumerator of DotMapping");
  EXPECT_EQ(found[1].message,
            "texture stage 1: the previous stage is 1, which is not before this one; expected one from 0 to 0");
  EXPECT_EQ(found[1].gl_error, GlError::invalid_operation);
  EXPECT_EQ(found[2].message, "texture stage 2: the previous stage is 4; expected one from 0 to 1");
  EXPECT_EQ(found[3].message, "texture stage 2: an entry of the offset matrix is not a number (NaN); expected numbers");
  EXPECT_EQ(found[3].gl_error, GlError::no_error);
  EXPECT_NE(found[4].message.find("mappings 5 and 6"), std::string::npos);
  const auto refused = compile(state, {}, profiles::nv2a);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(std::count(refused.error().message.begin(), refused.error().message.end(), '\n'), 4);
  TextureShaderState unknown = state_of(static_cast<Op>(77));
  expect_fault(unknown, GlError::invalid_enum, "unknown operation; expected an enumerator of TextureOperation", 0);
}

TEST(TextureShaderOperations, NamesAndWordsAreTheirOwn) {
  std::set<std::string_view> names, gl;
  for (const TextureOperationInfo& info : texture_operations()) {
    EXPECT_TRUE(names.insert(info.name).second) << info.name;
    if (!info.gl.empty()) {
      EXPECT_TRUE(gl.insert(info.gl).second) << info.gl;
    }
    EXPECT_EQ(texture_operation_called(info.name), info.operation);
    EXPECT_EQ(&info_of(info.operation), &info);
    EXPECT_LE(info.word, 0x12);
  }
  EXPECT_FALSE(texture_operation_called("offset").has_value());
}

// The warnings of stages by OpenGL's rules, with a texture of the right kind on each unit.
std::vector<std::string> warnings(const TextureShaderState& state, const StageTextures& textures) {
  const auto program = compile(state, textures, profiles::nv2a);
  EXPECT_TRUE(program.ok());
  return program.ok() ? program->warnings() : std::vector<std::string>{};
}
StageTexture texture(StageTarget target, TextureFormat format = TextureFormat::rgba, bool is_signed = false) {
  return {target, format, {is_signed, is_signed, is_signed, is_signed}};
}
const StageTexture kFlat = texture(StageTarget::two_dimensional), kCube = texture(StageTarget::cube_map);

TEST(TextureShaderConsistency, TexturesMustSuit) {
  EXPECT_TRUE(warnings(state_of(Op::texture_2d), {kFlat}).empty());
  EXPECT_EQ(warnings(state_of(Op::texture_2d), {}),
            std::vector<std::string>{"texture stage 0: texture_2d reads a 2D texture, and the unit has no complete "
                                     "texture; it gives (0, 0, 0, 0)"});
  EXPECT_EQ(warnings(state_of(Op::texture_3d), {kCube}),
            std::vector<std::string>{"texture stage 0: texture_3d reads a 3D texture, and the unit has a cube map; it "
                                     "gives (0, 0, 0, 0)"});
}

TEST(TextureShaderConsistency, FormatsMustSuitInOpenGlAlone) {
  const StageTexture dsdt = texture(StageTarget::two_dimensional, TextureFormat::dsdt, true),
                     mag = texture(StageTarget::two_dimensional, TextureFormat::dsdt_mag, true),
                     hilo = texture(StageTarget::two_dimensional, TextureFormat::hilo),
                     negative = texture(StageTarget::two_dimensional, TextureFormat::rgba, true);
  TextureShaderState offset = state_of(Op::texture_2d, Op::offset_2d);
  EXPECT_TRUE(warnings(offset, {dsdt, kFlat}).empty());
  EXPECT_TRUE(warnings(offset, {mag, kFlat}).empty());
  EXPECT_EQ(warnings(offset, {kFlat, kFlat}).size(), 1U);
  TextureShaderState scaled = state_of(Op::texture_2d, Op::offset_2d_scale);
  EXPECT_TRUE(warnings(scaled, {mag, kFlat}).empty());
  EXPECT_EQ(warnings(scaled, {dsdt, kFlat}).size(), 1U);
  EXPECT_EQ(warnings(scaled, {mag, negative}).size(), 1U);
  TextureShaderState dependent = state_of(Op::texture_2d, Op::dependent_gb);
  EXPECT_EQ(warnings(dependent, {hilo, kFlat}).size(), 1U);
  EXPECT_EQ(warnings(dependent, {negative, kFlat}).size(), 1U);
  EXPECT_TRUE(warnings(state_of(Op::texture_2d, Op::dot_product), {hilo}).empty());
  EXPECT_EQ(warnings(state_of(Op::texture_2d, Op::dot_product), {dsdt}).size(), 1U);
  for (TextureShaderState* const state : {&offset, &scaled, &dependent}) {
    state->rules = StageRules::nv2a;
    EXPECT_TRUE(warnings(*state, {hilo, kFlat}).empty());
  }
}

TEST(TextureShaderConsistency, WhatReadsAnInconsistentStageIsSo) {
  const auto all = warnings(state_of(Op::texture_2d, Op::dot_product, Op::dot_product_2d), {std::nullopt, {}, kFlat});
  ASSERT_EQ(all.size(), 3U);
  EXPECT_NE(all[1].find("it reads texture stage 0, which is inconsistent"), std::string::npos);
  EXPECT_EQ(
      warnings(state_of(Op::cull_fragment, Op::dependent_ar), {std::nullopt, kFlat}),
      std::vector<std::string>{"texture stage 1: it reads texture stage 0, whose operation cull_fragment gives no "
                               "texel; it gives (0, 0, 0, 0)"});
}

TEST(TextureShaderConsistency, ChainsOfDotProducts) {
  const Op dot = Op::dot_product, reflect = Op::dot_product_reflect_cube_map,
           diffuse = Op::dot_product_diffuse_cube_map;
  EXPECT_TRUE(warnings(state_of(Op::texture_2d, dot, dot, reflect), {kFlat, {}, {}, kCube}).empty());
  EXPECT_TRUE(warnings(state_of(Op::texture_2d, dot, diffuse, reflect), {kFlat, {}, kCube, kCube}).empty());
  EXPECT_EQ(warnings(state_of(Op::texture_2d, Op::none, dot, reflect), {kFlat, {}, {}, kCube}).size(), 1U);
  const auto alone = warnings(state_of(Op::texture_2d, dot, diffuse), {kFlat, {}, kCube});
  ASSERT_EQ(alone.size(), 1U);
  EXPECT_NE(alone[0].find("needs a reflect cube map after it"), std::string::npos) << alone[0];
  TextureShaderState ahead = state_of(Op::texture_2d, dot, diffuse, reflect);
  ahead.stage[3].previous = 2;
  EXPECT_EQ(warnings(ahead, {kFlat, {}, kCube, kCube}).size(), 2U);
}

// OpenGL's formats decide how a dot product reads a texel.
TEST(TextureShaderConsistency, MappingsFollowFormats) {
  TextureShaderState state = state_of(Op::texture_2d, Op::dot_product);
  state.stage[1].mapping = DotMapping::minus1_to_1_d3d;
  const auto mapping = [&](TextureFormat format, bool is_signed) {
    const StageTextures textures{texture(StageTarget::two_dimensional, format, is_signed)};
    return compile(state, textures, profiles::nv2a)->stage[1].state.mapping;
  };
  EXPECT_EQ(mapping(TextureFormat::rgba, false), DotMapping::minus1_to_1_d3d);
  EXPECT_EQ(mapping(TextureFormat::rgba, true), DotMapping::minus1_to_1);
  EXPECT_EQ(mapping(TextureFormat::hilo, false), DotMapping::hilo_1);
  EXPECT_EQ(mapping(TextureFormat::hilo, true), DotMapping::hilo_hemisphere);
  state.rules = StageRules::nv2a;
  EXPECT_EQ(mapping(TextureFormat::hilo, true), DotMapping::minus1_to_1_d3d);
}

}  // namespace
}  // namespace ninebit::test

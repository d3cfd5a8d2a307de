// Texture-shader stages emitted as GLSL, run by a GL without a window, against one fragment's evaluation.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

#include "combiner_tests/language/emit_gl_runner.h"
#include "combiner_tests/language/emit_stage_cases.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/random.h"
#include "ninebit/language/glsl.h"
#include "ninebit/texture_shader/evaluate_stages.h"
#include "ninebit/texture_shader/stage_program.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kStageGlslSeed = 0x73746167;
constexpr std::size_t kStageGlslFragments = 64;

// The textures of both: bytes from coordinates. Equal where the floats are.
constexpr std::string_view kTexelSource = R"(
ivec4 texel_of(vec3 at, int unit) {
  ivec3 n = ivec3(floor(clamp(at, -64.0, 64.0) * 512.0));
  int h = n.x * 73 + n.y * 151 + n.z * 283 + unit * 31;
  return ivec4(h, h * 3 + 1, h * 7 + 2, h * 13 + 5) & 255;
}
)";
// What the runner's columns hold: the four textures, then whether the fragment is culled and its depth's bits.
Rgba9 column_of(const TextureShaderResult& result, int column) {
  if (column < kTextureStages) return result.stage[static_cast<std::size_t>(column)].codes;
  const auto bits = std::bit_cast<std::uint32_t>(result.depth.value_or(0.0F));
  return {static_cast<s9>(result.is_culled ? 1 : 0), static_cast<s9>(bits & 0x7FFF),
          static_cast<s9>(bits >> 15 & 0x7FFF), static_cast<s9>(bits >> 30)};
}

std::string shader_of(const std::string& stages, GlslVersion version, std::vector<std::string>& functions) {
  std::string text = version == GlslVersion::es_300 ? "#version 300 es\nprecision highp int;\nprecision highp float;\n"
                                                    : "#version 330 core\n";
  text += stages + std::string(kTexelSource);
  for (int i = 0; i < kTextureStages; ++i) {
    const std::string name = "ivec4 ninebit_texture_shader_texel" + std::to_string(i) + "(vec3 at)";
    if (stages.find(name) != std::string::npos) text += name + " { return texel_of(at, " + std::to_string(i) + "); }\n";
  }
  text +=
      "ivec4 column_of(int column, ivec4 a0, ivec4 a1, ivec4 a2, ivec4 a3) {\n"
      "  ivec4 t0, t1, t2, t3;\n  float depth;\n"
      "  bool culled = ninebit_texture_shader(vec4(a0) / 128.0, vec4(a1) / 128.0, vec4(a2) / 128.0, vec4(a3) / 128.0,\n"
      "                                       t0, t1, t2, t3, depth);\n"
      "  int bits = floatBitsToInt(depth);\n"
      "  ivec4 last = ivec4(culled ? 1 : 0, bits & 32767, (bits >> 15) & 32767, (bits >> 30) & 3);\n"
      "  return column == 0 ? t0 : column == 1 ? t1 : column == 2 ? t2 : column == 3 ? t3 : last;\n}\n";
  for (int i = 0; i <= kTextureStages; ++i) {
    functions.push_back("column" + std::to_string(i));
    text += "ivec4 " + functions.back() +
            "(ivec4 a0, ivec4 a1, ivec4 a2, ivec4 a3, ivec4 b, ivec4 c, ivec4 d, int e) {\n  return column_of(" +
            std::to_string(i) + ", a0, a1, a2, a3);\n}\n";
  }
  return text;
}

class EmitGlslStages : public ::testing::TestWithParam<GlslVersion> {};

TEST_P(EmitGlslStages, RandomStagesGiveTheBitsOfTheReference) {
  std::string message;
  const auto runner = GlRunner::make(GetParam(), message);
  if (runner == nullptr) {
    std::fprintf(stderr, "NOTICE: emitted GLSL was not run: %s\n", message.c_str());
    GTEST_SKIP() << message;
  }
  Random random(kStageGlslSeed);
  std::array<int, 24> seen{};
  int depths = 0, culled = 0;
  const int rounds = GetParam() == GlslVersion::es_300 ? 1 : 2;
  for (int n = 0; n < rounds * kStageOperations; ++n) {
    const auto wanted = static_cast<TextureOperation>(n % kStageOperations);
    const StageCase c = random_stage_case(random, wanted);
    const auto program = compile(c.state, c.textures, c.profile);
    ASSERT_TRUE(program.ok()) << program.error().message;
    const auto stages = emit_glsl_texture_shader(*program, c.profile);
    ASSERT_TRUE(stages.ok()) << stages.error().message;
    std::vector<std::string> functions;
    const std::string text = shader_of(*stages, GetParam(), functions);
    std::vector<RegisterFile> inputs(kStageGlslFragments);
    for (RegisterFile& registers : inputs) {
      for (const Register r : {Register::primary, Register::secondary, Register::fog, Register::texture0}) {
        for (s9& value : registers[r]) value = static_cast<s9>(random.between(-255, 255));
        registers[r][3] = random.pick({s9{128}, s9{128}, s9{256}, s9{64}, s9{-32}});
      }
    }
    const auto columns = runner->run(text, functions, inputs, message);
    ASSERT_TRUE(columns.has_value()) << message;
    for (std::size_t k = 0; k < inputs.size(); ++k) {
      StageInputs in;
      for (std::size_t i = 0; i < 4; ++i) {
        const Register r = std::array{Register::primary, Register::secondary, Register::fog, Register::texture0}[i];
        for (std::size_t j = 0; j < 4; ++j) in.at[i][j] = static_cast<float>(inputs[k][r][j]) / 128.0F;
      }
      in.right = in.above = in.at;
      const TextureShaderResult expected = evaluate(
          *program, c.profile, in, [](int unit, const TexturePlace& place) { return texel_of(place.at, unit); });
      if (expected.depth && !std::isfinite(*expected.depth)) continue;  // a quotient by 0
      depths += expected.depth ? 1 : 0;
      culled += expected.is_culled ? 1 : 0;
      for (int column = 0; column <= kTextureStages; ++column) {
        ASSERT_EQ((*columns)[static_cast<std::size_t>(column)][k], column_of(expected, column))
            << "case " << n << ", fragment " << k << ", column " << column << '\n'
            << text;
      }
    }
    for (const ProgramTextureStage& stage : program->stage) {
      if (stage.inconsistent.empty()) ++seen[static_cast<std::size_t>(stage.state.operation)];
    }
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(TextureOperation::brdf); ++i) {
    EXPECT_GT(seen[i], 0) << info_of(static_cast<TextureOperation>(i)).name;
  }
  EXPECT_GT(depths, 30);
  EXPECT_GT(culled, 30);
}

TEST(EmitStages, UniformNumbersAreNotInTheText) {
  TextureShaderState state{.enabled = true, .rules = StageRules::nv2a};
  StageTextures textures;
  textures[0] = textures[1] = StageTexture{};
  state.stage[0].operation = TextureOperation::texture_2d;
  state.stage[1].operation = TextureOperation::offset_2d_scale;
  state.stage[1].matrix = {0.1875F, 0.3125F, 0.4375F, 0.5625F};
  state.stage[1].scale = 0.6875F;
  const auto program = compile(state, textures, profiles::nv2a);
  ASSERT_TRUE(program.ok());
  const std::string literal = emit_glsl_texture_shader(*program, profiles::nv2a).value();
  const std::string uniform =
      emit_glsl_texture_shader(*program, profiles::nv2a, StageNumbers::uniform, "stages").value();
  EXPECT_TRUE(has(literal, "vec4(0.1875, 0.3125, 0.4375, 0.5625)"));
  EXPECT_TRUE(has(literal, "vec2(0.6875, 0.0)"));
  EXPECT_FALSE(has(uniform, "0.1875"));
  EXPECT_TRUE(has(uniform, "stages_matrix[1]"));
  EXPECT_TRUE(has(uniform, "uniform vec4 stages_matrix[4];"));
  EXPECT_FALSE(emit_glsl_texture_shader(*program, profiles::nv2a, StageNumbers::literal, "gl_x").ok());
}

INSTANTIATE_TEST_SUITE_P(Versions, EmitGlslStages, ::testing::Values(GlslVersion::glsl_330, GlslVersion::es_300),
                         [](const auto& version) {
                           return std::string(version.param == GlslVersion::es_300 ? "Es300" : "Glsl330");
                         });

}  // namespace
}  // namespace ninebit::test

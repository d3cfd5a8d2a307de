// Texture-shader stages emitted as GLSL, run by a GL without a window, against one fragment's evaluation.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>

#include "combiner_tests/language/emit_gl_runner.h"
#include "combiner_tests/support/random.h"
#include "ninebit/language/glsl.h"
#include "ninebit/texture_shader/evaluate_stages.h"
#include "ninebit/texture_shader/stage_program.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kStageGlslSeed = 0x73746167;
constexpr int kStageOperations = static_cast<int>(TextureOperation::brdf);
constexpr std::size_t kStageGlslFragments = 64;

// The textures of both: bytes from coordinates. Equal where the floats are.
constexpr std::string_view kTexelSource = R"(
ivec4 texel_of(vec3 at, int unit) {
  ivec3 n = ivec3(floor(clamp(at, -64.0, 64.0) * 512.0));
  int h = n.x * 73 + n.y * 151 + n.z * 283 + unit * 31;
  return ivec4(h, h * 3 + 1, h * 7 + 2, h * 13 + 5) & 255;
}
)";
Bytes4 texel_of(const std::array<float, 3>& at, int unit) {
  std::array<int, 3> n{};
  for (std::size_t k = 0; k < 3; ++k) {
    n[k] = static_cast<int>(std::floor(std::clamp(at[k], -64.0F, 64.0F) * 512.0F));
  }
  const int h = n[0] * 73 + n[1] * 151 + n[2] * 283 + unit * 31;
  return {static_cast<std::uint8_t>(h & 255), static_cast<std::uint8_t>((h * 3 + 1) & 255),
          static_cast<std::uint8_t>((h * 7 + 2) & 255), static_cast<std::uint8_t>((h * 13 + 5) & 255)};
}

// Numbers and choices of a stage.
TextureStage random_stage(Random& random, int place, TextureOperation operation) {
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
std::array<TextureStage, kTextureStages> random_stages(Random& random, TextureOperation wanted) {
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

struct GlslStageCase {
  HardwareProfile profile = profiles::nv2a;
  TextureShaderState state{.enabled = true, .rules = StageRules::nv2a};
  StageTextures textures;
};

GlslStageCase random_stage_case(Random& random, TextureOperation wanted) {
  GlslStageCase c;
  c.state.stage = random_stages(random, wanted);
  c.state.converts_yuv = random.one_in(6);
  c.state.depth_unit = DepthUnit::codes;
  if (random.one_in(3)) {
    c.state.rules = StageRules::open_gl;
    c.state.converts_yuv = false;
  }
  if (random.one_in(2)) c.profile.stage_byte.value = StageByte::nearest;
  if (random.one_in(2)) c.profile.dot_divisors.value = DotDivisors::even;
  if (random.one_in(2)) c.profile.dependent_divisor.value = 256;
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
  const int rounds = GetParam() == GlslVersion::es_300 ? 1 : 3;
  for (int n = 0; n < rounds * kStageOperations; ++n) {
    const auto wanted = static_cast<TextureOperation>(n % kStageOperations);
    const GlslStageCase c = random_stage_case(random, wanted);
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
  EXPECT_NE(literal.find("vec4(0.1875, 0.3125, 0.4375, 0.5625)"), std::string::npos) << literal;
  EXPECT_NE(literal.find("vec2(0.6875, 0.0)"), std::string::npos) << literal;
  EXPECT_EQ(uniform.find("0.1875"), std::string::npos) << uniform;
  EXPECT_NE(uniform.find("stages_matrix[1]"), std::string::npos) << uniform;
  EXPECT_NE(uniform.find("uniform vec4 stages_matrix[4];"), std::string::npos) << uniform;
  EXPECT_FALSE(emit_glsl_texture_shader(*program, profiles::nv2a, StageNumbers::literal, "gl_x").ok());
}

INSTANTIATE_TEST_SUITE_P(Versions, EmitGlslStages, ::testing::Values(GlslVersion::glsl_330, GlslVersion::es_300),
                         [](const auto& version) {
                           return std::string(version.param == GlslVersion::es_300 ? "Es300" : "Glsl330");
                         });

}  // namespace
}  // namespace ninebit::test

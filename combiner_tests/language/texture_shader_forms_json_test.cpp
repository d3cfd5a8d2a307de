// Texture-shader stages in GL calls and in pixel shaders: what they mean, round trips, faults with their places.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/random_stages.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/program_text.h"
#include "ninebit/texture_shader/validate_stages.h"

namespace ninebit::test {
namespace {

constexpr const char* kUnit = "glActiveTextureARB(GL_TEXTURE1_ARB);\n";

std::string gl_faults(const std::string& calls, const HardwareProfile& profile = profiles::nv2a) {
  TextureShaderState stages;
  return all_faults(parse_gl_calls({calls, {}}, profile, &stages));
}

TEST(StageCalls, SetTheActiveUnit) {
  const std::string calls =
      "glEnable(GL_TEXTURE_SHADER_NV);\n"
      "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);\n"
      "qglActiveTextureARB(GL_TEXTURE1);\n"
      "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_OFFSET_TEXTURE_2D_SCALE_NV);\n"
      "glTexEnvf(GL_TEXTURE_SHADER_NV, GL_PREVIOUS_TEXTURE_INPUT_NV, GL_TEXTURE0_ARB);\n"
      "GLfloat m[] = {1, 2, 3, 4};\nglTexEnvfv(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_MATRIX_NV, m);\n"
      "glTexEnvf(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_2D_SCALE_NV, 0.5f);\n"
      "glTexEnvf(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_BIAS_NV, -2);\n"
      "glActiveTexture(GL_TEXTURE2);\n"
      "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_CULL_FRAGMENT_NV);\n"
      "glTexEnviv(GL_TEXTURE_SHADER_NV, GL_CULL_MODES_NV, (GLint[]){GL_LESS, GL_GEQUAL, GL_GEQUAL, GL_LESS});\n"
      "glActiveTexture(GL_TEXTURE3);\n"
      "glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_CONST_EYE_NV, (GLfloat[]){1, 0.5f, -1});\n"
      "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV, GL_EXPAND_NORMAL_NV);\n";
  const auto program = parse_program({calls, "f"}, ProgramForm::gl, profiles::nv2a);
  ASSERT_TRUE(program) << all_faults(program);
  TextureShaderState expected;
  expected.enabled = true;
  expected.stage[0].operation = TextureOperation::texture_2d;
  expected.stage[1].operation = TextureOperation::offset_2d_scale;
  expected.stage[1].matrix = {1, 2, 3, 4};
  expected.stage[1].scale = 0.5F;
  expected.stage[1].bias = -2.0F;
  expected.stage[2].operation = TextureOperation::cull_fragment;
  expected.stage[2].cull = {CullMode::kills_not_negative, CullMode::kills_negative, CullMode::kills_negative,
                            CullMode::kills_not_negative};
  expected.stage[3].eye = {1.0F, 0.5F, -1.0F};
  expected.stage[3].mapping = DotMapping::minus1_to_1_d3d;
  EXPECT_EQ(program->texture_shader, expected);
  // Without the capability there are none.
  TextureShaderState off;
  ASSERT_TRUE(parse_gl_calls({"glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);", ""},
                             profiles::nv2a, &off));
  EXPECT_EQ(off, TextureShaderState{});
}

TEST(StageCalls, RandomStagesComeBack) {
  int printed = 0;
  for (int i = 0; i < (kSlowBuild ? 200 : 2000); ++i) {
    Random random(64, static_cast<std::uint64_t>(i));
    TextureShaderState stages = random_stages(random);
    for (TextureStage& stage : stages.stage) {
      if (!random.one_in(16)) stage.mapping = random.pick({DotMapping::zero_to_one, DotMapping::minus1_to_1_d3d});
    }
    if (!random.one_in(8)) stages.converts_yuv = false;
    if (!random.one_in(8)) stages.depth_unit = DepthUnit::window;
    const auto text = print_gl_calls({}, profiles::nv2a, stages);
    if (!text) continue;
    ++printed;
    TextureShaderState back, expected = only_used(stages);
    expected.rules = StageRules::open_gl;
    const auto parsed = parse_gl_calls({*text, "f"}, profiles::nv2a, &back);
    ASSERT_TRUE(parsed) << all_faults(parsed) << *text;
    ASSERT_EQ(back, expected) << *text;
    ASSERT_EQ(*print_gl_calls({}, profiles::nv2a, back), *text);
  }
  EXPECT_GT(printed, kSlowBuild ? 100 : 1000);
}

TEST(StageCalls, FaultsHaveTheirPlacesAndErrors) {
  const std::string set = "glTexEnvi(GL_TEXTURE_SHADER_NV, ";
  EXPECT_EQ(gl_faults(set + "GL_SHADER_OPERATION_NV, GL_OFFSET_TEXTURE_2D_NV);"),
            "1:1: GL_INVALID_OPERATION: texture stage 0: 'GL_OFFSET_TEXTURE_2D_NV' is for stages 1 to 3 only\n");
  EXPECT_EQ(gl_faults(kUnit + set + "GL_PREVIOUS_TEXTURE_INPUT_NV, GL_TEXTURE1_ARB);"),
            "2:1: GL_INVALID_OPERATION: texture stage 1: expected a texture unit before this one, such as "
            "GL_TEXTURE0_ARB, not 'GL_TEXTURE1_ARB'\n");
  EXPECT_EQ(gl_faults(set + "GL_PREVIOUS_TEXTURE_INPUT_NV, 3);"),
            "1:1: GL_INVALID_ENUM: texture stage 0: expected a texture unit before this one, such as GL_TEXTURE0_ARB, "
            "not '3'\n");
  EXPECT_TRUE(has(gl_faults(set + "GL_SHADER_OPERATION_NV, GL_DOT_PRODUCT_TEXTURE_1D_NV);"),
                  "'GL_DOT_PRODUCT_TEXTURE_1D_NV' is an operation of NV_texture_shader3, which the GeForce3 does not"));
  EXPECT_EQ(gl_faults(set + "GL_SHADER_OPERATION_NV, GL_LESS);"),
            "1:1: GL_INVALID_ENUM: expected an operation, such as GL_TEXTURE_2D or GL_DOT_PRODUCT_NV, not 'GL_LESS'\n");
  EXPECT_EQ(gl_faults(set + "GL_CULL_MODES_NV, GL_LESS);"),
            "1:1: GL_INVALID_ENUM: this parameter needs an array; expected one of a single value\n");
  EXPECT_EQ(
      gl_faults(set + "GL_LESS, 1);"),
      "1:1: GL_INVALID_ENUM: expected a parameter of texture shaders, such as GL_SHADER_OPERATION_NV, not 'GL_LESS'\n");
  EXPECT_EQ(gl_faults(set + "GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV, GL_SIGNED_IDENTITY_NV);"),
            "1:1: GL_INVALID_ENUM: expected GL_UNSIGNED_IDENTITY_NV or GL_EXPAND_NORMAL_NV, not "
            "'GL_SIGNED_IDENTITY_NV'\n");
  EXPECT_EQ(gl_faults("glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_CONST_EYE_NV, (GLfloat[]){1, 2});"),
            "1:51: '(GLfloat[]){1, 2}' cannot be passed here; expected 3 values, not 2\n");
  EXPECT_EQ(gl_faults("glTexEnvf(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_SCALE_NV, 1e39);"),
            "1:61: '1e39' is too large for a float\n");
  EXPECT_EQ(gl_faults("glTexEnvi(GL_TEXTURE_ENV, GL_SHADER_OPERATION_NV, 0);"),
            "1:11: 'GL_TEXTURE_ENV' is another target; glTexEnvi is read with GL_TEXTURE_SHADER_NV alone\n");
  EXPECT_EQ(gl_faults("glActiveTexture(GL_TEXTURE4);"), "1:1: GL_INVALID_ENUM: profile nv2a has 4 texture units\n");
  EXPECT_EQ(gl_faults("glEnable(GL_TEXTURE_SHADER_NV);", profiles::geforce2),
            "1:1: GL_INVALID_ENUM: profile geforce2 has no texture shaders (NV_texture_shader); expected a profile "
            "that has, such as nv2a\n");
}

TEST(StageCalls, AreReadInDumps) {
  TextureShaderState stages;
  const auto parsed = parse_gl_calls(
      {"1 glEnable(cap = GL_REGISTER_COMBINERS_NV)\n2 glActiveTexture(texture = GL_TEXTURE0)\n"
       "3 glTexEnvi(target = GL_TEXTURE_ENV, pname = GL_TEXTURE_ENV_MODE, param = GL_MODULATE)\n"
       "4 glTexEnvi(target = GL_TEXTURE_SHADER_NV, pname = GL_SHADER_OPERATION_NV, param = GL_TEXTURE_2D)\n"
       "5 glEnable(cap = GL_TEXTURE_SHADER_NV)\n",
       "f"},
      profiles::nv2a, &stages);
  ASSERT_TRUE(parsed) << all_faults(parsed);
  EXPECT_EQ(stages.stage[0].operation, TextureOperation::texture_2d);
}

// Pixel shaders.

struct ReadShader {
  TextureShaderState stages;
  std::string faults;
  std::vector<std::string> notes;
};

ReadShader read_shader(const std::string& text, const HardwareProfile& profile = profiles::nv2a) {
  ReadShader out;
  const auto parsed = parse_pixel_shader({text, {}}, profile, {}, {}, &out.stages);
  out.faults = all_faults(parsed);
  for (const TextFault& note : parsed.notes) out.notes.push_back(note.text());
  return out;
}

TEST(ShaderTextures, PlainTexturesAreNoStages) {
  const ReadShader read = read_shader("ps.1.1\ntex t0\ntex t1\nmul r0, t0, t1\n", profiles::geforce2);
  EXPECT_EQ(read.faults, "");
  EXPECT_EQ(read.stages, TextureShaderState{});
  EXPECT_TRUE(read.notes.empty());
}

TEST(ShaderTextures, BecomeTheStagesOfTheirRegisters) {
  const ReadShader bump = read_shader("ps.1.1\ntex t0\ntexbem t1, t0\ntexcoord t2\ntexkill t3\nmul r0, t1, t2\n");
  EXPECT_EQ(bump.faults, "");
  EXPECT_TRUE(bump.stages.enabled);
  EXPECT_EQ(bump.stages.stage[0].operation, TextureOperation::texture_2d);
  EXPECT_EQ(bump.stages.stage[1].operation, TextureOperation::offset_2d);
  EXPECT_EQ(bump.stages.stage[2].operation, TextureOperation::pass_through);
  EXPECT_EQ(bump.stages.stage[3].operation, TextureOperation::cull_fragment);
  ASSERT_EQ(bump.notes.size(), 2U);
  EXPECT_EQ(bump.notes[0],
            "2:1: texture stage 0 reads a texture of the kind that the application sets; a 2D one is assumed");
  EXPECT_EQ(bump.notes[1], "3:1: the application sets the bump matrix of texture stage 1; the identity is assumed");
  const ReadShader reflect = read_shader(
      "ps.1.1\ndef c3, 2, 0, -5, 0\ntex t0\ntexm3x3pad t1, t0_bx2\ntexm3x3pad t2, t0_bx2\n"
      "texm3x3spec t3, t0_bx2, c3\nmov r0, t3\n");
  EXPECT_EQ(reflect.faults, "");
  EXPECT_EQ(reflect.stages.stage[1].operation, TextureOperation::dot_product);
  EXPECT_EQ(reflect.stages.stage[1].mapping, DotMapping::minus1_to_1_d3d);
  EXPECT_EQ(reflect.stages.stage[3].operation, TextureOperation::dot_product_const_eye_reflect_cube_map);
  EXPECT_EQ(reflect.stages.stage[3].eye, (std::array{2.0F, 0.0F, -5.0F}));
  EXPECT_EQ(reflect.notes.size(), 1U);
  const ReadShader xbox =
      read_shader("xps.1.1\ntex t0\ntexm3x3pad t1, t0\ntexm3x3diff t2, t0\ntexm3x3vspec t3, t0\nmov r0, t3\n");
  EXPECT_EQ(xbox.faults, "");
  EXPECT_EQ(xbox.stages.rules, StageRules::nv2a);
  EXPECT_EQ(xbox.stages.depth_unit, DepthUnit::codes);
  EXPECT_EQ(xbox.stages.stage[2].operation, TextureOperation::dot_product_diffuse_cube_map);
}

TEST(ShaderTextures, RulesOfDirect3D) {
  const auto faults = [](const std::string& lines, const std::string& version = "ps.1.3") {
    return read_shader(version + "\n" + lines + "\nmov r0, v0\n").faults;
  };
  EXPECT_EQ(faults("tex t0\ntexbem t0, t0"), "3:1: 't0' is loaded already, by tex\n");
  EXPECT_EQ(faults("tex t1\ntexbem t0, t1"),
            "3:12: GL_INVALID_OPERATION: 'texbem' of t0 reads 't1'; expected a t register of a lower number\n");
  EXPECT_EQ(faults("texbem t1, t0"), "2:12: 'texbem' of t1 reads 't0', which no instruction before loads\n");
  EXPECT_EQ(faults("tex t0\ntexm3x2tex t1, t0"), "3:1: 'texm3x2tex' of t1 needs texm3x2pad in the register before\n");
  EXPECT_EQ(faults("tex t0\ntexm3x2pad t1, t0\ntexm3x2tex t2, t1"),
            "4:16: 'texm3x2tex' of t2 reads 't1', which has no texel: it is loaded by texm3x2pad\n");
  EXPECT_EQ(faults("tex t0\ntexm3x2pad t1, t0"),
            "3:1: 'texm3x2pad' of t1 needs texm3x2tex or texm3x2depth in the next register\n");
  EXPECT_EQ(faults("tex t0\ntexm3x3pad t1, t0\ntexm3x3tex t3, t0"),
            "3:1: 'texm3x3pad' of t1 needs texm3x3pad or the matrix's last row in the next register\n"
            "4:1: 'texm3x3tex' of t3 needs texm3x3pad in the two registers before\n");
  EXPECT_EQ(faults("tex t0\ntexreg2ar t1, t0_bx2"), "3:15: 't0_bx2' has a modifier that 'texreg2ar' does not have\n");
  for (const std::string name : {"texdp3 t1, t0", "texdp3tex t1, t0", "texreg2rgb t1, t0"}) {
    EXPECT_TRUE(has(faults("tex t0\n" + name), "is beyond the texture shaders of the GeForce3")) << name;
  }
  EXPECT_EQ(faults("tex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3 t3, t0"),
            "5:1: 'texm3x3' is beyond the texture shaders of the GeForce3, which have no such operation\n");
  EXPECT_EQ(read_shader("xps.1.1\ntex t0\ntexbrdf t3, t1\nmov r0, t3\n").faults,
            "3:1: GL_INVALID_ENUM: texture stage 3: brdf is not modelled: no picture of the NV2A decides what it "
            "computes\n");
  EXPECT_EQ(read_shader("ps.1.4\ntexkill t0\ntexld r0, t1\nmov r0, r0\n").faults,
            "3:1: 'r0' needs texture stage 0, which 'texkill' has; a stage has one instruction\n");
  EXPECT_EQ(read_shader("ps.1.4\ntexld r0, t0\nphase\ntexkill r0\nmov r0, v0\n").faults,
            "4:9: 'texkill' of 'r0' tests a register's value; the texture shaders of the GeForce3 test coordinates "
            "alone\n");
  const ReadShader last = read_shader("ps.1.4\ntexcrd r0.rgb, t0\ntexld r1, t1\nmov r0, r1\n");
  EXPECT_EQ(last.faults, "");
  EXPECT_EQ(last.stages.stage[0].operation, TextureOperation::pass_through);
  EXPECT_EQ(last.stages.stage[1].operation, TextureOperation::texture_2d);
  EXPECT_EQ(read_shader("ps.1.1\ntexcoord t0\nmov r0, t0\n", profiles::geforce2).faults,
            "2:1: GL_INVALID_ENUM: profile geforce2 has no texture shaders (NV_texture_shader); expected a profile "
            "that has, such as nv2a\n");
}

// HLSL is written for the combiners alone.
TEST(ShaderTextures, HlslRefusesStages) {
  TextProgram program;
  program.texture_shader.enabled = true;
  program.texture_shader.stage[0].operation = TextureOperation::texture_2d;
  const auto print = [&] { return find_form("hlsl")->print(program, ChipClass::nv20, profiles::nv2a); };
  EXPECT_TRUE(print()) << "they only read their textures";
  program.texture_shader.stage[1].operation = TextureOperation::offset_2d;
  ASSERT_FALSE(print());
  EXPECT_EQ(print().error().message,
            "it has the combiners alone, and these texture-shader stages do more than read their textures");
}

// The eye vector is a plain constant, with all digits of its name.
TEST(ShaderTextures, TheEyeIsAConstant) {
  const std::string rows = "tex t0\ntexm3x3pad t1, t0\ntexm3x3pad t2, t0\ntexm3x3spec t3, t0";
  const ReadShader last =
      read_shader("xps.1.1\ndef c1, 2, 2, 2, 2\ndef c12, 3, 4, -5, 0\n" + rows + ", c12\nmov r0, t3\n");
  EXPECT_EQ(last.faults, "");
  EXPECT_EQ(last.stages.stage[3].eye, (std::array{3.0F, 4.0F, -5.0F}));
  EXPECT_EQ(std::count(last.notes.begin(), last.notes.end(), "2:5: c1 is clamped to 0 to 1"), 1);
  EXPECT_EQ(read_shader("ps.1.1\n" + rows + ", c1_x2\nmov r0, t3\n").faults,
            "5:21: 'c1_x2' has a modifier; expected a constant without one\n");
  EXPECT_EQ(read_shader("ps.1.1\n" + rows + "\nmov r0, t3\n").faults,
            "5:1: 'texm3x3spec' needs a constant with the eye vector, such as c0\n");
  // A list of faults that is full takes no more, and the stages are not gone on with.
  std::string many = "ps.1.1\n" + rows + "\nmov r0, t3\n";
  for (std::size_t i = 0; i < kMaxTextFaults; ++i) many += "mov r0, v0_sat\n";
  const std::string found = read_shader(many).faults;
  EXPECT_EQ(std::count(found.begin(), found.end(), '\n'), static_cast<std::ptrdiff_t>(kMaxTextFaults));
}

// ps.1.4 divides by the third coordinate or not at all, and the stages by q.
TEST(ShaderTextures, CoordinatesHaveNoModifiers) {
  const auto read = [](const std::string& from) {
    return read_shader("ps.1.4\ntexcrd r0.rgb, t0\ntexld r1, " + from + "\nmov r0, r1\n");
  };
  for (const std::string from : {"t1_dz", "t1_dw", "t1_bx2", "t1_of"}) {
    EXPECT_EQ(read(from + ".xyz").faults, "3:11: '" + from +
                                              "' has a modifier; the texture shaders of the GeForce3 have none for "
                                              "coordinates\n");
  }
  const ReadShader plain = read("t1");
  EXPECT_EQ(plain.faults, "");
  const std::string note = "3:1: the coordinates of texture stage 1 are divided by q, which ps.1.4 does not do";
  EXPECT_EQ(std::count(plain.notes.begin(), plain.notes.end(), note), 1);
  // Where the stages only read textures, the combiners alone are read.
  EXPECT_EQ(read_shader("ps.1.4\ntexld r0, t0_dz.xyz\nmov r0, r0\n").faults, "");
}

// Stages that a ps.1.1 text can have, with some that it cannot.
TextureShaderState shader_stages(Random& random) {
  TextureShaderState stages = only_used(random_stages(random));
  stages.converts_yuv = false;
  stages.depth_unit = DepthUnit::window;
  for (TextureStage& stage : stages.stage) {
    if (stage.operation < TextureOperation::pass_through) stage.operation = TextureOperation::texture_2d;
    if (random.one_in(12)) continue;
    stage.matrix = TextureStage{}.matrix;
    stage.scale = 1.0F;
    stage.bias = 0.0F;
    stage.cull = {};
    stage.previous = 0;
    if (stage.mapping != DotMapping::zero_to_one) stage.mapping = DotMapping::minus1_to_1_d3d;
  }
  if (random.one_in(2)) stages.stage[0] = {.operation = TextureOperation::texture_2d};
  return stages;
}

TEST(ShaderTextures, RandomStagesComeBackFromTextAndTokens) {
  int printed = 0;
  const auto color = parse_pixel_shader({"ps.1.1\nmov r0, v0\n", ""}, profiles::nv2a);
  ASSERT_TRUE(color);
  for (int i = 0; i < (kSlowBuild ? 600 : 6000); ++i) {
    Random random(65, static_cast<std::uint64_t>(i));
    const TextureShaderState stages = shader_stages(random);
    const auto text = print_pixel_shader(*color, profiles::nv2a, stages);
    if (!text) {
      ASSERT_TRUE(text.error().message.starts_with("ps.1.1 cannot express this: ")) << text.error().message;
      continue;
    }
    TextureShaderState back, from_tokens, expected = stages;
    expected.rules = StageRules::open_gl;
    const bool is_plain = std::all_of(stages.stage.begin(), stages.stage.end(), [](const TextureStage& stage) {
      return stage.operation <= TextureOperation::texture_2d;
    });
    if (is_plain) expected = {};
    ++printed;
    const auto parsed = parse_pixel_shader({*text, "f"}, profiles::nv2a, {}, {}, &back);
    ASSERT_TRUE(parsed) << all_faults(parsed) << *text;
    ASSERT_EQ(back, expected) << *text;
    ASSERT_EQ(normalize(*parsed, profiles::nv2a), normalize(*color, profiles::nv2a));
    const auto tokens = print_shader_tokens(*color, profiles::nv2a, stages);
    ASSERT_TRUE(tokens);
    const auto assembled = parse_shader_tokens({*tokens, "f"}, profiles::nv2a, &from_tokens);
    ASSERT_TRUE(assembled) << all_faults(assembled) << *tokens;
    ASSERT_EQ(from_tokens, expected) << *tokens;
  }
  EXPECT_GT(printed, kSlowBuild ? 40 : 400);
}

}  // namespace
}  // namespace ninebit::test

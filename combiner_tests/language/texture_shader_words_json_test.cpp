// Texture-shader stages in the Xbox's words, in definitions, register words and logs, and their equations.
#include <gtest/gtest.h>

#include <bit>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/language/xbox_shapes.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/random_stages.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/json.h"
#include "ninebit/language/program_text.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

// Stages that the words can have: of no kind of texture that they leave to the texture, with what they hold.
TextureShaderState word_stages(Random& random) {
  TextureShaderState stages = random_stages(random);
  stages.rules = StageRules::nv2a;
  stages.depth_unit = DepthUnit::codes;
  stages.converts_yuv = false;
  for (TextureStage& stage : stages.stage) {
    const StageTarget target = info_of(stage.operation).target;
    const bool is_left = target == StageTarget::one_dimensional || target == StageTarget::rectangle;
    if (is_left) stage.operation = TextureOperation::texture_2d;
    stage.matrix = TextureStage{}.matrix;
    stage.scale = 1.0F;
    stage.bias = 0.0F;
    stage.eye = TextureStage{}.eye;
  }
  if (stages.stage[0].operation == TextureOperation::none) stages.stage[0].operation = TextureOperation::texture_2d;
  stages.stage[0].mapping = DotMapping::zero_to_one;
  return stages;
}

TEST(StageWords, RandomStagesComeBackFromEveryForm) {
  for (int i = 0; i < (kSlowBuild ? 100 : 800); ++i) {
    Random random(66, static_cast<std::uint64_t>(i));
    TextProgram program;
    program.texture_shader = word_stages(random);
    for (const char* const name : {"xbox", "words", "words-json", "json"}) {
      const auto text = find_form(name)->print(program, ChipClass::nv20, profiles::nv2a);
      ASSERT_TRUE(text) << text.error().message;
      ASSERT_EQ(form_of(*text), form_id(*find_form(name))) << *text;
      const auto back = parse_program({*text, "f"}, form_of(*text), profiles::nv2a);
      ASSERT_TRUE(back) << all_faults(back) << *text;
      ASSERT_EQ(back->texture_shader, program.texture_shader) << *text;
      ASSERT_EQ(*find_form(name)->print(*back, ChipClass::nv20, profiles::nv2a), *text);
    }
  }
}

Parsed<TextProgram> words_of(const std::string& words, const HardwareProfile& profile = profiles::nv2a) {
  return parse_program({"RC_ENABLE = 0x101\n" + words, "f"}, ProgramForm::words, profile, {.chip = ChipClass::nv20});
}

TEST(StageWords, MeanWhatTheChipDoes) {
  const auto program = words_of(
      "PSTextureModes = 0x00049a21\nPSDotMapping = 0x00000371\nPSInputTexture = 0x00100000\nPSCompareMode = "
      "0x00008001\n");
  ASSERT_TRUE(program) << all_faults(program);
  const auto& stage = program->texture_shader.stage;
  EXPECT_EQ(stage[0].operation, TextureOperation::texture_2d);
  EXPECT_EQ(stage[1].operation, TextureOperation::dot_product);
  EXPECT_EQ(stage[2].operation, TextureOperation::offset_2d);
  EXPECT_EQ(stage[3].operation, TextureOperation::dot_product_2d);
  EXPECT_EQ(stage[1].mapping, DotMapping::minus1_to_1_d3d);
  EXPECT_EQ(stage[2].mapping, DotMapping::hilo_hemisphere);
  EXPECT_EQ(stage[3].mapping, DotMapping::minus1_to_1);
  EXPECT_EQ(stage[3].previous, 1);
  EXPECT_EQ(stage[0].cull[0], CullMode::kills_not_negative);
  EXPECT_EQ(stage[3].cull[3], CullMode::kills_not_negative);
  EXPECT_TRUE(program->other_words.empty());
  EXPECT_EQ(program->texture_shader.depth_unit, DepthUnit::codes);
}

TEST(StageWords, WhatIsNotModelledIsKeptWithANote) {
  const std::pair<const char*, const char*> words[] = {
      {"PSTextureModes = 0x00040021\n", "brdf is not modelled: no picture of the NV2A decides what it computes"},
      {"PSTextureModes = 0x00000013\n", "PSTextureModes has the reserved mode 0x13"},
      {"PSTextureModes = 0x80000001\n", "PSTextureModes has unknown bit 31"},
      {"PSTextureModes = 0x1801\nPSInputTexture = 0x00030000\n", "the previous stage is 3"},
      {"PSTextureModes = 0x221\nPSDotMapping = 5\n", "the NV2A refuses the dot-product mappings 5 and 6"},
  };
  for (const auto& [text, why] : words) {
    const auto program = words_of(text);
    ASSERT_TRUE(program) << all_faults(program);
    EXPECT_FALSE(program->texture_shader.enabled) << text;
    EXPECT_FALSE(program->other_words.empty()) << text;
    ASSERT_EQ(program.notes.size(), 1U) << text;
    EXPECT_TRUE(has(program.notes[0].text(), why));
    EXPECT_EQ(program.notes[0].line, 2) << text;
  }
  // No modes are no stages.
  EXPECT_FALSE(words_of("PSDotMapping = 1\n")->texture_shader.enabled);
}

TEST(StageWords, AnOlderChipRefusesThem) {
  const auto plain = words_of("PSTextureModes = 1\n", profiles::geforce2);
  ASSERT_TRUE(plain) << all_faults(plain);
  EXPECT_FALSE(plain->texture_shader.enabled);
  EXPECT_EQ(plain->other_words.size(), 1U);
  const auto program = words_of("PSTextureModes = 4\n", profiles::geforce2);
  ASSERT_TRUE(program) << all_faults(program);
  const auto refused = validate(*program, profiles::geforce2);
  ASSERT_EQ(refused.size(), 1U);
  EXPECT_EQ(refused[0].gl_error, GlError::invalid_enum);
  EXPECT_EQ(refused[0].message,
            "profile geforce2 has no texture shaders (NV_texture_shader); expected a profile that has, such as nv2a");
}

TEST(StageWords, WhatTheyCannotExpressIsNamed) {
  TextProgram program;
  program.texture_shader.enabled = true;
  const auto why = [&] { return find_form("xbox")->print(program, ChipClass::nv20, profiles::nv2a).error().message; };
  EXPECT_EQ(why(), "the Xbox's words cannot express this: stages that are enabled, though all are none");
  program.texture_shader.stage[0].operation = TextureOperation::texture_rectangle;
  EXPECT_EQ(
      why(),
      "the Xbox's words cannot express this: texture stage 0: texture_rectangle; PROJECT2D reads the kind that the "
      "texture has");
  program.texture_shader.stage[0].operation = TextureOperation::texture_2d;
  program.texture_shader.stage[1].operation = TextureOperation::dot_product;
  program.texture_shader.stage[2].operation = TextureOperation::dot_product_depth_replace;
  EXPECT_EQ(
      why(),
      "the Xbox's words cannot express this: replaced depths from 0 to 1; the NV2A's are codes of the depth buffer");
}

std::string float_row(const std::string& method, float value) {
  return "0x97," + method + "," + hex(std::bit_cast<std::uint32_t>(value)) + "\n";
}

TEST(StageWords, LogsHaveMatricesAndEyesToo) {
  std::string log = "class,method,data\n0x97,0x1e60,0x101\n0x97,0x1e70,0xc1\n0x97,0x290,0x10100001\n";
  for (int k = 0; k < 4; ++k)
    log += float_row(hex(static_cast<std::uint32_t>(0x1b68 + 4 * k)), static_cast<float>(k + 1));
  log += float_row("NV097_SET_TEXTURE_SET_BUMP_ENV_SCALE[1]", 0.5F);
  log += float_row("0x1b7c", 0.25F) + float_row("0x1820", -3.0F) + "0x97,0x17fc,5\n0x97,0x17fc,0\n";
  const auto program = parse_program({log, "f"}, ProgramForm::log, profiles::nv2a);
  ASSERT_TRUE(program) << all_faults(program);
  const TextureShaderState& stages = program->texture_shader;
  EXPECT_TRUE(stages.enabled);
  EXPECT_TRUE(stages.converts_yuv);
  EXPECT_EQ(stages.stage[1].operation, TextureOperation::offset_2d);
  EXPECT_EQ(stages.stage[1].matrix, (std::array{1.0F, 2.0F, 4.0F, 3.0F}));
  EXPECT_EQ(stages.stage[1].scale, 0.5F);
  EXPECT_EQ(stages.stage[1].bias, 0.25F);
  EXPECT_EQ(stages.stage[3].eye, (std::array{0.0F, -3.0F, -1.0F}));
  const auto nan =
      parse_program({log.substr(0, log.find("0x97,0x17fc")) + "0x97,0x1b68,0x7fc00000\n0x97,0x17fc,5\n", "f"},
                    ProgramForm::log, profiles::nv2a);
  ASSERT_TRUE(nan);
  EXPECT_FALSE(nan->texture_shader.enabled);
  EXPECT_TRUE(has(nan.notes.back().text(), "the bump matrix of texture stage 1 is not a finite number"));
}

// Draws whose stages differ in anything that has an effect have set-ups of their own.
TEST(StageWords, SetUpsOfLogsDifferInStages) {
  const auto setups = [](const std::string& between) {
    const std::string draw = "0x97,0x17fc,5\n0x97,0x17fc,0\n";
    std::string log = "class,method,data\n0x97,0x1e60,0x101\n0x97,0x1e70,0xc1\n";
    for (int k = 0; k < 4; ++k) log += float_row(hex(static_cast<std::uint32_t>(0x1b68 + 4 * k)), 1.0F);
    log += draw;
    log += between;
    log += draw;
    const auto parsed = parse_register_log({log, "f"});
    if (!parsed) return std::vector<std::uint64_t>{};
    std::vector<std::uint64_t> draws;
    for (const LogSetup& setup : parsed->setups) draws.push_back(setup.draws);
    if (draws.size() == 2) {
      EXPECT_NE(text_program_of(*parsed, 1, "f", profiles::nv2a)->texture_shader,
                text_program_of(*parsed, 2, "f", profiles::nv2a)->texture_shader);
    }
    return draws;
  };
  using Draws = std::vector<std::uint64_t>;
  EXPECT_EQ(setups(float_row("0x1b6c", 3.0F)), (Draws{1, 1})) << "a bump matrix";
  EXPECT_EQ(setups("0x97,0x1e70,0x10e1\n"), (Draws{1, 1})) << "an operation";
  EXPECT_EQ(setups("0x97,0x290,0x10100001\n"), (Draws{1, 1})) << "the conversion from YUV";
  EXPECT_EQ(setups(""), (Draws{2}));
  EXPECT_EQ(setups(float_row("0x1b6c", 3.0F) + float_row("0x1b6c", 1.0F)), (Draws{2})) << "written and taken back";
  EXPECT_EQ(setups(float_row("0x1b78", 3.0F)), (Draws{2})) << "a scale that nothing reads";
  EXPECT_EQ(setups("0x97,0x1e74,0x1\n"), (Draws{2})) << "a dot mapping that nothing reads";
  EXPECT_EQ(setups("0x97,0x290,0x00100001\n"), (Draws{2})) << "bits of CONTROL0 for stencil and depth";
}

// Every program in one form is the same in the others that can have it.
TEST(StageForms, ProgramsGoFromFormToForm) {
  for (const char* const text :
       {"!!TS1.0\ntexture_2d();\noffset_2d(tex0, 1, 0, 0, 1);\n!!RC1.0\nout.rgb = tex1;\n",
        "!!TS1.0\ntexture_2d();\ndot_product_cube_map_1of3(expand(tex0));\ndot_product_cube_map_2of3(expand(tex0));\n"
        "dot_product_cube_map_3of3(expand(tex0));\n!!RC1.0\nout.rgb = tex3;\n"}) {
    const auto first = parse_program({text, "f"}, ProgramForm::rc10, profiles::nv2a);
    ASSERT_TRUE(first) << all_faults(first);
    for (const char* const name : {"gl", "rc10", "json", "xbox", "words", "words-json", "ps11", "tokens"}) {
      const auto printed = find_form(name)->print(*first, ChipClass::nv20, profiles::nv2a);
      ASSERT_TRUE(printed) << name << ": " << printed.error().message;
      const auto back = parse_program({*printed, "f"}, form_of(*printed), profiles::nv2a);
      ASSERT_TRUE(back) << name << all_faults(back) << *printed;
      TextureShaderState stages = back->texture_shader;
      stages.rules = first->texture_shader.rules;
      EXPECT_EQ(only_used(stages), only_used(first->texture_shader)) << *printed;
    }
    for (const char* const name : {"glsl", "glsl-es"}) {
      const auto glsl = find_form(name)->print(*first, ChipClass::nv20, profiles::nv2a);
      ASSERT_TRUE(glsl) << glsl.error().message;
      EXPECT_TRUE(has(*glsl, "bool ninebit_texture_shader(vec4 at0"));
    }
    EXPECT_TRUE(find_form("c")->print(*first, ChipClass::nv20, profiles::nv2a));
  }
}

TEST(StageEquations, SayWhatStagesDo) {
  TextureShaderState stages;
  EXPECT_EQ(print_stages(stages), "");
  stages.enabled = true;
  stages.stage[0].operation = TextureOperation::texture_2d;
  stages.stage[1] = {
      .operation = TextureOperation::offset_2d_scale, .matrix = {1, 0, 0.5F, 2}, .scale = 3, .bias = 0.25F};
  stages.stage[2].operation = TextureOperation::cull_fragment;
  stages.stage[2].cull[1] = CullMode::kills_not_negative;
  stages.stage[3] = {.operation = TextureOperation::dependent_ar, .previous = 1};
  EXPECT_EQ(print_stages(stages),
            "texture shader\n"
            "  tex0 = texture 0 at (s0, t0) / q0\n"
            "  tex1 = texture 1 at (s1 + 1·ds(tex0) + 0.5·dt(tex0), t1 + 0·ds(tex0) + 2·dt(tex0))\n"
            "  tex1.rgb × (3·tex0.red + 0.25)\n"
            "  the fragment is killed if s2 < 0 or t2 ≥ 0 or r2 < 0 or q2 < 0\n"
            "  tex3 = texture 3 at (tex1.a, tex1.red)\n");
  stages.stage[1] = {.operation = TextureOperation::dot_product, .mapping = DotMapping::minus1_to_1_d3d};
  stages.stage[2] = stages.stage[1];
  stages.stage[3] = {.operation = TextureOperation::dot_product_const_eye_reflect_cube_map};
  const std::vector<std::string> lines = explain_stages(stages);
  ASSERT_EQ(lines.size(), 5U);
  EXPECT_EQ(lines[1], "dot1 = dot((s1, t1, r1), expand(tex0))");
  EXPECT_EQ(lines[4], "tex3 = texture 3 at reflect((dot1, dot2, dot3), (0, 0, -1))");
  // Every operation says something, and only what is there.
  for (const TextureOperationInfo& info : texture_operations()) {
    TextureShaderState one;
    one.enabled = true;
    one.stage[info.last].operation = info.operation;
    const bool is_silent = info.operation == TextureOperation::none || info.operation == TextureOperation::brdf;
    EXPECT_EQ(explain_stages(one).empty(), is_silent) << info.name;
  }
}

}  // namespace
}  // namespace ninebit::test

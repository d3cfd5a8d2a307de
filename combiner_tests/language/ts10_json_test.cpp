// The part !!TS1.0 of nvparse's texts: what lines mean, round trips, every fault with its place.
#include <gtest/gtest.h>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/random_stages.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/program_text.h"
#include "ninebit/language/rc10.h"
#include "ninebit/texture_shader/validate_stages.h"

namespace ninebit::test {
namespace {

constexpr const char* kPlainCombiner = "!!RC1.0\nout.rgb = tex0;\nout.a = tex0.a;\n";

TextureShaderState stages_of(const std::string& lines) {
  TextureShaderState stages;
  const std::string text = "!!TS1.0\n" + lines + kPlainCombiner;
  const auto parsed = parse_rc10({text, "f"}, profiles::nv2a, &stages);
  EXPECT_TRUE(parsed) << all_faults(parsed) << text;
  return stages;
}

// Lines and their faults.
void expect_ts10(const std::vector<TextAndFaults>& cases, const HardwareProfile& profile = profiles::nv2a) {
  expect_faults(cases, [&](const std::string& lines) {
    TextureShaderState stages;
    return parse_rc10({"!!TS1.0\n" + lines + "\n" + kPlainCombiner, {}}, profile, &stages);
  });
}

TEST(Ts10, EveryLineTakesTheNextStage) {
  const TextureShaderState stages = stages_of(
      "# four lines\ntexture_2d(); // tex0\noffset_2d_scale(tex0, 0.5, -1, +2., .25, 3, -0.125);\npass_through();\n"
      "cull_fragment(GEQUAL_TO_ZERO, LESS_THAN_ZERO, GEQUAL_TO_ZERO, LESS_THAN_ZERO);\n");
  TextureShaderState expected;
  expected.enabled = true;
  expected.stage[0].operation = TextureOperation::texture_2d;
  expected.stage[1].operation = TextureOperation::offset_2d_scale;
  expected.stage[1].matrix = {0.5F, -1.0F, 2.0F, 0.25F};
  expected.stage[1].scale = 3.0F;
  expected.stage[1].bias = -0.125F;
  expected.stage[2].operation = TextureOperation::pass_through;
  expected.stage[3].operation = TextureOperation::cull_fragment;
  expected.stage[3].cull = {CullMode::kills_negative, CullMode::kills_not_negative, CullMode::kills_negative,
                            CullMode::kills_not_negative};
  EXPECT_EQ(stages, expected);
}

TEST(Ts10, TheEyeOfTheFirstLineIsThatOfTheLastStage) {
  const TextureShaderState stages = stages_of(
      "texture_2d();\ndot_product_reflect_cube_map_const_eye_1of3(expand(tex0), 1, 2, 3);\n"
      "dot_product_reflect_cube_map_const_eye_2of3(tex0);\ndot_product_reflect_cube_map_const_eye_3of3(expand(tex0));"
      "\n");
  EXPECT_EQ(stages.stage[1].operation, TextureOperation::dot_product);
  EXPECT_EQ(stages.stage[1].mapping, DotMapping::minus1_to_1_d3d);
  EXPECT_EQ(stages.stage[1].eye, TextureStage{}.eye);
  EXPECT_EQ(stages.stage[2].mapping, DotMapping::zero_to_one);
  EXPECT_EQ(stages.stage[3].operation, TextureOperation::dot_product_const_eye_reflect_cube_map);
  EXPECT_EQ(stages.stage[3].eye, (std::array{1.0F, 2.0F, 3.0F}));
}

TEST(Ts10, StandsAlone) {
  const std::string text = "// a comment\n!!TS1.0\ntexture_2d();\n";
  EXPECT_EQ(form_of(text), ProgramForm::rc10);
  const auto program = parse_program({text, "f"}, ProgramForm::rc10, profiles::nv2a);
  ASSERT_TRUE(program) << all_faults(program);
  EXPECT_TRUE(program->texture_shader.enabled);
  EXPECT_EQ(program->state, CombinerState{});
  ASSERT_EQ(program.notes.size(), 1U);
  EXPECT_EQ(program.notes[0].text(), "f:2:1: there is no !!RC1.0; the register combiners have OpenGL's defaults");
}

TEST(Ts10, RandomStagesComeBackWhereTheyCanBeSaid) {
  int said = 0;
  for (int i = 0; i < 6000; ++i) {
    Random random(62, static_cast<std::uint64_t>(i));
    TextureShaderState stages = random_stages(random);
    for (TextureStage& stage : stages.stage) {
      if (!random.one_in(8)) stage.mapping = random.pick({DotMapping::zero_to_one, DotMapping::minus1_to_1_d3d});
      if (!random.one_in(8)) stage.previous = 0;
    }
    if (!random.one_in(8)) stages.converts_yuv = false;
    const auto text = print_rc10({}, profiles::nv2a, stages);
    if (!text) {
      ASSERT_TRUE(text.error().message.starts_with("!!TS1.0 cannot express this: ")) << text.error().message;
      continue;
    }
    ++said;
    TextureShaderState back;
    const auto parsed = parse_rc10({*text, "f"}, profiles::nv2a, &back);
    ASSERT_TRUE(parsed) << all_faults(parsed) << *text;
    ASSERT_TRUE(parsed.notes.empty());
    TextureShaderState expected = only_used(stages);
    expected.rules = StageRules::open_gl;
    ASSERT_EQ(back, expected) << *text;
    ASSERT_EQ(*print_rc10({}, profiles::nv2a, back), *text);
    ASSERT_EQ(normalize(*parsed, profiles::nv2a), normalize({}, profiles::nv2a));
  }
  EXPECT_GT(said, 600);
}

TEST(Ts10, EveryChainComesBack) {
  for (const TextureOperation last :
       {TextureOperation::dot_product_2d, TextureOperation::dot_product_rectangle, TextureOperation::dot_product_3d,
        TextureOperation::dot_product_cube_map, TextureOperation::dot_product_depth_replace,
        TextureOperation::dot_product_reflect_cube_map, TextureOperation::dot_product_const_eye_reflect_cube_map}) {
    for (const bool has_diffuse : {false, true}) {
      TextureShaderState stages;
      stages.enabled = true;
      stages.stage[0].operation = TextureOperation::texture_2d;
      const auto before = static_cast<std::size_t>(info_of(last).dots_before);
      for (std::size_t i = 1; i <= before; ++i) stages.stage[i].operation = TextureOperation::dot_product;
      stages.stage[before + 1].operation = last;
      if (has_diffuse) stages.stage[2].operation = TextureOperation::dot_product_diffuse_cube_map;
      const auto text = print_rc10({}, profiles::nv2a, stages);
      const bool reflects = last >= TextureOperation::dot_product_reflect_cube_map;
      ASSERT_EQ(static_cast<bool>(text), !has_diffuse || reflects) << info_of(last).name;
      if (!text) continue;
      TextureShaderState back;
      ASSERT_TRUE(parse_rc10({*text, "f"}, profiles::nv2a, &back)) << *text;
      EXPECT_EQ(back, stages) << *text;
    }
  }
}

TEST(Ts10, FaultsHaveTheirPlaces) {
  expect_ts10({
      {"texture_2();",
       "2:1: 'texture_2' is not a line of !!TS1.0; expected texture_2d, nop, …; did you mean 'texture_2d'?\n"},
      {"texture_2d;", "2:11: expected '(', found ';'\n"},
      {"texture_2d()\n}nop();",
       "3:1: expected ';', found '}'\n3:1: '}' is not a line of !!TS1.0; "
       "expected texture_2d, nop, …\n"},
      {"nop();nop();nop();nop();\nnop();", "3:1: too many lines; there are 4 texture-shader stages\n"},
      {"texture_2d();\ndependent_ar(tex1);", "3:14: GL_INVALID_OPERATION: 'tex1' is not a stage before this line\n"},
      {"texture_2d();\ndependent_ar(tex4);",
       "3:14: expected tex0, tex1 or tex2, found 'tex4'; did "
       "you mean 'tex0'?\n"},
      {"nop();\ndependent_ar(tex0);", "3:14: 'tex0' has no texel: its stage is none\n"},
      {"texture_2d();\ndependent_ar(expand(tex0));",
       "3:14: expected tex0, tex1 or tex2, found "
       "'expand'\n"},
      {"texture_2d();\ndot_product_2d_1of2(tex0);\ndot_product_2d_2of2(tex1);",
       "4:21: GL_INVALID_OPERATION: 'tex1' is not a stage before this line's chain\n"},
      {"texture_2d();\ndot_product_2d_2of2(tex0);",
       "3:1: 'dot_product_2d_2of2' must stand behind dot_product_2d_1of2\n"},
      {"texture_2d();\ndot_product_2d_1of2(tex0);\nnop();", "3:1: expected dot_product_2d_2of2 behind this line\n"},
      {"texture_2d();\ndot_product_3d_1of3(tex0);\ndot_product_cube_map_2of3(tex0);",
       "4:1: 'dot_product_cube_map_2of3' must stand behind dot_product_cube_map_1of3\n"
       "4:1: expected dot_product_cube_map_3of3 behind this line\n"},
      {"cull_fragment(GEQUAL_TO_ZERO, LESS);",
       "2:31: expected GEQUAL_TO_ZERO or LESS_THAN_ZERO, "
       "found 'LESS'\n"},
      {"texture_2d();\noffset_2d(tex0, 1, 0, 0);", "3:24: expected ',', found ')'\n"},
  });
  const std::string large(310, '9');
  expect_ts10({
      {"texture_2d();\noffset_2d(tex0, 1, 0, 0, -" + large + ");",
       "3:26: '-" + large.substr(0, 39) + "…' is too large\n"},
      {"texture_2d();\noffset_2d(tex0, 1, 0, 0, 0." + std::string(400, '0') + "1);", ""},
      {"texture_cubemap();", "2:1: 'texture_cubemap' is not a line of !!TS1.0; did you mean 'texture_cube_map'?\n"},
      // What GL refuses: a chain that begins too early, and a card without the extension.
      {"texture_2d();\nnop();\n!!TS1.0 nop();", "4:1: there is a part !!TS1.0 already; expected one\n"},
  });
  expect_ts10({{"texture_2d();",
                "1:1: GL_INVALID_ENUM: profile geforce2 has no texture shaders (NV_texture_shader); expected a profile "
                "that has, such as nv2a\n"}},
              profiles::geforce2);
}

TEST(Ts10, WhatItCannotExpressIsNamed) {
  TextureShaderState stages;
  stages.enabled = true;
  const auto why = [&] { return print_rc10({}, profiles::nv2a, stages).error().message; };
  stages.stage[1].operation = TextureOperation::dot_product;
  EXPECT_EQ(why(), "!!TS1.0 cannot express this: texture stage 1: dot_product that is not in a chain of dot products");
  stages.stage[0].operation = TextureOperation::texture_2d;
  stages.stage[2].operation = TextureOperation::dot_product_2d;
  stages.stage[2].mapping = DotMapping::hilo_1;
  EXPECT_EQ(why(),
            "!!TS1.0 cannot express this: OpenGL has no dot-product mapping but that of 0 to 1 and (x - 128) / 127 "
            "(texture stage 2)");
  stages.stage[2].mapping = DotMapping::zero_to_one;
  stages.stage[2].previous = 1;
  EXPECT_EQ(why(), "!!TS1.0 cannot express this: texture stage 2: the previous stage 1 is in the same chain");
  stages.stage[2].previous = 0;
  stages.stage[0].operation = TextureOperation::none;
  EXPECT_EQ(why(), "!!TS1.0 cannot express this: texture stage 1: the previous stage 0 has no texel");
}

}  // namespace
}  // namespace ninebit::test

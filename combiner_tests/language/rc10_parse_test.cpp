// The meaning of each construct of !!RC1.0.
#include <gtest/gtest.h>

#include <array>
#include <string>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/rc10.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

CombinerState parsed(const std::string& text, const HardwareProfile& profile = profiles::nv2a) {
  const auto result = parse_rc10({text, "p.rc"}, profile);
  for (const TextFault& fault : result.faults()) ADD_FAILURE() << fault.text() << "\n" << text;
  const CombinerState state = result ? *result : CombinerState{};
  EXPECT_TRUE(validate(state, profile).empty()) << text;
  return state;
}

Portion rgb_portion(const std::string& statements) {
  return parsed("!!RC1.0 { rgb { " + statements + " } } out.rgb = spare0;").general[0].rgb;
}
Portion alpha_portion(const std::string& statements) {
  return parsed("!!RC1.0 { alpha { " + statements + " } } out.rgb = spare0;").general[0].alpha;
}
FinalCombiner final_of(const std::string& statements) {
  return parsed("!!RC1.0 " + statements).final_combiner;
}

using enum Register;
using M = InputMapping;
constexpr auto kRgb = ComponentUsage::rgb, kAlphaUsage = ComponentUsage::alpha, kBlueUsage = ComponentUsage::blue;
constexpr CombinerInput kZeroRgb{}, kOneRgb{zero, M::unsigned_invert, kRgb};
constexpr CombinerInput kZeroAlpha{zero, M::unsigned_identity, kAlphaUsage};
constexpr CombinerInput kOneAlpha{zero, M::unsigned_invert, kAlphaUsage};

TEST(Rc10, MappingsAreSignedUnlessTheySayOtherwise) {
  const std::array<std::pair<const char*, M>, 8> mappings{{{"tex1", M::signed_identity},
                                                           {"-tex1", M::signed_negate},
                                                           {"expand(tex1)", M::expand_normal},
                                                           {"-expand(tex1)", M::expand_negate},
                                                           {"half_bias(tex1)", M::half_bias_normal},
                                                           {"-half_bias ( tex1 )", M::half_bias_negate},
                                                           {"unsigned(tex1)", M::unsigned_identity},
                                                           {"unsigned_invert(tex1)", M::unsigned_invert}}};
  for (const auto& [text, mapping] : mappings) {
    const Portion portion = rgb_portion(std::string("spare1 = ") + text + " * col0;");
    EXPECT_TRUE(portion.a == (CombinerInput{texture1, mapping, kRgb})) << text;
    EXPECT_TRUE(portion.b == (CombinerInput{primary, M::signed_identity, kRgb}));
    EXPECT_TRUE(portion.c == kZeroRgb && portion.d == kZeroRgb);
    EXPECT_TRUE(portion.out == (PortionOutput{.ab = spare1, .sum = discard}));
  }
}

TEST(Rc10, OneIsOneInEverySpelling) {
  const std::array<std::pair<const char*, M>, 8> spellings{{{"%", M::unsigned_invert},
                                                            {"unsigned(%)", M::unsigned_invert},
                                                            {"unsigned_invert(%)", M::unsigned_identity},
                                                            {"expand(%)", M::unsigned_invert},
                                                            {"-%", M::expand_normal},
                                                            {"-expand(%)", M::expand_normal},
                                                            {"half_bias(%)", M::half_bias_negate},
                                                            {"-half_bias(%)", M::half_bias_normal}}};
  const std::array<std::pair<const char*, ComponentUsage>, 3> in_rgb{
      {{"one", kRgb}, {"one.rgb", kRgb}, {"one.a", kAlphaUsage}}};
  const std::array<std::pair<const char*, ComponentUsage>, 3> in_alpha{
      {{"one", kAlphaUsage}, {"one.a", kAlphaUsage}, {"one.b", kBlueUsage}}};
  for (auto [spelling, mapping] : spellings) {
    for (const bool alpha : {false, true}) {
      for (const auto& [name, usage] : alpha ? in_alpha : in_rgb) {
        std::string text = spelling;
        text.replace(text.find('%'), 1, name);
        const Portion portion = (alpha ? alpha_portion : rgb_portion)("spare1 = col0 * " + text + ";");
        EXPECT_TRUE(portion.b == (CombinerInput{zero, mapping, usage})) << text;
      }
    }
  }
  EXPECT_TRUE(final_of("out.rgb = one; out.a = one.b;").d == kOneRgb);
  EXPECT_TRUE(final_of("out.rgb = one; out.a = one.b;").g == (CombinerInput{zero, M::unsigned_invert, kBlueUsage}));
  EXPECT_TRUE(final_of("out.rgb = unsigned(one.a);").d == kOneAlpha);
  EXPECT_TRUE(final_of("out.rgb = unsigned_invert(one);").d == kZeroRgb);
}

TEST(Rc10, EveryRegisterAndSuffixHasItsWord) {
  const std::array<std::pair<const char*, Register>, 12> names{{{"zero", zero},
                                                                {"const0", constant0},
                                                                {"const1", constant1},
                                                                {"fog", fog},
                                                                {"col0", primary},
                                                                {"col1", secondary},
                                                                {"spare0", spare0},
                                                                {"spare1", spare1},
                                                                {"tex0", texture0},
                                                                {"tex1", texture1},
                                                                {"tex2", texture2},
                                                                {"tex3", texture3}}};
  for (const auto& [name, reg] : names) {
    const std::string n = name;
    EXPECT_TRUE(rgb_portion("spare0 = " + n + ".rgb;").a == (CombinerInput{reg, M::signed_identity, kRgb}));
    EXPECT_TRUE(alpha_portion("spare0 = " + n + ".b;").a == (CombinerInput{reg, M::signed_identity, kBlueUsage}));
    EXPECT_TRUE(final_of("out.rgb = " + n + ".a;").d == (CombinerInput{reg, M::unsigned_identity, kAlphaUsage}));
    if (reg == fog) continue;
    EXPECT_TRUE(rgb_portion("spare0 = " + n + ".a;").a == (CombinerInput{reg, M::signed_identity, kAlphaUsage}));
    EXPECT_TRUE(alpha_portion("spare0 = " + n + ";").a == (CombinerInput{reg, M::signed_identity, kAlphaUsage}));
  }
}

TEST(Rc10, StatementsFillAbThenCdThenTheSum) {
  Portion portion = rgb_portion("discard = tex0.tex1; col1=-col0 . fog.rgb;");
  EXPECT_TRUE(portion.out ==
              (PortionOutput{.cd = secondary, .sum = discard, .ab_dot_product = true, .cd_dot_product = true}));
  EXPECT_TRUE(portion.b == (CombinerInput{texture1, M::signed_identity, kRgb}));
  EXPECT_TRUE(portion.d == (CombinerInput{fog, M::signed_identity, kRgb}));
  portion = rgb_portion("spare0.rgb = tex0 * tex1; spare1 = tex0.rgb.tex1.rgb;");
  EXPECT_TRUE(portion.out == (PortionOutput{.ab = spare0, .cd = spare1, .sum = discard, .cd_dot_product = true}));
  portion = rgb_portion("discard = tex0; discard = col0; spare0 = sum();");
  EXPECT_TRUE(portion.out == PortionOutput{});
  EXPECT_TRUE(portion.b == kOneRgb && portion.d == kOneRgb);
  portion = alpha_portion("spare0 = tex0; col0.b = col0 * half_bias(tex1.b); tex1.a = mux ( );");
  EXPECT_TRUE(portion.out == (PortionOutput{.ab = spare0, .cd = primary, .sum = texture1, .mux_sum = true}));
  EXPECT_TRUE(portion.b == kOneAlpha);
}

TEST(Rc10, ScaleAndBiasComeLast) {
  const auto options = [](const std::string& name) {
    const PortionOutput out = rgb_portion("spare0 = tex0; " + name).out;
    return std::pair(out.scale, out.bias);
  };
  EXPECT_EQ(options(""), std::pair(Scale::none, Bias::none));
  EXPECT_EQ(options("scale_by_one_half();"), std::pair(Scale::by_one_half, Bias::none));
  EXPECT_EQ(options("scale_by_two();"), std::pair(Scale::by_two, Bias::none));
  EXPECT_EQ(options("scale_by_four();"), std::pair(Scale::by_four, Bias::none));
  EXPECT_EQ(options("bias_by_negative_one_half();"), std::pair(Scale::none, Bias::by_negative_one_half));
  EXPECT_EQ(options("bias_by_negative_one_half_scale_by_two();"), std::pair(Scale::by_two, Bias::by_negative_one_half));
}

TEST(Rc10, WhatIsMissingIsZero) {
  const CombinerState state = parsed("!!RC1.0 out.a = spare0;", profiles::geforce2);
  EXPECT_EQ(state.num_general_combiners, 1);
  EXPECT_FALSE(state.color_sum_clamp);
  EXPECT_FALSE(is_live(state.general[0].rgb.out) || is_live(state.general[0].alpha.out));
  FinalCombiner wanted{kZeroRgb, kZeroRgb, kZeroRgb, kZeroRgb, kZeroRgb, kZeroRgb, {}};
  wanted.g = {spare0, M::unsigned_identity, kAlphaUsage};
  EXPECT_TRUE(state.final_combiner == wanted);
  EXPECT_TRUE(state.general[1] == GeneralCombiner{}) << "GL keeps what nobody sets";
  EXPECT_TRUE(final_of("out.rgb = zero;").g == kZeroAlpha) << "not spare0";
}

TEST(Rc10, AMissingPortionReadsZeroAndWritesNothing) {
  const Portion no_rgb = parsed("!!RC1.0 { alpha { spare0 = tex0; } } out.a = spare0;").general[0].rgb;
  EXPECT_TRUE(no_rgb == (Portion{kZeroRgb, kZeroRgb, kZeroRgb, kZeroRgb, {.sum = discard}}));
  constexpr CombinerInput kZeroBlue{zero, M::unsigned_identity, kBlueUsage};
  const Portion no_alpha = parsed("!!RC1.0 { rgb { spare0 = tex0; } } out.rgb = spare0;").general[0].alpha;
  EXPECT_TRUE(no_alpha == (Portion{kZeroBlue, kZeroBlue, kZeroBlue, kZeroBlue, {.sum = discard}}));
}

TEST(Rc10, FinalCombinerTakesSixForms) {
  const CombinerInput x{texture0, M::unsigned_identity, kRgb}, y{texture1, M::unsigned_invert, kRgb};
  const CombinerInput w{fog, M::unsigned_identity, kAlphaUsage}, s{spare0_plus_secondary, M::unsigned_identity, kRgb};
  const std::string ty = "unsigned_invert(tex1)";
  struct Form {
    std::string text;
    CombinerInput a, b, c, d;
  };
  const std::array forms{
      Form{"tex0", kZeroRgb, kZeroRgb, kZeroRgb, x},
      Form{"unsigned(tex0) * " + ty, x, y, kZeroRgb, kZeroRgb},
      Form{"tex0 * " + ty + " + color_sum", x, y, kZeroRgb, s},
      Form{"tex0 + " + ty, x, kOneRgb, kZeroRgb, y},
      Form{"lerp(fog.a, tex0, " + ty + ")", w, x, y, kZeroRgb},
      Form{"lerp(fog.a, color_sum, " + ty + ") + tex0", w, s, y, x},
      Form{"tex0 + lerp(fog.a, color_sum, " + ty + ")", w, s, y, x},
      // The colour sum may not stand in A.
      Form{"color_sum * tex0", x, s, kZeroRgb, kZeroRgb},
      Form{"color_sum * tex0 + " + ty, x, s, kZeroRgb, y},
      Form{"lerp(color_sum, tex0, zero)", x, s, kZeroRgb, kZeroRgb},
      Form{"color_sum + tex0", kOneRgb, s, kZeroRgb, x},
      Form{"color_sum + color_sum", kOneRgb, s, kZeroRgb, s},
      Form{"tex0 + color_sum", x, kOneRgb, kZeroRgb, s},
      Form{"color_sum", kZeroRgb, kZeroRgb, kZeroRgb, s},
  };
  for (const Form& form : forms) {
    const FinalCombiner f = final_of("out.rgb = " + form.text + ";");
    EXPECT_TRUE(f.a == form.a && f.b == form.b && f.c == form.c && f.d == form.d) << form.text;
  }
}

TEST(Rc10, ProductAndClampStandInEitherOrder) {
  for (const char* const text : {"clamp_color_sum(); final_product = tex0 * unsigned_invert(fog.a);",
                                 "final_product = tex0 * unsigned_invert(fog.a); clamp_color_sum();"}) {
    const CombinerState state = parsed(std::string("!!RC1.0") + text + "out.a = col0.b; out.rgb = final_product;");
    EXPECT_TRUE(state.color_sum_clamp);
    EXPECT_TRUE(state.final_combiner.d == (CombinerInput{e_times_f, M::unsigned_identity, kRgb}));
    EXPECT_TRUE(state.final_combiner.e == (CombinerInput{texture0, M::unsigned_identity, kRgb}));
    EXPECT_TRUE(state.final_combiner.f == (CombinerInput{fog, M::unsigned_invert, kAlphaUsage}));
    EXPECT_TRUE(state.final_combiner.g == (CombinerInput{primary, M::unsigned_identity, kBlueUsage}));
  }
}

TEST(Rc10, GlobalConstantsAreEveryonesWithoutLocalOnes) {
  const CombinerState state = parsed(
      "!!RC1.0 const1 = (.5, 1., +0.25, -1); const0 = (2, 00.75, 0, 1); { rgb { spare0 = const1; } } out.rgb = spare0;",
      profiles::geforce2);
  EXPECT_EQ(state.constant0, (ColorF{1, 0.75F, 0, 1}));
  EXPECT_EQ(state.constant1, (ColorF{0.5F, 1, 0.25F, 0}));
  EXPECT_FALSE(state.per_stage_constants);
  EXPECT_EQ(state.general[0].constant1, ColorF{});
}

TEST(Rc10, ALocalConstantGivesEveryStageItsOwn) {
  const CombinerState state = parsed(R"(!!RC1.0
    const0 = (0.5, 0.5, 0.5, 0.5);
    { const1 = (1, 0, 0, 0); rgb { spare0 = const1; } }
    { const0 = (0, 1, 0, 0); const1 = (0, 0, 1, 0); alpha { spare0 = const0; } }
    { rgb { spare0 = const0; } }
    out.rgb = const0;)");
  EXPECT_TRUE(state.per_stage_constants);
  EXPECT_EQ(state.constant0, (ColorF{0.5F, 0.5F, 0.5F, 0.5F}));
  EXPECT_EQ(state.general[0].constant0, state.constant0) << "what a stage does not set is the global one";
  EXPECT_EQ(state.general[0].constant1, (ColorF{1, 0, 0, 0}));
  EXPECT_EQ(state.general[1].constant0, (ColorF{0, 1, 0, 0}));
  EXPECT_EQ(state.general[1].constant1, (ColorF{0, 0, 1, 0}));
  EXPECT_EQ(state.general[2].constant0, state.constant0);
  EXPECT_EQ(state.general[2].constant1, ColorF{}) << "declared nowhere: as GL has it";
  EXPECT_EQ(state.general[3].constant0, ColorF{});
}

TEST(Rc10, BlanksAndCommentsStandAnywhere) {
  const CombinerState plain = parsed("!!RC1.0{rgb{spare0=tex0*-tex1;}}out.rgb=spare0;");
  for (const char* const text :
       {"!!RC1.0\r\n{ rgb\t{ spare0 /* * / { */ = tex0 * - tex1 ; } }\n out.rgb = spare0; # end",
        "!!RC1.0 // a\n{ # b\nrgb { spare0 = tex0 * /**/ -tex1; } } out.rgb = spare0; // c",
        "!!RC1.0 !!RC1.0 { rgb { spare0 = tex0\v*\f-tex1; } } !!RC1.0 out.rgb = spare0;"}) {
    EXPECT_TRUE(parsed(text) == plain) << text;
  }
}

TEST(Rc10, ReadsAProgramOfEightStages) {
  std::string text = "!!RC1.0";
  for (int i = 0; i < 8; ++i) text += "{ rgb { spare0 = spare0 * tex3; } alpha { spare0 = tex2; } }";
  EXPECT_EQ(parsed(text + "out.rgb = spare0;").num_general_combiners, 8);
}

TEST(Rc10, CommentsMayStandBeforeTheHeader) {
  const std::string program = "!!RC1.0\nout.rgb = tex0;\nout.a = unsigned_invert(zero);\n";
  const CombinerState expected = parsed(program);
  for (const char* heading : {" ", "\n\n", "# comment\n", "// comment\n", "/* comment\n of two lines */ ",
                              "\xEF\xBB\xBF", "\xEF\xBB\xBF# comment\r\n\r\n", "# !!ARBfp1.0\n\n/**/"}) {
    EXPECT_TRUE(parsed(heading + program) == expected) << heading;
  }
}

TEST(Rc10, PartsForOtherUnitsAreSkippedAndNamed) {
  const auto both =
      parse_rc10({"// fp20\n!!TS1.0\ntexture_2d(); // tex0\nnop();\n!!RC1.0\nout.rgb = tex0;", "p"}, profiles::nv2a);
  ASSERT_TRUE(both) << both.faults()[0].text();
  EXPECT_TRUE(*both == parsed("!!RC1.0 out.rgb = tex0;"));
  ASSERT_EQ(both.notes.size(), 1U);
  EXPECT_EQ(both.notes[0].text(), "p:2:1: skipped an NV texture shader (!!TS1.0): it is not for combiners");
  const auto after = parse_rc10({"!!RC1.0 out.rgb = tex0;\n!!TS1.0 nop(); !!VP1.0 END", "p"}, profiles::nv2a);
  ASSERT_TRUE(after);
  EXPECT_EQ(after.notes.size(), 2U);
  EXPECT_TRUE(parse_rc10({"!!RC1.0 out.rgb = tex0;", "p"}, profiles::nv2a).notes.empty());
}

TEST(Rc10, NamesOfTheXboxsTools) {
  EXPECT_TRUE(parsed("!!RC1.0 {rgb{ spare0 = texture0.rgb * texture3.a; }} out.rgb = color.rgb; out.a = color1.a;") ==
              parsed("!!RC1.0 {rgb{ spare0 = tex0.rgb * tex3.a; }} out.rgb = col0.rgb; out.a = col1.a;"));
  EXPECT_TRUE(parsed("!!RC1.0 out.rgb = texture1 * texture2 + color0;") ==
              parsed("!!RC1.0 out.rgb = tex1 * tex2 + col0;"));
}

TEST(Rc10, ConstantsAfterTheGeneralCombinersAreThoseOfTheFinalCombiner) {
  const CombinerState state = parsed(
      "!!RC1.0 const1 = (0, 1, 0, 0); {rgb{ spare0 = const0 * const1; }} const0 = (1, 0, 0, 0); out.rgb = const0 + "
      "const1;");
  EXPECT_TRUE(state.per_stage_constants);
  EXPECT_EQ(state.general[0].constant0, (ColorF{0, 0, 0, 0}));
  EXPECT_EQ(state.general[0].constant1, (ColorF{0, 1, 0, 0}));
  EXPECT_EQ(state.constant0, (ColorF{1, 0, 0, 0}));
  EXPECT_EQ(state.constant1, (ColorF{0, 1, 0, 0}));
  const auto refused = parse_rc10({"!!RC1.0 {rgb{ spare0 = zero; }}\nconst0 = (1, 0, 0, 0); out.rgb = const0;", "p"},
                                  profiles::geforce2);
  ASSERT_EQ(refused.faults().size(), 1U);
  EXPECT_EQ(refused.faults()[0].text(), "p:2:1: constants must come before the general combiners");
}

}  // namespace
}  // namespace ninebit

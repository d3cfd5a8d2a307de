// explain's words: what each form of a program is simplified to, and what is said beside the equations.
#include "ninebit/language/explain.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/language/index_comparison.h"
#include "combiner_tests/support/has.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

constexpr CombinerInput alpha_of(Register reg, InputMapping mapping = InputMapping::unsigned_identity) {
  return {reg, mapping, ComponentUsage::alpha};
}
Explanation explained(const CombinerState& state, const HardwareProfile& profile = profiles::geforce2) {
  const Result<Program> program = compile(state, profile);
  EXPECT_TRUE(program.ok()) << (program ? "" : program.error().message);
  return explain(program.value(), profile);
}

std::vector<std::string> lines_of(const Explanation& e) {
  std::vector<std::string> lines;
  for (const Equation& equation : e.equations) lines.push_back(equation.target + " = " + equation.expression);
  return lines;
}

using Lines = std::vector<std::string>;

// The one equation of a program that has a single RGB portion.
std::string equation_of(const Portion& portion, const HardwareProfile& profile = profiles::geforce2) {
  CombinerState state = silent_state(1);
  state.general[0].rgb = portion;
  return lines_of(explained(state, profile)).front();
}

bool mentions(const std::vector<std::string>& sentences, const std::string& words) {
  return std::any_of(sentences.begin(), sentences.end(),
                     [&](const std::string& s) { return s.find(words) != std::string::npos; });
}

TEST(Explain, TheArticle) {
  const Explanation e = explained(index_comparison());
  EXPECT_EQ(lines_of(e),
            (Lines{"spare0 = 4·(primary − tex0)", "spare1 = 4·dot(spare0, spare0)", "rgb = 0", "alpha = spare1.blue"}));
  ASSERT_EQ(e.dead.size(), 2U);
  for (const DeadPortion& dead : e.dead) EXPECT_EQ(dead.portion, PortionName::alpha);
  EXPECT_TRUE(e.notes.empty());
  const std::string text = print_explanation(e);
  for (const Equation& equation : e.equations) {
    EXPECT_TRUE(equation.used);
    EXPECT_TRUE(has(text, "  " + equation.target + " = " + equation.expression + "\n"));
  }
  EXPECT_FALSE(has(text, "unused"));
}

TEST(Explain, GlDefaults) {
  const Explanation e = explained(CombinerState{});
  EXPECT_EQ(lines_of(e), (Lines{"spare0 = primary", "spare0.a = primary.a",
                                "rgb = fog.a × min(1, spare0 + secondary) + (1 − fog.a) × fog", "alpha = spare0.a"}));
  for (const char* words : {"stage 0's RGB portion is GL's default", "stage 0's alpha portion is GL's default",
                            "fog and colour sum, GL's default", "the colour sum is clamped to 1",
                            "the final alpha is spare0's alpha, GL's default", "1 while fog is off"}) {
    EXPECT_TRUE(mentions(e.notes, words)) << words;
  }
}

TEST(Explain, ConstantsOfZeroAreFolded) {
  const CombinerInput primary = rgb_of(Register::primary);
  const CombinerInput none = rgb_of(Register::zero);
  const auto by = [&](InputMapping mapping) {
    return equation_of({primary, rgb_of(Register::zero, mapping), none, none, {.sum = Register::spare0}});
  };
  EXPECT_EQ(by(InputMapping::unsigned_identity), "spare0 = 0");
  EXPECT_EQ(by(InputMapping::unsigned_invert), "spare0 = primary");
  EXPECT_EQ(by(InputMapping::expand_normal), "spare0 = −primary");
  EXPECT_EQ(by(InputMapping::expand_negate), "spare0 = primary");
  EXPECT_EQ(by(InputMapping::half_bias_normal), "spare0 = −½·primary");
  EXPECT_EQ(by(InputMapping::half_bias_negate), "spare0 = ½·primary");
  // ½ · ½ is 128 · 128 / 255 = 64.25 codes; real numbers have a quarter.
  const CombinerInput half = rgb_of(Register::zero, InputMapping::half_bias_negate);
  EXPECT_EQ(equation_of({half, half, none, none, {.sum = Register::spare0}}), "spare0 = 64/255");
  EXPECT_EQ(equation_of({half, half, none, none, {.sum = Register::spare0}}, *find_profile("ideal")), "spare0 = 1/4");
}

TEST(Explain, MappingsScalesAndBiases) {
  const CombinerInput zero = rgb_of(Register::zero);
  const auto mapped = [&](InputMapping mapping) {
    return equation_of({rgb_of(Register::texture0, mapping), rgb_of(Register::texture1), zero, zero, {}});
  };
  EXPECT_EQ(mapped(InputMapping::unsigned_identity), "spare0 = tex0 × tex1");
  EXPECT_EQ(mapped(InputMapping::unsigned_invert), "spare0 = (1 − tex0) × tex1");
  EXPECT_EQ(mapped(InputMapping::expand_normal), "spare0 = expand(tex0) × tex1");
  EXPECT_EQ(mapped(InputMapping::expand_negate), "spare0 = −expand(tex0) × tex1");
  EXPECT_EQ(mapped(InputMapping::half_bias_normal), "spare0 = (tex0 − ½) × tex1");
  EXPECT_EQ(mapped(InputMapping::half_bias_negate), "spare0 = (½ − tex0) × tex1");
  EXPECT_EQ(mapped(InputMapping::signed_identity), "spare0 = tex0 × tex1");
  EXPECT_EQ(mapped(InputMapping::signed_negate), "spare0 = −tex0 × tex1");

  const CombinerInput n = rgb_of(Register::texture0, InputMapping::expand_normal);
  const CombinerInput l = rgb_of(Register::texture1, InputMapping::expand_normal);
  EXPECT_EQ(equation_of({n, l, zero, zero, {.ab_dot_product = true}}), "spare0 = dot(expand(tex0), expand(tex1))");
  EXPECT_EQ(equation_of({n, kOne, zero, zero, {.ab_dot_product = true}}), "spare0 = dot(expand(tex0), (1, 1, 1))");
  EXPECT_EQ(equation_of({n, kOne, zero, zero, {.scale = Scale::by_two, .bias = Bias::by_negative_one_half}}),
            "spare0 = 2·(expand(tex0) − ½)");
  EXPECT_EQ(equation_of({n, kOne, l, kMinusOne, {.scale = Scale::by_one_half}}),
            "spare0 = (expand(tex0) − expand(tex1)) / 2");
  EXPECT_EQ(equation_of({n, kMinusOne, l, kOne, {}}), "spare0 = expand(tex1) − expand(tex0)");
}

TEST(Explain, TheMuxAndTheAlphaItReads) {
  CombinerState state = silent_state(1);
  state.general[0].rgb = {
      rgb_of(Register::texture0), kOne, rgb_of(Register::texture1), kOne, {.sum = Register::spare0, .mux_sum = true}};
  state.final_combiner.d = rgb_of(Register::spare0);
  const Explanation e = explained(state);
  EXPECT_EQ(lines_of(e).front(), "spare0 = spare0.a ≥ ½ ? tex1 : tex0");
  EXPECT_TRUE(mentions(e.notes, "spare0 alpha still holds texture 0's alpha: read by stage 0's RGB portion"));
  EXPECT_TRUE(mentions(e.legend, "½ is the code 128 of 255"));

  // Once a stage has written it, it holds that.
  state = silent_state(2);
  state.general[0].alpha = default_portion(PortionName::alpha);
  state.general[1].rgb = {
      rgb_of(Register::texture0), kOne, rgb_of(Register::texture1), kOne, {.sum = Register::spare0, .mux_sum = true}};
  state.final_combiner.d = rgb_of(Register::spare0);
  const Explanation written = explained(state);
  EXPECT_FALSE(mentions(written.notes, "still holds"));
  EXPECT_TRUE(mentions(written.notes, "stage 0's alpha portion is GL's default: spare0.a = primary.a"));
}

TEST(Explain, AMuxByTheLowestBit) {
  CombinerState state = silent_state(1);
  state.mux_by_lowest_bit = true;
  state.general[0].rgb = {
      rgb_of(Register::texture0), kOne, rgb_of(Register::texture1), kOne, {.sum = Register::spare0, .mux_sum = true}};
  state.final_combiner.d = rgb_of(Register::spare0);
  const HardwareProfile& xbox = profiles::nv2a;
  const Explanation e = explain(normalize(state, xbox), xbox);
  EXPECT_EQ(lines_of(e).front(), "spare0 = odd(spare0.a) ? tex1 : tex0");
  EXPECT_TRUE(mentions(e.legend, "odd(x): the lowest bit of x's code, or of 0 if x is negative"));
  EXPECT_FALSE(mentions(e.legend, "½"));
}

TEST(Explain, AnInvertedColorSum) {
  CombinerState state = silent_state(1);
  state.color_sum_clamp = false;
  state.final_combiner.d = rgb_of(Register::spare0_plus_secondary);
  state.color_sum_invert_secondary = true;
  const HardwareProfile& xbox = profiles::nv2a;
  EXPECT_EQ(explain(normalize(state, xbox), xbox).equations.at(0).expression, "spare0 + 1 − secondary");
}

// An equation of its own, in terms of blue: the same stage reads the register's old blue.
TEST(Explain, BlueToAlpha) {
  CombinerState state = silent_state(2);
  state.general[0].rgb = {rgb_of(Register::spare0),
                          alpha_of(Register::texture0),
                          rgb_of(Register::primary),
                          rgb_of(Register::texture1),
                          {.ab = Register::spare0,
                           .cd = Register::spare1,
                           .sum = Register::discard,
                           .cd_dot_product = true,
                           .ab_blue_to_alpha = true,
                           .cd_blue_to_alpha = true}};
  state.general[1].rgb = {alpha_of(Register::spare0),
                          alpha_of(Register::spare1),
                          {},
                          {},
                          {.ab = Register::spare0, .sum = Register::discard}};
  state.final_combiner.d = rgb_of(Register::spare0);
  const HardwareProfile& xbox = profiles::nv2a;
  const std::vector<std::string> lines = lines_of(explain(normalize(state, xbox), xbox));
  EXPECT_EQ(lines.at(0), "spare0 = spare0 × tex0.a");
  EXPECT_EQ(lines.at(1), "spare0.a = spare0.blue × tex0.a");
  EXPECT_EQ(lines.at(2), "spare1 = dot(primary, tex1)");
  EXPECT_EQ(lines.at(3), "spare1.a = dot(primary, tex1)");
  state.general[0].rgb.a = rgb_of(Register::primary);
  const Explanation e = explain(normalize(state, xbox), xbox);
  EXPECT_EQ(lines_of(e).at(1), "spare0.a = primary.blue × tex0.a");
  EXPECT_FALSE(e.equations.at(0).used) << "the second stage reads alphas alone";
  EXPECT_TRUE(e.equations.at(1).used);
  EXPECT_FALSE(e.equations.at(2).used);
  EXPECT_TRUE(e.equations.at(3).used);
}

TEST(Explain, NegativePartsAreToldWhereTheyCanBe) {
  CombinerState state = silent_state(2);
  state.general[0].rgb = {rgb_of(Register::texture0, InputMapping::expand_normal),
                          kOne,
                          rgb_of(Register::zero),
                          rgb_of(Register::zero),
                          {.sum = Register::spare0}};
  state.general[1].rgb = {rgb_of(Register::spare0),
                          rgb_of(Register::primary),
                          rgb_of(Register::zero),
                          rgb_of(Register::zero),
                          {.sum = Register::spare1}};
  state.final_combiner.d = rgb_of(Register::spare1);
  const Explanation e = explained(state);
  EXPECT_EQ(lines_of(e),
            (Lines{"spare0 = expand(tex0)", "spare1 = max(0, spare0) × primary", "rgb = spare1", "alpha = 0"}));
  EXPECT_TRUE(mentions(e.legend, "max(0, x)"));
}

TEST(Explain, FinalCombinerForms) {
  CombinerState state = silent_state(1);
  FinalCombiner& f = state.final_combiner;
  const auto color = [&] {
    const auto lines = lines_of(explained(state));
    return lines[lines.size() - 2];
  };
  const CombinerInput one = rgb_of(Register::zero, InputMapping::unsigned_invert);
  f.a = rgb_of(Register::texture0);
  f.b = rgb_of(Register::texture1);
  f.c = rgb_of(Register::primary);
  EXPECT_EQ(color(), "rgb = tex0 × tex1 + (1 − tex0) × primary");
  f.a = one;
  EXPECT_EQ(color(), "rgb = tex1");
  f.a = rgb_of(Register::zero);
  EXPECT_EQ(color(), "rgb = primary");
  f.a = rgb_of(Register::texture0, InputMapping::unsigned_invert);
  f.b = rgb_of(Register::zero);
  EXPECT_EQ(color(), "rgb = tex0 × primary");
  f.b = f.c;
  f.d = rgb_of(Register::secondary);
  EXPECT_EQ(color(), "rgb = primary + secondary");
  f.a = rgb_of(Register::e_times_f);
  f.e = rgb_of(Register::texture0);
  f.f = rgb_of(Register::texture1);
  f.b = one;
  f.c = f.d = rgb_of(Register::zero);
  EXPECT_EQ(color(), "rgb = tex0 × tex1");
  f.a = one;
  f.b = rgb_of(Register::spare0_plus_secondary, InputMapping::unsigned_invert);
  state.general[0].rgb = default_portion(PortionName::rgb);
  state.color_sum_clamp = false;
  EXPECT_EQ(color(), "rgb = 1 − min(1, spare0 + secondary)");
}

TEST(Explain, ConstantColors) {
  CombinerState state = silent_state(2);
  state.per_stage_constants = true;
  for (std::size_t i = 0; i < 2; ++i) {
    state.general[i].rgb = {rgb_of(Register::constant0),
                            rgb_of(i == 0 ? Register::texture0 : Register::spare0),
                            rgb_of(Register::zero),
                            rgb_of(Register::zero),
                            {.sum = Register::spare0}};
    state.general[i].constant0 = {0.2F, i == 0 ? 0.4F : 1.0F, 0.6F, 1.0F};
  }
  state.final_combiner.d = rgb_of(Register::spare0);
  const Explanation e = explained(state, profiles::nv2a);
  EXPECT_EQ(lines_of(e)[0], "spare0 = const0 × tex0");
  EXPECT_EQ(e.constants,
            (Lines{"const0 = (51, 102, 153, 255)/255 in stage 0", "const0 = (51, 255, 153, 255)/255 in stage 1"}));
  // White and black are folded like the constants of zero.
  state.general[0].constant0 = {1.0F, 1.0F, 1.0F, 0.0F};
  state.general[1].constant0 = {0.0F, 0.0F, 0.0F, 0.5F};
  EXPECT_EQ(lines_of(explained(state, profiles::nv2a)),
            (Lines{"spare0 = tex0", "spare0 = 0", "rgb = spare0", "alpha = 0"}));
}

TEST(Explain, WhatNothingReadsIsTold) {
  CombinerState state = index_comparison();
  state.general[0].alpha = default_portion(PortionName::alpha);
  state.general[1].rgb.out.cd = Register::texture1;
  state.general[1].rgb.c = rgb_of(Register::texture1);
  state.general[1].rgb.d = rgb_of(Register::texture0);
  const Explanation e = explained(state);
  EXPECT_EQ(lines_of(e)[1], "spare0.a = primary.a");
  EXPECT_FALSE(e.equations[1].used);
  EXPECT_EQ(lines_of(e)[3], "tex1 = 4·(tex1 × tex0)");
  EXPECT_FALSE(e.equations[3].used);
  EXPECT_TRUE(e.equations[0].used && e.equations[2].used);
  ASSERT_EQ(e.dead.size(), 2U);
  EXPECT_TRUE(has(e.dead[0].reason, "GL's default"));
  EXPECT_TRUE(has(print_explanation(e), "unused: nothing reads it"));
}

}  // namespace
}  // namespace ninebit::test

// Programs printed as !!RC1.0 mean the same again, wherever the language can say it.
#include <gtest/gtest.h>

#include <string>
#include <string_view>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/support/has.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/rc10.h"

namespace ninebit {
namespace {

using test::Random;

// Features that the language does not have.
bool is_beyond_words(const CombinerState& state) {
  const FinalCombiner& f = state.final_combiner;
  for (const CombinerInput& in : {f.b, f.c, f.d}) {
    const bool inverts = state.color_sum_invert_spare0 || state.color_sum_invert_secondary;
    if (in.reg == Register::spare0_plus_secondary && inverts) return true;
  }
  for (int i = 0; i < state.num_general_combiners; ++i) {
    const PortionOutput& out = state.general[static_cast<std::size_t>(i)].rgb.out;
    const bool third = out.sum != Register::discard;
    if (third && (out.ab_dot_product || out.cd_dot_product)) return true;
    const PortionOutput& alpha = state.general[static_cast<std::size_t>(i)].alpha.out;
    const bool mux = (third && out.mux_sum) || (alpha.sum != Register::discard && alpha.mux_sum);
    if (mux && state.mux_by_lowest_bit) return true;
    const auto raises = [&](Register to, bool blue_to_alpha) {
      return blue_to_alpha && to != Register::discard && to != alpha.ab && to != alpha.cd && to != alpha.sum;
    };
    if (raises(out.ab, out.ab_blue_to_alpha) || raises(out.cd, out.cd_blue_to_alpha)) return true;
  }
  return false;
}

// Final combiners that the short forms can say: products and sums without lerp.
void simplify(Random& random, CombinerState& state) {
  FinalCombiner& f = state.final_combiner;
  if (random.one_in(2)) f.c = CombinerInput{};
  if (random.one_in(4)) f.b = {Register::zero, InputMapping::unsigned_invert, ComponentUsage::rgb};
  if (random.one_in(4)) f.a = f.b = CombinerInput{};
  for (GeneralCombiner& stage : state.general) {
    if (random.one_in(6)) stage.rgb.out = {.sum = Register::discard};
    if (random.one_in(6)) stage.alpha.out = {.sum = Register::discard};
  }
  // Features that OpenGL does not have would leave little else.
  if (random.one_in(4)) return;
  state.mux_by_lowest_bit = state.color_sum_invert_spare0 = state.color_sum_invert_secondary = false;
  for (GeneralCombiner& stage : state.general) {
    stage.rgb.out.ab_blue_to_alpha = stage.rgb.out.cd_blue_to_alpha = false;
  }
}

TEST(Rc10RoundTrip, MeansTheSame) {
  constexpr std::uint64_t kSeed = 1999;
  int expressible = 0, refused = 0, local = 0;
  for (std::uint64_t i = 0; i < 6000; ++i) {
    Random random(kSeed, i);
    const HardwareProfile profile = test::random_profile(random);
    CombinerState state = test::random_state(random, profile);
    simplify(random, state);
    ASSERT_TRUE(validate(state, profile).empty());
    const auto text = print_rc10(state, profile);
    if (is_beyond_words(state)) {
      ASSERT_FALSE(text) << "seed " << kSeed << " case " << i;
      ++refused;
      continue;
    }
    ASSERT_TRUE(text) << "seed " << kSeed << " case " << i << ": " << text.error().message;
    const auto back = parse_rc10({*text, "printed"}, profile);
    ASSERT_TRUE(back) << "seed " << kSeed << " case " << i << ": " << back.faults().front().text() << "\n" << *text;
    ASSERT_TRUE(validate(*back, profile).empty());
    ASSERT_TRUE(normalize(*back, profile) == normalize(state, profile)) << "seed " << kSeed << " case " << i << "\n"
                                                                        << *text;
    const auto again = print_rc10(*back, profile);
    ASSERT_TRUE(again);
    ASSERT_EQ(*again, *text);
    ++expressible;
    local += back->per_stage_constants ? 1 : 0;
  }
  EXPECT_GT(expressible, 3000);
  EXPECT_GT(refused, 500);
  EXPECT_GT(local, 200);
  RecordProperty("expressible", expressible);
  RecordProperty("refused", refused);
}

TEST(Rc10RoundTrip, SaysWhatTheLanguageLacks) {
  CombinerState state;
  state.general[0].rgb.out.ab_dot_product = true;
  const auto text = print_rc10(state, profiles::geforce2);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().message,
            "!!RC1.0 cannot express this: general combiner 0, RGB portion: sum() beside a dot product");
  CombinerState chosen;
  chosen.mux_by_lowest_bit = chosen.general[0].rgb.out.mux_sum = true;
  const auto by_bit = print_rc10(chosen, profiles::nv2a);
  ASSERT_FALSE(by_bit);
  EXPECT_EQ(by_bit.error().message,
            "!!RC1.0 cannot express this: mux by the lowest bit of spare0's alpha (general combiner 0)");
  state.general[0].rgb.out.sum = Register::discard;
  EXPECT_TRUE(print_rc10(state, profiles::geforce2)) << "a flag whose product nothing uses";
  state.final_combiner.a.mapping = InputMapping::signed_negate;
  const auto invalid = print_rc10(state, profiles::geforce2);
  ASSERT_FALSE(invalid);
  EXPECT_TRUE(test::has(invalid.error().message, "final combiner, variable A"));
}

TEST(Rc10RoundTrip, PrintsTheShortestFormThatSaysIt) {
  const std::string_view text =
      "!!RC1.0\n"
      "const1 = (0.25, 1, 0, 0.1);\n"
      "{\n"
      "  rgb {\n"
      "    discard = tex0 * -const1.a;\n"
      "    discard = expand(col0);\n"
      "    spare0 = sum();\n"
      "    scale_by_two();\n"
      "  }\n"
      "  alpha {\n"
      "    discard = zero;\n"
      "    spare1 = unsigned_invert(tex1.b) * fog.b;\n"
      "    bias_by_negative_one_half();\n"
      "  }\n"
      "}\n"
      "{\n"
      "  rgb {\n"
      "    discard = zero;\n"
      "  }\n"
      "}\n"
      "clamp_color_sum();\n"
      "final_product = spare0 * unsigned_invert(fog.a);\n"
      "out.rgb = lerp(fog.a, color_sum, fog) + final_product;\n"
      "out.a = spare1;\n";
  const auto state = parse_rc10({text, ""}, profiles::geforce2);
  ASSERT_TRUE(state) << state.faults().front().text();
  const auto printed = print_rc10(*state, profiles::geforce2);
  ASSERT_TRUE(printed);
  EXPECT_EQ(*printed, text);
}

}  // namespace
}  // namespace ninebit

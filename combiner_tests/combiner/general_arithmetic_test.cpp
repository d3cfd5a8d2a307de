// Every input of the general combiners' mappings and of the mux, by every path and independent formulas. Products, sums
// and outputs: products_test.cpp and sums_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"

namespace ninebit::test {
namespace {

// The mapping table of the extension, in codes.
int mapped_by_table(const HardwareProfile& p, InputMapping mapping, int e) {
  const int positive = e < 0 ? 0 : e;
  switch (mapping) {
    case InputMapping::unsigned_identity:
      return positive;
    case InputMapping::unsigned_invert:
      return p.one - positive;
    case InputMapping::expand_normal:
      return 2 * positive - p.expand_offset;
    case InputMapping::expand_negate:
      return -2 * positive + p.expand_offset;
    case InputMapping::half_bias_normal:
      return positive - p.half;
    case InputMapping::half_bias_negate:
      return -positive + p.half;
    case InputMapping::signed_identity:
      return e;
    case InputMapping::signed_negate:
      return -e;
  }
  return 0;
}

bool is_code(oracle::Fraction x, const HardwareProfile& p, int code) {
  return x.num * p.one == code * x.den;
}

TEST(GeneralArithmetic, EveryMappingOfEveryRegisterValue) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "too long, and other tests reach the same lines";
  int cases = 0;
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const Datapath d = datapath_of(p);
    for (const InputMapping mapping : kInputMappings) {
      for (int e = p.lowest; e <= p.one; ++e, ++cases) {
        const int by_table = mapped_by_table(p, mapping, e);
        ASSERT_TRUE(is_code(oracle::mapped(p, mapping, oracle::real(p, e)), p, by_table)) << p.name << ' ' << e;
        ASSERT_EQ(reference::map_input(d, mapping, e), by_table) << p.name << ' ' << name_of(mapping) << ' ' << e;
      }
    }
  }
  EXPECT_EQ(cases, 8 * (3 * 511 + 255 + 2 * 512));
}

TEST(GeneralArithmetic, EveryMappingOfEveryRegisterValueInARunningProgram) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const HardwareProfile& p : integer_profiles()) {
    for (const InputMapping mapping : kInputMappings) {
      CombinerState state = silent_state(1);
      state.general[0].rgb.a = rgb_of(Register::primary, mapping);
      state.general[0].rgb.b = kOne;
      state.general[0].rgb.out.ab = Register::spare1;
      state.general[0].alpha.a = blue_of(Register::primary, mapping);
      state.general[0].alpha.b = kOneAlpha;
      state.general[0].alpha.out.ab = Register::spare1;
      for (int e = p.lowest; e <= p.one; ++e) {
        RegisterFile registers;
        registers[Register::primary] = codes(e, e, e, 7);
        const RegisterFile after = judged(state, p, registers).registers;
        const int expected = std::clamp(mapped_by_table(p, mapping, e), p.lowest_output.value, p.one.value);
        ASSERT_EQ(after[Register::spare1], codes(expected, expected, expected, expected)) << name_of(mapping) << e;
      }
    }
  }
}

// Both portions of a stage choose between the primary (AB) and the secondary colour (CD).
CombinerState mux_state() {
  CombinerState state = silent_state(1);
  Portion& rgb = state.general[0].rgb;
  rgb.a = rgb_of(Register::primary);
  rgb.b = rgb.d = kOne;
  rgb.c = rgb_of(Register::secondary);
  rgb.out.sum = Register::spare1;
  rgb.out.mux_sum = true;
  state.general[0].alpha = rgb;
  Portion& alpha = state.general[0].alpha;
  alpha.a.usage = alpha.b.usage = alpha.c.usage = alpha.d.usage = ComponentUsage::alpha;
  return state;
}

TEST(GeneralArithmetic, MuxOfEverySpare0Alpha) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  const CombinerState state = mux_state();
  for (const HardwareProfile& p : integer_profiles()) {
    for (int select = p.lowest; select <= p.one; ++select) {
      RegisterFile registers;
      registers[Register::primary] = codes(1, 2, 3, 4);
      registers[Register::secondary] = codes(5, 6, 7, 8);
      registers[Register::spare0][kAlpha] = static_cast<s9>(select);
      const Rgba9 expected = registers[select >= p.half ? Register::secondary : Register::primary];
      ASSERT_EQ(judged(state, p, registers).registers[Register::spare1], expected) << p.name << ' ' << select;
    }
  }
}

// The lowest bit of the eight that have the highest one, which is 0 of all that is negative.
TEST(GeneralArithmetic, MuxByTheLowestBitOfEverySpare0Alpha) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  int cases = 0;
  for (HardwareProfile p : profiles_and_rivals()) {
    p.mux_by_lowest_bit.value = true;
    // Once as factors are chosen before they are multiplied, once as codes are chosen.
    for (const bool products : {false, true}) {
      CombinerState state = mux_state();
      state.mux_by_lowest_bit = true;
      if (products) {
        state.general[0].rgb.b = state.general[0].rgb.d = rgb_of(Register::texture0);
        state.general[0].alpha.b = state.general[0].alpha.d = alpha_of(Register::texture0);
      }
      for (int select = p.lowest; select <= p.one; ++select, ++cases) {
        RegisterFile registers;
        registers[Register::primary] = codes(1, 2, 3, 4);
        registers[Register::secondary] = codes(5, 6, 7, 8);
        registers[Register::texture0] = codes(p.one, p.one, p.one, p.one);
        registers[Register::spare0][kAlpha] = static_cast<s9>(select);
        const bool odd = select == 1 || (select > 1 && select % 2 == 1);
        const Rgba9 expected = registers[odd ? Register::secondary : Register::primary];
        ASSERT_EQ(judged(state, p, registers).registers[Register::spare1], expected) << p.name << ' ' << select;
      }
    }
  }
  EXPECT_EQ(cases, 2 * (3 * 511 + 255 + 2 * 512));
}

TEST(GeneralArithmetic, TheReferenceRunsAtCompileTime) {
  constexpr auto result = [] {
    CombinerState state;
    state.general[0].rgb.a = {Register::texture0, InputMapping::unsigned_identity, ComponentUsage::rgb};
    state.general[0].rgb.b = {Register::primary, InputMapping::unsigned_identity, ComponentUsage::rgb};
    state.final_combiner.a = {};
    state.final_combiner.d = {Register::spare0, InputMapping::unsigned_identity, ComponentUsage::rgb};
    state.final_combiner.c = {};
    RegisterFile registers;
    registers[Register::texture0] = Rgba9{255, 128, 100, 0};
    registers[Register::primary] = Rgba9{77, 128, 100, 33};
    return evaluate(normalize(state, profiles::geforce2), registers);
  }();
  // 128 · 128 / 255 = 64.25 and 100 · 100 / 255 = 39.2.
  static_assert(result == Rgba9{77, 64, 39, 33});
  EXPECT_EQ(result, codes(77, 64, 39, 33));
}

}  // namespace
}  // namespace ninebit::test

// Every input of the general combiners' mappings and of the mux, by every path and independent formulas. Products, sums
// and outputs: products_test.cpp and sums_test.cpp.
#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

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

// Alone, where its blue also goes to alpha, and as a factor.
TEST(GeneralArithmetic, EveryMappingOfEveryRegisterValueInARunningProgram) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "too long, and other tests reach the same lines";
  for (const HardwareProfile& p : profiles_and_rivals()) {
    for (const InputMapping mapping : kInputMappings) {
      const CombinerInput mapped = rgb_of(Register::primary, mapping);
      CombinerState state = rgb_stage({mapped,
                                       kOne,
                                       mapped,
                                       rgb_of(Register::secondary, InputMapping::signed_identity),
                                       {.ab = Register::spare1, .cd = Register::texture0, .sum = Register::discard}});
      state.general[0].alpha = {blue_of(Register::primary, mapping), kOneAlpha, kZeroAlpha, kZeroAlpha,
                                ab_to(Register::spare1)};
      std::vector<RegisterFile> fragments;
      for (int e = p.lowest; e <= p.one; ++e) {
        RegisterFile& registers = fragments.emplace_back();
        registers[Register::primary] = codes(e, e, std::min(e + 1, p.one.value), 7);
        registers[Register::secondary] = codes(p.one, p.one - 1, p.lowest, 0);
      }
      const std::vector<Fragment> results = judged(state, p, fragments);
      for (std::size_t i = 0; i < results.size(); ++i) {
        const Rgba9& e = fragments[i][Register::primary];
        for (std::size_t c = 0; c < 4; ++c) {
          ASSERT_EQ(results[i].registers[Register::spare1][c],
                    std::clamp(mapped_by_table(p, mapping, e[c < 3 ? c : 2]), p.lowest_output.value, p.one.value))
              << p.name << ' ' << name_of(mapping) << ' ' << e[0];
        }
      }
    }
  }
}

// By the highest bit, and by the lowest of the eight that have that one, which is 0 of all that is negative.
TEST(GeneralArithmetic, MuxOfEverySpare0Alpha) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  int cases = 0;
  for (HardwareProfile p : profiles_and_rivals()) {
    p.mux_by_lowest_bit.value = true;
    for (const bool by_lowest_bit : {false, true}) {
      // Once as factors are chosen before they are multiplied, once as codes are chosen.
      for (const CombinerInput& factor : {kOne, rgb_of(Register::texture0)}) {
        CombinerState state = rgb_stage(
            {rgb_of(Register::primary), factor, rgb_of(Register::secondary), factor, mux_to(Register::spare1)});
        state.general[0].alpha = of_alpha(state.general[0].rgb);
        state.mux_by_lowest_bit = by_lowest_bit;
        std::vector<RegisterFile> fragments;
        for (int select = p.lowest; select <= p.one; ++select, ++cases) {
          RegisterFile& registers = fragments.emplace_back();
          registers[Register::primary] = codes(1, 2, 3, 4);
          registers[Register::secondary] = codes(5, 6, 7, 8);
          registers[Register::texture0] = codes(p.one, p.one, p.one, p.one);
          registers[Register::spare0][kAlpha] = static_cast<s9>(select);
        }
        const std::vector<Fragment> results = judged(state, p, fragments);
        for (std::size_t i = 0; i < results.size(); ++i) {
          const int select = p.lowest + static_cast<int>(i);
          const bool takes_cd = by_lowest_bit ? select > 0 && select % 2 == 1 : select >= p.half;
          ASSERT_EQ(results[i].registers[Register::spare1], takes_cd ? codes(5, 6, 7, 8) : codes(1, 2, 3, 4))
              << p.name << ' ' << select << by_lowest_bit;
        }
      }
    }
  }
  EXPECT_EQ(cases, 4 * (3 * 511 + 255 + 2 * 512));
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

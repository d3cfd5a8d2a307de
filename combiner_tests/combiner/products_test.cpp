// Every product of two mapped values, and every value that a sum or a dot product can reach, through every legal pair
// of scale and bias, with all integer profiles and two with rivals of their rules.
//
// Exhaustive here:
// - products: both factors over all that a mapping can give; by the oracle, a formula in integers, the reference and
//   every SIMD target;
// - wide values: all integers up to two dot products of largest factors, ±6 lowest²; by the oracle and the reference;
// - the same on every SIMD target: all integers up to ±(5 one² + one - 1), beyond that the multiples of one (a
//   sanitized build takes one in 17). From 2 one (one + 1) on every output is saturated.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <numeric>
#include <vector>

#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

// Bias, scale, narrowing and clamp in integer units of 1 / (2 one²), for profiles that narrow after scaling.
int output_by_integers(const HardwareProfile& p, Scale scale, Bias bias, int wide) {
  const int biased = wide - (bias == Bias::none ? 0 : p.half * p.one);
  const int scaled = biased * (scale == Scale::by_one_half ? 1
                               : scale == Scale::none      ? 2
                               : scale == Scale::by_two    ? 4
                                                           : 8);
  const int unit = 2 * p.one;
  const int cut = std::abs(scaled) / unit * (scaled < 0 ? -1 : 1);
  int code = cut;
  if (p.general_narrowing == Narrowing::nearest_halves_up) {
    const int remainder = scaled - cut * unit;
    if (2 * remainder >= unit) code = cut + 1;
    if (2 * remainder < -unit) code = cut - 1;
  }
  return std::clamp(code, p.lowest_output.value, p.one.value);
}

// The largest magnitude that a mapping gives: expand and signed negate reach it.
int largest_mapped(const HardwareProfile& p) {
  return std::max({p.one.value, -p.lowest, p.expand_offset.value});
}

// spare1 = A·B of primary and secondary, as they are. The colour is its positive part.
BatchProgram product_program(const HardwareProfile& p, Scale scale, Bias bias, InputMapping of_a, bool registers) {
  CombinerState state =
      rgb_stage({rgb_of(Register::primary, of_a), rgb_of(Register::secondary, InputMapping::signed_identity), kZero,
                 kZero, ab_to(Register::spare1, scale, bias)});
  state.final_combiner = final_of(Register::spare1);
  return BatchProgram(compile(state, p).value(), {.registers = registers});
}

TEST(Products, EveryProductOfTwoMappedValues) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  std::int64_t cases = 0;
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const Datapath d = datapath_of(p);
    const int most = largest_mapped(p);
    for (const auto& [scale, bias] : kScaleBias) {
      for (int a = -most; a <= most; ++a) {
        for (int b = -most; b <= most; ++b, ++cases) {
          const oracle::Fraction product = oracle::times(oracle::real(p, a), oracle::real(p, b));
          const int expected = oracle::general_output(p, scale, bias, product);
          const int actual = reference::combiner_output(d, scale, bias, reference::mul(a, b));
          ASSERT_EQ(actual, expected) << p.name << ' ' << name_of(scale) << ' ' << name_of(bias) << ' ' << a << ' '
                                      << b;
          if (p.narrowing_point == NarrowingPoint::after_scale) {
            ASSERT_EQ(output_by_integers(p, scale, bias, a * b), expected) << p.name << ' ' << a << ' ' << b;
          }
        }
      }
    }
  }
  EXPECT_EQ(cases, 6 * (3 * 511 * 511 + 255 * 255 + 2 * 513 * 513));
}

// All products of B with A mapped so, and their positive parts alone.
TEST(Products, EveryProductOfTwoMappedValuesOnEverySimdTarget) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "a build with sanitizers has one SIMD target";
  Lanes lanes;
  RegisterBatch& batch = *lanes.registers;
  // Three values of A at once, one a channel.
  const auto try_all = [&](const HardwareProfile& p, Scale scale, Bias bias, InputMapping of_a,
                           const std::vector<s9>& by_wide) {
    // Unmapped, they stand for what any mapping makes; else they are what a register holds.
    const bool plain = of_a == InputMapping::signed_identity;
    const int most = largest_mapped(p), lowest = plain ? -most : p.lowest.value, highest = plain ? most : p.one.value;
    const BatchProgram program = product_program(p, scale, bias, of_a, true);
    const BatchProgram positive = product_program(p, scale, bias, of_a, false);
    for (int a = lowest; a <= highest; a += 3) {
      for (int first = lowest; first <= highest; first += static_cast<int>(kBatchSize)) {
        const std::size_t count = std::min(kBatchSize, static_cast<std::size_t>(highest - first + 1));
        for (int c = 0; c < 3; ++c) {
          std::fill_n(batch(Register::primary, c), count, static_cast<s9>(std::min(a + c, highest)));
          std::iota(batch(Register::secondary, c), batch(Register::secondary, c) + count, static_cast<s9>(first));
        }
        // The bits by which the codes of each channel differ from what is expected of the registers, or of the colour.
        const auto difference = [&](const auto& codes, int least) {
          int bits = 0;
          for (int c = 0; c < 3; ++c) {
            const int factor = reference::map_input(datapath_of(p), of_a, std::min(a + c, highest));
            const s9* const actual = codes(c);
            for (int i = 0; i < static_cast<int>(count); ++i) {
              const int expected = by_wide[static_cast<std::size_t>(factor * (first + i) + most * most)];
              bits |= actual[i] ^ std::max(expected, least);
            }
          }
          return bits;
        };
        lanes.expect_on_every_target(program, count, p, [&] {
          return difference([&](int c) { return batch(Register::spare1, c); }, p.lowest_output);
        });
        lanes.expect_on_every_target(positive, count, p, [&] {
          return difference([&](int c) { return lanes.out->plane[static_cast<std::size_t>(c)].data(); }, 0);
        });
        if (HasFatalFailure()) return;
      }
    }
  };
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const int most = largest_mapped(p) * largest_mapped(p);
    for (const auto& [scale, bias] : kScaleBias) {
      const std::vector<s9> by_wide = outputs_by_oracle(p, scale, bias, -most, most);
      for (const InputMapping of_a :
           {InputMapping::signed_identity, InputMapping::unsigned_identity, InputMapping::unsigned_invert}) {
        ASSERT_NO_FATAL_FAILURE(try_all(p, scale, bias, of_a, by_wide));
      }
    }
  }
}

TEST(Products, EveryWideValueThatTwoDotProductsCanReach) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const Datapath d = datapath_of(p);
    const int most = 6 * largest_mapped(p) * largest_mapped(p);
    for (const auto& [scale, bias] : kScaleBias) {
      const std::vector<s9> expected = outputs_by_oracle(p, scale, bias, -most, most);
      for (int wide = -most; wide <= most; ++wide) {
        ASSERT_EQ(reference::combiner_output(d, scale, bias, wide), expected[static_cast<std::size_t>(wide + most)])
            << p.name << ' ' << name_of(scale) << ' ' << name_of(bias) << ' ' << wide;
      }
      const int saturated = 2 * p.one * (p.one + 1);
      for (int wide = saturated; wide <= most; ++wide) {
        ASSERT_EQ(expected[static_cast<std::size_t>(most + wide)], p.one.value) << p.name << ' ' << wide;
        ASSERT_EQ(expected[static_cast<std::size_t>(most - wide)], p.lowest_output.value) << p.name << ' ' << wide;
      }
    }
  }
}

// Two dot products whose sum is `wide`: five factors of `one`, the sixth takes the rest. False if it cannot.
bool split(int wide, int one, std::array<int, 6>& factor, int& last_partner) {
  int left = wide / one;
  const int rest = wide % one;
  for (std::size_t i = 0; i < 5; ++i) {
    factor[i] = std::clamp(left, -one, one);
    left -= factor[i];
  }
  last_partner = left == 0 ? 1 : one;
  factor[5] = left == 0 ? rest : left;
  return left == 0 || rest == 0;
}

// spare1 = A·B + C·D, both dot products of registers as they are.
BatchProgram dot_products_program(const HardwareProfile& p, Scale scale, Bias bias) {
  const auto read = [](Register reg) { return rgb_of(reg, InputMapping::signed_identity); };
  Portion rgb{read(Register::primary), read(Register::secondary), read(Register::texture0), read(Register::texture1),
              sum_to(Register::spare1, scale, bias)};
  rgb.out.ab_dot_product = rgb.out.cd_dot_product = true;
  return BatchProgram(compile(rgb_stage(rgb), p).value(), {.registers = true});
}

TEST(Products, EverySumOfTwoDotProductsOnEverySimdTarget) {
  if (kSanitized || kCoverage) GTEST_SKIP() << "a build with sanitizers has one SIMD target";
  Lanes lanes;
  RegisterBatch& batch = *lanes.registers;
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const int one = p.one, most = 6 * one * one;
    std::vector<BatchProgram> programs;
    std::vector<std::vector<s9>> by_wide;
    for (const auto& [scale, bias] : kScaleBias) {
      programs.push_back(dot_products_program(p, scale, bias));
      by_wide.push_back(outputs_by_oracle(p, scale, bias, -most, most));
    }
    std::vector<int> wides;
    std::int64_t tried = 0;
    // Every pair of scale and bias on every target, for the sums that are in the batch.
    const auto flush = [&] {
      for (std::size_t k = 0; k < programs.size(); ++k) {
        lanes.expect_on_every_target(programs[k], wides.size(), p, [&] {
          int difference = 0;
          for (int c = 0; c < 3; ++c) {
            const s9* const actual = batch(Register::spare1, c);
            for (std::size_t i = 0; i < wides.size(); ++i) {
              difference |= actual[i] ^ by_wide[k][static_cast<std::size_t>(wides[i] + most)];
            }
          }
          return difference;
        });
      }
      tried += static_cast<std::int64_t>(wides.size());
      wides.clear();
    };
    for (int wide = -most; wide <= most; wide += kSlowBuild ? 17 : 1) {
      std::array<int, 6> factor{};
      int last_partner = 0;
      if (!split(wide, one, factor, last_partner)) continue;
      const std::size_t lane = wides.size();
      for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(c);
        batch(Register::primary, c)[lane] = static_cast<s9>(factor[i]);
        batch(Register::secondary, c)[lane] = static_cast<s9>(one);
        batch(Register::texture0, c)[lane] = static_cast<s9>(factor[3 + i]);
        batch(Register::texture1, c)[lane] = static_cast<s9>(c == 2 ? last_partner : one);
      }
      wides.push_back(wide);
      if (wides.size() == kBatchSize) flush();
      if (HasFatalFailure()) return;
    }
    if (!wides.empty()) flush();
    // All integers up to 5 one² + one - 1, then multiples of one up to 6 one².
    const std::int64_t all = 2 * (5 * one * one + one - 1) + 1 + 2 * one;
    EXPECT_GT(tried * 20, all);
    if (!kSlowBuild) {
      EXPECT_EQ(tried, all);
    }
  }
}

}  // namespace
}  // namespace ninebit::test

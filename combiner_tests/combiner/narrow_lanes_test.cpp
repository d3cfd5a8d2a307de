// What batches compute in 16-bit lanes, by formulas of their own: every sum of products that are not negative, every
// sum and difference of two codes, every half, against the oracle on every SIMD target.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

// The program of a portion that leaves a sum of so many products in spare1: one and two by AB and CD, three by a dot
// product.
BatchProgram program_of(const HardwareProfile& p, int products, Scale scale) {
  const bool two = products == 2;
  Portion rgb{rgb_of(Register::primary), rgb_of(Register::secondary), two ? rgb_of(Register::texture0) : kZero,
              two ? rgb_of(Register::texture1) : kZero,
              two ? sum_to(Register::spare1, scale) : ab_to(Register::spare1, scale)};
  rgb.out.ab_dot_product = products == 3;
  return BatchProgram(compile(rgb_stage(rgb), p).value(), {.registers = true});
}

// Sets the factors of the products of one lane so that their sum is `wide`; false if they cannot.
bool split(int wide, int products, int one, RegisterBatch& batch, std::size_t lane) {
  for (int c = 0; c < 3; ++c) {
    for (const Register r : {Register::primary, Register::secondary, Register::texture0, Register::texture1}) {
      batch(r, c)[lane] = 0;
    }
  }
  for (int k = 0; k < products; ++k) {
    const bool last = k + 1 == products;
    const int whole = std::min(wide / one, one);
    const int x = last && wide < one ? wide : whole, y = last && wide < one ? 1 : one;
    wide -= x * y;
    for (int c = 0; c < 3; ++c) {
      if (products == 3 && c != k) continue;
      batch(k == 1 && products == 2 ? Register::texture0 : Register::primary, c)[lane] = static_cast<s9>(x);
      batch(k == 1 && products == 2 ? Register::texture1 : Register::secondary, c)[lane] = static_cast<s9>(y);
    }
  }
  return wide == 0;
}

TEST(NarrowLanes, EverySumOfProductsThatAreNotNegative) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  Lanes lanes;
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const int one = p.one;
    for (int products = 1; products <= 3; ++products) {
      const int most = products * one * one;
      std::vector<BatchProgram> programs;
      std::vector<std::vector<s9>> by_wide;
      for (const Scale scale : {Scale::none, Scale::by_two, Scale::by_four, Scale::by_one_half}) {
        programs.push_back(program_of(p, products, scale));
        by_wide.push_back(outputs_by_oracle(p, scale, Bias::none, 0, most));
        if (one == 255 && scale != Scale::by_one_half) {
          EXPECT_NE(programs.back().describe().find("u16:"), std::string::npos) << p.name << ' ' << name_of(scale);
        }
      }
      std::vector<int> wides;
      const auto flush = [&] {
        for (std::size_t k = 0; k < programs.size(); ++k) {
          lanes.expect_on_every_target(programs[k], wides.size(), p, [&] {
            int difference = 0;
            for (std::size_t i = 0; i < wides.size(); ++i) {
              difference |=
                  (*lanes.registers)(Register::spare1, kGreen)[i] ^ by_wide[k][static_cast<std::size_t>(wides[i])];
            }
            return difference;
          });
        }
        wides.clear();
      };
      int tried = 0;
      for (int wide = 0; wide <= most; wide += kSlowBuild ? 7 : 1) {
        if (!split(wide, products, one, *lanes.registers, wides.size())) continue;
        wides.push_back(wide);
        ++tried;
        if (wides.size() == kBatchSize) flush();
        if (HasFatalFailure()) return;
      }
      if (!wides.empty()) flush();
      // The last factor takes any rest below one; beyond that it is one itself.
      if (!kSlowBuild) {
        EXPECT_EQ(tried, (products - 1) * one * one + 2 * one);
      }
    }
  }
}

// All pairs of factors of one product, which the sums above do not have.
TEST(NarrowLanes, EveryProductOfTwoPositiveCodes) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  Lanes lanes;
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const int one = p.one;
    for (const Scale scale : {Scale::none, Scale::by_two, Scale::by_four}) {
      const BatchProgram program = program_of(p, 1, scale);
      const std::vector<s9> expected = outputs_by_oracle(p, scale, Bias::none, 0, one * one);
      for (int x = 0; x <= one; x += kSlowBuild ? 15 : 1) {
        for (int y = 0; y <= one; ++y) {
          (*lanes.registers)(Register::primary, kRed)[y] = static_cast<s9>(x);
          (*lanes.registers)(Register::secondary, kRed)[y] = static_cast<s9>(y);
        }
        lanes.expect_on_every_target(program, static_cast<std::size_t>(one + 1), p, [&] {
          int difference = 0;
          for (int y = 0; y <= one; ++y) {
            difference |= (*lanes.registers)(Register::spare1, kRed)[y] ^ expected[static_cast<std::size_t>(x * y)];
          }
          return difference;
        });
        if (HasFatalFailure()) return;
      }
    }
  }
}

// A·1 + C·1 and A·1 - C·1 of all pairs of codes, and A·1 alone.
TEST(NarrowLanes, EverySumAndDifferenceOfTwoCodes) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  Lanes lanes;
  RegisterBatch& batch = *lanes.registers;
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const int one = p.one, lowest = p.lowest;
    for (const auto& [scale, bias] : kScaleBias) {
      const int most = 2 * std::max(one, -lowest);
      const std::vector<s9> by_sum = outputs_by_oracle(p, scale, bias, -most * one, most * one, one);
      for (const int sign : {1, -1}) {
        Portion rgb{rgb_of(Register::primary, InputMapping::signed_identity), kOne,
                    rgb_of(Register::secondary, sign > 0 ? InputMapping::signed_identity : InputMapping::signed_negate),
                    kOne, sum_to(Register::spare1, scale, bias)};
        rgb.out.ab = Register::spare0;
        const BatchProgram program(compile(rgb_stage(rgb), p).value(), {.registers = true});
        EXPECT_EQ(program.describe().find(':'), std::string::npos) << "nothing is multiplied or divided";
        const int count = one - lowest + 1;  // at most kBatchSize
        for (int x = lowest; x <= one; x += kSlowBuild ? 15 : 1) {
          for (int i = 0; i < count; ++i) {
            batch(Register::primary, kRed)[i] = static_cast<s9>(x);
            batch(Register::secondary, kRed)[i] = static_cast<s9>(lowest + i);
          }
          lanes.expect_on_every_target(program, static_cast<std::size_t>(count), p, [&] {
            int difference = 0;
            for (int i = 0; i < count; ++i) {
              const int sum = x + sign * (lowest + i);
              difference |= batch(Register::spare1, kRed)[i] ^ by_sum[static_cast<std::size_t>(sum + most)];
              difference |= batch(Register::spare0, kRed)[i] ^ by_sum[static_cast<std::size_t>(x + most)];
            }
            return difference;
          });
          if (HasFatalFailure()) return;
        }
      }
    }
  }
}

}  // namespace
}  // namespace ninebit::test

// What batches compute in 16-bit lanes, by formulas of their own: every sum of products that are not negative, every
// sum and difference of two codes, every half, against the oracle on every SIMD target.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

// The oracle's results for the wide values from `low` to `high`, in steps of `step`.
std::vector<s9> outputs_by_oracle(const HardwareProfile& p, Scale scale, Bias bias, int low, int high, int step) {
  std::vector<s9> outputs;
  for (int wide = low; wide <= high; wide += step) {
    outputs.push_back(static_cast<s9>(oracle::general_output(p, scale, bias, {wide, p.one * p.one})));
  }
  return outputs;
}

// A portion that leaves a sum of so many products in spare1: one and two by AB and CD, three by a dot product.
Portion portion_of(int products, InputMapping mapping) {
  Portion rgb = silent_state(1).general[0].rgb;
  rgb.a = rgb_of(Register::primary, mapping);
  rgb.b = rgb_of(Register::secondary, mapping);
  rgb.c = products == 2 ? rgb_of(Register::texture0, mapping) : kZero;
  rgb.d = products == 2 ? rgb_of(Register::texture1, mapping) : kZero;
  (products == 2 ? rgb.out.sum : rgb.out.ab) = Register::spare1;
  rgb.out.ab_dot_product = products == 3;
  return rgb;
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
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const int one = p.one;
    for (int products = 1; products <= 3; ++products) {
      const int most = products * one * one;
      for (const Scale scale : {Scale::none, Scale::by_two, Scale::by_four, Scale::by_one_half}) {
        CombinerState state = silent_state(1);
        state.general[0].rgb = portion_of(products, InputMapping::unsigned_identity);
        state.general[0].rgb.out.scale = scale;
        const BatchProgram program(compile(state, p).value(), {.registers = true});
        if (one == 255 && scale != Scale::by_one_half) {
          EXPECT_NE(program.describe().find("u16:"), std::string::npos) << p.name << ' ' << name_of(scale);
        }
        const std::vector<s9> expected = outputs_by_oracle(p, scale, Bias::none, 0, most, 1);
        std::vector<int> wides;
        const auto flush = [&] {
          for (const std::int64_t target : simd_targets()) {
            const OnTarget on_target(target);
            program.run(*batch, wides.size(), *out);
            for (std::size_t i = 0; i < wides.size(); ++i) {
              ASSERT_EQ((*batch)(Register::spare1, kGreen)[i], expected[static_cast<std::size_t>(wides[i])])
                  << p.name << ' ' << name_of(scale) << ' ' << products << " products, " << wides[i] << " on "
                  << simd_target_name(target);
            }
          }
          wides.clear();
        };
        int tried = 0;
        for (int wide = 0; wide <= most; wide += kSlowBuild ? 7 : 1) {
          if (!split(wide, products, one, *batch, wides.size())) continue;
          wides.push_back(wide);
          ++tried;
          if (wides.size() == kBatchSize) flush();
          if (HasFatalFailure()) return;
        }
        flush();
        // The last factor takes any rest below one; beyond that it is one itself.
        if (!kSlowBuild) {
          EXPECT_EQ(tried, (products - 1) * one * one + 2 * one);
        }
      }
    }
  }
}

// All pairs of factors of one product, which the sums above do not have.
TEST(NarrowLanes, EveryProductOfTwoPositiveCodes) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const int one = p.one;
    for (const Scale scale : {Scale::none, Scale::by_two, Scale::by_four}) {
      CombinerState state = silent_state(1);
      state.general[0].rgb = portion_of(1, InputMapping::unsigned_identity);
      state.general[0].rgb.out.scale = scale;
      const BatchProgram program(compile(state, p).value(), {.registers = true});
      const std::vector<s9> expected = outputs_by_oracle(p, scale, Bias::none, 0, one * one, 1);
      for (int x = 0; x <= one; x += kSlowBuild ? 15 : 1) {
        for (int y = 0; y <= one; ++y) {
          (*batch)(Register::primary, kRed)[y] = static_cast<s9>(x);
          (*batch)(Register::secondary, kRed)[y] = static_cast<s9>(y);
        }
        for (const std::int64_t target : simd_targets()) {
          const OnTarget on_target(target);
          program.run(*batch, static_cast<std::size_t>(one + 1), *out);
          for (int y = 0; y <= one; ++y) {
            ASSERT_EQ((*batch)(Register::spare1, kRed)[y], expected[static_cast<std::size_t>(x * y)])
                << p.name << ' ' << name_of(scale) << ' ' << x << ' ' << y << " on " << simd_target_name(target);
          }
        }
      }
    }
  }
}

// A·1 + C·1 and A·1 - C·1 of all pairs of codes, and A·1 alone.
TEST(NarrowLanes, EverySumAndDifferenceOfTwoCodes) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  for (const HardwareProfile& p : profiles_and_rivals()) {
    const int one = p.one, lowest = p.lowest;
    for (const auto& [scale, bias] : kScaleBias) {
      const int most = 2 * std::max(one, -lowest);
      const std::vector<s9> expected = outputs_by_oracle(p, scale, bias, -most * one, most * one, one);
      for (const int sign : {1, -1}) {
        CombinerState state = silent_state(1);
        Portion& rgb = state.general[0].rgb;
        rgb.a = rgb_of(Register::primary, InputMapping::signed_identity);
        rgb.b = kOne;
        rgb.c = rgb_of(Register::secondary, sign > 0 ? InputMapping::signed_identity : InputMapping::signed_negate);
        rgb.d = kOne;
        rgb.out.sum = Register::spare1;
        rgb.out.ab = Register::spare0;
        rgb.out.scale = scale;
        rgb.out.bias = bias;
        const BatchProgram program(compile(state, p).value(), {.registers = true});
        EXPECT_EQ(program.describe().find(':'), std::string::npos) << "nothing is multiplied or divided";
        for (int x = lowest; x <= one; x += kSlowBuild ? 15 : 1) {
          for (int first = lowest; first <= one; first += static_cast<int>(kBatchSize)) {
            const auto count = static_cast<std::size_t>(std::min(static_cast<int>(kBatchSize), one - first + 1));
            for (std::size_t i = 0; i < count; ++i) {
              (*batch)(Register::primary, kRed)[i] = static_cast<s9>(x);
              (*batch)(Register::secondary, kRed)[i] = static_cast<s9>(first + static_cast<int>(i));
            }
            for (const std::int64_t target : simd_targets()) {
              const OnTarget on_target(target);
              program.run(*batch, count, *out);
              for (std::size_t i = 0; i < count; ++i) {
                const int y = sign * (first + static_cast<int>(i));
                ASSERT_EQ((*batch)(Register::spare1, kRed)[i], expected[static_cast<std::size_t>(x + y + most)])
                    << p.name << ' ' << name_of(scale) << ' ' << name_of(bias) << ' ' << x << " + " << y << " on "
                    << simd_target_name(target);
                ASSERT_EQ((*batch)(Register::spare0, kRed)[i], expected[static_cast<std::size_t>(x + most)])
                    << p.name << ' ' << name_of(scale) << ' ' << name_of(bias) << ' ' << x << " on "
                    << simd_target_name(target);
              }
            }
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace ninebit::test

// AB + CD over every ordered pair of distinct products of two mapped values, on the SIMD code, against plain integers.
//
// An output depends on AB and CD by their sum alone, and products_test.cpp shows that it is right for every sum. What
// remains is that the sum itself is formed exactly, for every pair of what the two multiplications can give. With the
// factors in [-one, one] there are 35,155 distinct products with one = 255 (9,293 with 127), and 1,235,874,025 ordered
// pairs (86,359,849). Exhaustive on the best SIMD target of the machine, for each of the six legal pairs of scale and
// bias:
//   geforce2 and geforce256-8bit: every pair;
//   nv2a and geforce2-early-truncation: every pair whose first product is one of each sixteen in order of size, and
//   with NINEBIT_EXHAUSTIVE=1 every pair, which takes minutes.
// The other targets get one of 64, with NINEBIT_EXHAUSTIVE=1 all. Sanitized builds get one of 256.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/combiner/support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

struct Product {
  int value = 0;
  s9 x = 0, y = 0;  // one way to make it
};

// All distinct products of whole numbers in [-one, one] that are not negative, in order.
std::vector<Product> products(int one) {
  std::vector<Product> all(static_cast<std::size_t>(one * one + 1), Product{-1, 0, 0});
  for (int x = 0; x <= one; ++x) {
    for (int y = x; y <= one; ++y) {
      all[static_cast<std::size_t>(x * y)] = {x * y, static_cast<s9>(x), static_cast<s9>(y)};
    }
  }
  all.erase(std::remove_if(all.begin(), all.end(), [](const Product& p) { return p.value < 0; }), all.end());
  return all;
}

// Planes of kBatchSize second products each, in order; the last ones repeat to fill the last plane.
struct Inner {
  explicit Inner(const std::vector<Product>& positive) {
    std::vector<Product> all;
    for (auto p = positive.rbegin(); p != positive.rend(); ++p) {
      if (p->value != 0) all.push_back({-p->value, static_cast<s9>(-p->x), p->y});
    }
    all.insert(all.end(), positive.begin(), positive.end());
    distinct = all.size();
    while (all.size() % kBatchSize != 0) all.push_back(all.back());
    for (const Product& p : all) {
      value.push_back(p.value);
      x.push_back(p.x);
      y.push_back(p.y);
    }
  }
  std::size_t distinct = 0;
  std::vector<int> value;
  std::vector<s9> x, y;
};

// Stage 0: spare0 = primary · secondary + texture0 · texture1. Stage 1: spare1 = -primary · secondary + the same. So a
// fragment sums two first products with a second one in each of its four components.
BatchProgram sums_program(const HardwareProfile& profile, Scale scale, Bias bias) {
  CombinerState state = silent_state(2);
  const auto as_is = [](Register reg) { return rgb_of(reg, InputMapping::signed_identity); };
  for (std::size_t i = 0; i < 2; ++i) {
    Portion& rgb = state.general[i].rgb;
    rgb = {as_is(Register::primary), as_is(Register::secondary), as_is(Register::texture0), as_is(Register::texture1),
           sum_to(i == 0 ? Register::spare0 : Register::spare1, scale, bias)};
    if (i == 1) rgb.a.mapping = InputMapping::signed_negate;
    state.general[i].alpha = of_alpha(rgb);
  }
  return BatchProgram(compile(state, profile).value(), {.registers = true});
}

// Whether all sums of `first` with the second products in `value` came out as expected. Those are in order, and so are
// the outputs: equal ones are side by side.
bool all_as_expected(const s9* actual, const s9* expected_of_zero, int first, const int* value) {
  const s9* const expected = expected_of_zero + first;
  int difference = 0;
  for (const int *begin = value, *const end = value + kBatchSize; begin != end;) {
    const s9 output = expected[*begin];
    const int* const next = std::partition_point(begin, end, [&](int v) { return expected[v] == output; });
    for (std::ptrdiff_t i = begin - value; i < next - value; ++i) difference |= actual[i] ^ output;
    begin = next;
  }
  return difference == 0;
}

class Sums : public testing::TestWithParam<std::tuple<const char*, std::size_t>> {
 protected:
  // Every `stride`-th group of four first products with every second product. Returns the number of sums.
  std::uint64_t run(const BatchProgram& program, const std::vector<Product>& positive, const Inner& inner,
                    const std::vector<s9>& expected, std::size_t stride, std::size_t offset) {
    const s9* const expected_of_zero = expected.data() + expected.size() / 2;
    const auto batch = std::make_unique<RegisterBatch>();
    const auto out = std::make_unique<OutputBatch>();
    std::uint64_t sums = 0;
    for (std::size_t group = 4 * offset; group < positive.size(); group += 4 * stride) {
      std::array<Product, 4> first;
      for (std::size_t c = 0; c < 4; ++c) {
        first[c] = positive[std::min(group + c, positive.size() - 1)];
        std::fill_n((*batch)(Register::primary, static_cast<int>(c)), kBatchSize, first[c].x);
        std::fill_n((*batch)(Register::secondary, static_cast<int>(c)), kBatchSize, first[c].y);
      }
      for (std::size_t at = 0; at < inner.value.size(); at += kBatchSize) {
        for (int c = 0; c < 4; ++c) {
          std::copy_n(inner.x.data() + at, kBatchSize, (*batch)(Register::texture0, c));
          std::copy_n(inner.y.data() + at, kBatchSize, (*batch)(Register::texture1, c));
        }
        program.run(*batch, kBatchSize, *out);
        for (std::size_t c = 0; c < 4; ++c) {
          const auto component = static_cast<int>(c);
          const int* const value = inner.value.data() + at;
          if (!all_as_expected((*batch)(Register::spare0, component), expected_of_zero, first[c].value, value) ||
              !all_as_expected((*batch)(Register::spare1, component), expected_of_zero, -first[c].value, value)) {
            ADD_FAILURE() << "a sum with plus or minus " << first[c].value << " in component " << c
                          << ", second products from " << *value << " on";
            return sums;
          }
        }
      }
      sums += 2 * std::min<std::size_t>(4, positive.size() - group) * inner.distinct;
    }
    return sums;
  }
};

TEST_P(Sums, EveryPairOfDistinctProducts) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  const auto& [name, option] = GetParam();
  const HardwareProfile& profile = *find_profile(name);
  const auto [scale, bias] = kScaleBias[option];
  const int one = profile.one;
  const bool all_of_all = std::getenv("NINEBIT_EXHAUSTIVE") != nullptr;
  const std::vector<Product> positive = products(one);
  const Inner inner(positive);
  ASSERT_EQ(positive.size() * 2 - 1, inner.distinct);
  ASSERT_EQ(inner.distinct, one == 255 ? 35155U : 9293U);

  const BatchProgram program = sums_program(profile, scale, bias);
  const std::vector<s9> expected = outputs_by_oracle(profile, scale, bias, -2 * one * one, 2 * one * one);
  ASSERT_TRUE(std::is_sorted(expected.begin(), expected.end()));
  std::uint64_t sums = 0;
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on_target(target);
    // Emulated vectors are the best target only of a build that has no others, as combiner_tests/builds/run makes.
    const bool best = target == simd_targets().front() && simd_target_name(target) != "EMU128";
    std::size_t stride = kSlowBuild ? 256 : !best ? 64 : profile.name == "geforce2" || one == 127 ? 1 : 16;
    if (all_of_all) stride = 1;
    const std::uint64_t done = run(program, positive, inner, expected, stride, option % stride);
    if (HasFailure()) FAIL() << profile.name << " on " << simd_target_name(target);
    ASSERT_TRUE(on_target.ran()) << simd_target_name(target);
    if (target == simd_targets().front()) sums = done;
    if (stride > 1) {
      EXPECT_GE(done * stride * 2, inner.distinct * inner.distinct);
    } else {
      // Zero is its own negative, and was the first product twice.
      EXPECT_EQ(done - inner.distinct, inner.distinct * inner.distinct);
    }
  }
  RecordProperty("sums", std::to_string(sums));
}

std::string name_of_run(const testing::TestParamInfo<Sums::ParamType>& run) {
  const auto [scale, bias] = kScaleBias[std::get<1>(run.param)];
  std::string text = std::string(std::get<0>(run.param)) + '_' + std::string(name_of(scale));
  if (bias != Bias::none) text += "_bias";
  std::replace(text.begin(), text.end(), '-', '_');
  return text;
}

INSTANTIATE_TEST_SUITE_P(ScalesAndBiases, Sums,
                         testing::Combine(testing::Values("geforce2", "geforce256-8bit", "nv2a",
                                                          "geforce2-early-truncation"),
                                          testing::Range(std::size_t{0}, kScaleBias.size())),
                         name_of_run);

}  // namespace
}  // namespace ninebit::test

// Errors of the datapath's operations: counts and extremes against direct enumeration.
#include "ninebit/study/datapath_error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <string>

#include "ninebit/combiner/evaluate.h"
#include "src/study/wide_counts.h"

namespace {

using namespace ninebit;

const DatapathErrors& all_errors() {
  static const DatapathErrors errors = *measure_datapath(hardware_profiles(), {});
  return errors;
}

const OperationError& error_of(std::string_view profile, std::string_view operation, std::string_view form) {
  for (const OperationError& e : all_errors().errors) {
    if (e.profile == profile && e.operation == operation && e.form == form) return e;
  }
  throw std::runtime_error("no such operation");
}

TEST(WideCounts, SumsOfProductsAreCountedLikeByHand) {
  const WideCounts one = product_counts(3), two = sum_counts(one, one), three = sum_counts(two, one);
  std::map<int, std::uint64_t> by_hand;
  for (int a = -3; a <= 3; ++a)
    for (int b = -3; b <= 3; ++b)
      for (int c = -3; c <= 3; ++c)
        for (int d = -3; d <= 3; ++d)
          for (int e = -3; e <= 3; ++e)
            for (int f = -3; f <= 3; ++f) ++by_hand[a * b + c * d + e * f];
  ASSERT_EQ(three.limit, 27);
  for (int w = -27; w <= 27; ++w) EXPECT_EQ(three.of(w), by_hand[w]) << w;
}

// All 511 x 511 products, one by one, in the extension's real numbers.
TEST(DatapathErrors, ProductsMatchDirectEnumeration) {
  for (const HardwareProfile* profile : {&profiles::geforce2, &profiles::nv2a}) {
    const Datapath d = datapath_of(*profile);
    std::uint64_t exact = 0;
    double largest = 0.0, sum = 0.0;
    for (int a = -255; a <= 255; ++a) {
      for (int b = -255; b <= 255; ++b) {
        const int code = reference::combiner_output(d, Scale::by_two, Bias::by_negative_one_half, a * b);
        const double should = std::clamp((a * b / 65025.0 - 0.5) * 2.0, -1.0, 1.0);
        const double error = code / 255.0 - should;
        if (std::fabs(error) < 1e-12) ++exact;
        largest = std::max(largest, std::fabs(error));
        sum += error;
      }
    }
    const OperationError& e = error_of(profile->name, "product", "-1/2, x2");
    EXPECT_EQ(e.cases, 511U * 511U);
    EXPECT_EQ(e.exact, exact) << profile->name;
    EXPECT_NEAR(e.max_error, largest, 1e-12);
    EXPECT_NEAR(e.mean_bias, sum / (511.0 * 511.0), 1e-12);
  }
}

TEST(DatapathErrors, KnownFactsComeOut) {
  // The GeForce 2 cuts products toward zero: never more than a code, and no bias on the whole, as both signs occur.
  const OperationError& product = error_of("geforce2", "product", "x1");
  EXPECT_LT(product.max_error, 1.0 / 255.0);
  EXPECT_GT(product.max_error, 0.99 / 255.0);
  EXPECT_NEAR(product.mean_bias, 0.0, 1e-15);
  // To nearest it is half of that, but for halves.
  EXPECT_LE(error_of("nv2a", "product", "x1").max_error, 0.5 / 255.0 + 1e-12);
  // signed_identity is exact, and one half is 128 of 255.
  EXPECT_EQ(error_of("geforce2", "mapping", "signed_identity").exact, 511U);
  EXPECT_NEAR(error_of("geforce2", "mapping", "half_bias_normal").max_error, 0.5 / 255.0, 1e-12);
  EXPECT_EQ(error_of("geforce2", "dot product", "x1").cases,
            std::uint64_t{511} * 511 * 511 * 511 * 511 * 511);
  EXPECT_EQ(error_of("geforce2", "AB + CD", "x4").cases, std::uint64_t{511} * 511 * 511 * 511);
  EXPECT_EQ(error_of("geforce2", "final lerp", "A B + (1 - A) C + D").cases, std::uint64_t{1} << 32);
  EXPECT_EQ(error_of("geforce2", "mux takes CD", "").max_error, 0.0);
  EXPECT_EQ(error_of("geforce2", "product", "x1").distinct, 511U);
}

TEST(DatapathErrors, TheWorstCaseIsOne) {
  const OperationError& e = error_of("geforce2", "product", "x1");
  int a = 0, b = 0;
  ASSERT_EQ(std::sscanf(e.worst.c_str(), "%d * %d", &a, &b), 2) << e.worst;
  EXPECT_EQ(reference::combiner_output(datapath_of(profiles::geforce2), Scale::none, Bias::none, a * b), e.worst_code);
  EXPECT_NEAR(std::fabs(e.worst_code / 255.0 - a * b / 65025.0), e.max_error, 1e-12);
}

TEST(DatapathErrors, ProfilesDifferWhereTheyShould) {
  for (const OperationDifference& d : all_errors().differences) {
    if (d.first != "geforce2" || d.second != "geforce2-early-truncation") continue;
    // Truncation before the scale matters only where something is scaled up.
    if (d.operation == "mapping" || d.form == "x1" || d.form == "-1/2, x1") {
      EXPECT_EQ(d.differ, 0U) << d.operation << ' ' << d.form;
    }
    if (d.operation == "product" && d.form == "x4") {
      EXPECT_GT(d.differ, 10'000U);
    }
  }
}

TEST(DatapathErrors, StopsWhenAsked) {
  const auto stopped = measure_datapath({&profiles::geforce256_8bit, 1}, [](double) { return false; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().fault, Fault::cancelled);
}

}  // namespace

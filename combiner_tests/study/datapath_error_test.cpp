// Errors of the datapath's operations: counts and extremes against direct enumeration.
#include "ninebit/study/datapath_error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "combiner_tests/study/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/study/report_files.h"
#include "src/study/datapath/operations.h"
#include "src/study/digits/digits.h"

namespace {

using namespace ninebit;
using namespace ninebit::test;

const Study& study() {
  static const std::unique_ptr<Study> all =
      valid(datapath_study({.study = "datapath", .profile = "all"}, hardware_profiles()));
  return *all;
}

const std::vector<StudyRow>& rows() {
  static const std::vector<StudyRow> all = all_rows(study());
  return all;
}

const StudyRow& error_of(std::string_view profile, std::string_view operation, std::string_view form) {
  for (const StudyRow& row : rows()) {
    if (row.table == "rows" && row.text("profile") == profile && row.text("operation") == operation &&
        row.text("form") == form) {
      return row;
    }
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

TEST(WideCounts, SumsOfCodesAreCountedLikeOneByOne) {
  const WideCounts one = product_counts(255), two = sum_counts(one, one), three = sum_counts(two, one);
  std::uint64_t total = 0;
  for (const std::uint64_t count : three.count) total += count;
  EXPECT_EQ(total, 511ULL * 511 * 511 * 511 * 511 * 511);
  for (const int wide : {-130050, -65026, -12345, -1, 0, 1, 254, 65025, 130050}) {
    std::uint64_t in_two = 0, in_three = 0;
    for (int part = -one.limit; part <= one.limit; ++part) {
      const int rest = wide - part;
      if (std::abs(rest) <= one.limit) in_two += one.of(part) * one.of(rest);
      if (std::abs(rest) <= two.limit) in_three += one.of(part) * two.of(rest);
    }
    EXPECT_EQ(two.of(wide), in_two) << wide;
    EXPECT_EQ(three.of(wide), in_three) << wide;
  }
}

// All 511 x 511 products, one by one, in the extension's real numbers.
void products_match_direct_enumeration() {
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
    const StudyRow& e = error_of(profile->name, "product", "-1/2, x2");
    EXPECT_EQ(e.count("cases"), 511U * 511U);
    EXPECT_EQ(e.count("exact"), exact) << profile->name;
    EXPECT_NEAR(e.number("max_error_codes"), largest * 255.0, 1e-9);
    EXPECT_NEAR(e.number("mean_bias_codes"), sum * 255.0 / (511.0 * 511.0), 1e-9);
  }
}

// Every operation at a size that allows all inputs one by one: the sums of one, two and three products.
TEST(DatapathErrors, SumsMatchDirectEnumerationOfSmallCodes) {
  HardwareProfile profile = small_profile(3);
  profile.general_narrowing.value = Narrowing::nearest_halves_up;
  const Datapath d = datapath_of(profile);
  const auto small = valid(datapath_study({.study = "datapath", .profile = "small"}, {&profile, 1}));
  std::map<std::string, const StudyRow*> found;
  const std::vector<StudyRow> all = all_rows(*small);
  for (const StudyRow& row : all) found[row.text("operation") + " " + row.text("form")] = &row;
  for (const OutputForm& form : kOutputForms) {
    std::vector<int> wides{0};
    for (const char* operation : {"product", "AB + CD", "dot product"}) {
      std::vector<int> next;
      for (const int wide : wides)
        for (int a = -3; a <= 3; ++a)
          for (int b = -3; b <= 3; ++b) next.push_back(wide + a * b);
      wides = next;
      std::uint64_t exact = 0;
      std::map<int, int> codes;
      double largest = 0.0, sizes = 0.0;
      for (const int wide : wides) {
        const int code = reference::combiner_output(d, form.scale, form.bias, wide);
        const double scale = form.name.ends_with("x4")   ? 4
                             : form.name.ends_with("x2") ? 2
                             : form.name == "x1/2"       ? 0.5
                                                         : 1;
        const double should = std::clamp((wide / 9.0 - (form.bias == Bias::none ? 0.0 : 0.5)) * scale, -1.0, 1.0);
        const double error = std::fabs(code / 3.0 - should);
        if (error < 1e-12) ++exact;
        largest = std::max(largest, error);
        sizes += error;
        ++codes[code];
      }
      const StudyRow& row = *found.at(std::string(operation) + " " + std::string(form.name));
      EXPECT_EQ(row.count("cases"), wides.size());
      EXPECT_EQ(row.count("exact"), exact) << operation << ' ' << form.name;
      EXPECT_EQ(row.count("distinct"), codes.size()) << operation << ' ' << form.name;
      EXPECT_NEAR(row.number("max_error_codes"), largest * 3.0, 1e-11) << operation << ' ' << form.name;
      EXPECT_NEAR(row.number("mean_error_codes"), sizes * 3.0 / static_cast<double>(wides.size()), 1e-11);
    }
  }
}

// A·B + (1 - A)·C + D and E·F of all small codes, as the extension writes them.
TEST(DatapathErrors, FinalCombinerMatchesDirectEnumerationOfSmallCodes) {
  const HardwareProfile profile = small_profile(5);
  const Datapath d = datapath_of(profile);
  const auto small = valid(datapath_study({.study = "datapath", .profile = "small"}, {&profile, 1}));
  std::uint64_t exact = 0, exact_products = 0;
  double sum = 0.0, products = 0.0;
  for (int a = 0; a <= 5; ++a)
    for (int b = 0; b <= 5; ++b) {
      const double error = reference::e_times_f(d, a, b) / 5.0 - a * b / 25.0;
      if (std::fabs(error) < 1e-12) ++exact_products;
      products += error;
      for (int c = 0; c <= 5; ++c)
        for (int added = 0; added <= 5; ++added) {
          const double should = std::min((a * b + (5 - a) * c) / 25.0 + added / 5.0, 1.0);
          const double wrong = reference::final_rgb(d, a, b, c, added) / 5.0 - should;
          if (std::fabs(wrong) < 1e-12) ++exact;
          sum += wrong;
        }
    }
  int seen = 0;
  for (const StudyRow& row : all_rows(*small)) {
    if (row.text("operation") == "final lerp") {
      ++seen;
      EXPECT_EQ(row.count("cases"), 1296U);
      EXPECT_EQ(row.count("exact"), exact);
      EXPECT_NEAR(row.number("mean_bias_codes"), sum * 5.0 / 1296.0, 1e-11);
    }
    if (row.text("operation") == "E times F") {
      ++seen;
      EXPECT_EQ(row.count("exact"), exact_products);
      EXPECT_NEAR(row.number("mean_bias_codes"), products * 5.0 / 36.0, 1e-11);
    }
  }
  EXPECT_EQ(seen, 2);
}

void known_facts_come_out() {
  // The GeForce 2 cuts products toward zero: never more than a code, and no bias on the whole, as both signs occur.
  const StudyRow& product = error_of("geforce2", "product", "x1");
  EXPECT_LT(product.number("max_error_codes"), 1.0);
  EXPECT_GT(product.number("max_error_codes"), 0.99);
  EXPECT_NEAR(product.number("mean_bias_codes"), 0.0, 1e-12);
  // To nearest it is half of that, but for halves.
  EXPECT_LE(error_of("nv2a", "product", "x1").number("max_error_codes"), 0.5 + 1e-9);
  // signed_identity is exact, and one half is 128 of 255.
  EXPECT_EQ(error_of("geforce2", "mapping", "signed_identity").count("exact"), 511U);
  EXPECT_NEAR(error_of("geforce2", "mapping", "half_bias_normal").number("max_error_codes"), 0.5, 1e-9);
  EXPECT_EQ(error_of("geforce2", "dot product", "x1").count("cases"), std::uint64_t{511} * 511 * 511 * 511 * 511 * 511);
  EXPECT_EQ(error_of("geforce2", "AB + CD", "x4").count("cases"), std::uint64_t{511} * 511 * 511 * 511);
  EXPECT_EQ(error_of("geforce2", "final lerp", "A B + (1 - A) C + D").count("cases"), std::uint64_t{1} << 32);
  EXPECT_EQ(error_of("geforce2", "mux takes CD", "").number("max_error_codes"), 0.0);
  EXPECT_EQ(error_of("geforce2", "product", "x1").count("distinct"), 511U);
}

void the_worst_case_is_one() {
  const StudyRow& e = error_of("geforce2", "product", "x1");
  int a = 0, b = 0;
  ASSERT_EQ(std::sscanf(e.text("worst").c_str(), "%d * %d", &a, &b), 2) << e.text("worst");
  const int code = reference::combiner_output(datapath_of(profiles::geforce2), Scale::none, Bias::none, a * b);
  EXPECT_EQ(e.number("worst_code"), code);
  EXPECT_NEAR(std::fabs(code - a * b / 255.0), e.number("max_error_codes"), 1e-9);
}

void profiles_differ_where_they_should() {
  int compared = 0;
  for (const StudyRow& d : rows()) {
    if (d.table != "differences" || d.text("first") != "geforce2" || d.text("second") != "geforce2-early-truncation") {
      continue;
    }
    ++compared;
    // Truncation before the scale matters only where something is scaled up.
    const std::string operation = d.text("operation"), form = d.text("form");
    if (operation == "mapping" || form == "x1" || form == "-1/2, x1") {
      EXPECT_EQ(d.count("differ"), 0U) << operation << ' ' << form;
    }
    if (operation == "product" && form == "x4") {
      EXPECT_GT(d.count("differ"), 10'000U);
    }
  }
  EXPECT_EQ(compared, 8 + 4 * 6 + 1 + 2 + 1 + 1);
}

TEST(DatapathErrors, StopsWhenAsked) {
  const auto stopped = study().run(0, [] { return false; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().fault, Fault::cancelled);
}

TEST(DatapathErrors, RealNumbersHaveNoDatapath) {
  const auto none = datapath_study({.study = "datapath", .profile = "ideal"}, {&profiles::ideal, 1});
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.error().text().find("ideal"), std::string::npos);
}

// One pixel a case, the error of that very case under it.
void the_report_has_maps_and_tables() {
  const auto report = study().report(rows(), study().units());
  ASSERT_TRUE(report.ok());
  EXPECT_EQ(report->tables.size(), 5U);  // four profiles, and the differences
  EXPECT_EQ(report->plots.size(), 3U);
  int products = 0, small = 0;
  for (const HeatMap& map : report->heat_maps) {
    ASSERT_EQ(map.values.size(), static_cast<std::size_t>(map.width * map.height)) << map.file;
    if (map.file == "product-x4-geforce2") {
      ++products;
      EXPECT_EQ(map.width, 511);
      // A = -255 on the left, B = 255 on top.
      const int a = 100, b = 7;
      const int code = reference::combiner_output(datapath_of(profiles::geforce2), Scale::by_four, Bias::none, a * b);
      EXPECT_NEAR(map.values[static_cast<std::size_t>((255 - b) * 511 + a + 255)], code - a * b * 4 / 255.0, 1e-6);
      EXPECT_EQ(map.x_first, -255.0);
      EXPECT_EQ(map.y_first, 255.0);
    }
    if (map.file == "e-times-f-geforce2") {
      ++small;
      EXPECT_EQ(map.width, 256);
    }
  }
  EXPECT_EQ(products, 1);
  EXPECT_EQ(small, 1);
  const auto html = report_html(study().question(), "1", *report, rows());
  ASSERT_TRUE(html.ok());
  EXPECT_LT(html->size(), 2000000U);
  EXPECT_EQ(report->headlines.size(), 1U);
  ASSERT_EQ(report->summary.size(), 2U);
  EXPECT_EQ(report->summary[0].rows.size(), 4U);
  // Half of what there is, for a run that was interrupted.
  const auto part = study().report(std::span(rows()).first(8), 1);
  ASSERT_TRUE(part.ok());
  EXPECT_NE(part->answers.front().find("Only 1 of"), std::string::npos);
}

// One test, because the study that it looks at takes seconds.
TEST(DatapathErrors, OfAllProfiles) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  {
    SCOPED_TRACE("products match direct enumeration");
    products_match_direct_enumeration();
  }
  {
    SCOPED_TRACE("known facts come out");
    known_facts_come_out();
  }
  {
    SCOPED_TRACE("the worst case is one");
    the_worst_case_is_one();
  }
  {
    SCOPED_TRACE("profiles differ where they should");
    profiles_differ_where_they_should();
  }
  {
    SCOPED_TRACE("the report has maps and tables");
    the_report_has_maps_and_tables();
  }
}

// A part's rows are checked by the names of the forms, which are there without the work of making the forms.
TEST(DatapathForms, HaveTheirNamesWithoutBeingMade) {
  constexpr int kSmallOne = 15;
  Operations operations(kSmallOne);
  for (std::size_t kind = 0; kind < kOperations.size(); ++kind) {
    std::vector<std::string> made;
    for (const DatapathOperation& form : operations.of(kind)) made.push_back(form.form);
    EXPECT_EQ(forms_of(kind), made) << kOperations[kind];
  }
}

}  // namespace

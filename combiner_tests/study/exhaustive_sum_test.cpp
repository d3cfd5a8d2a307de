// AB + CD case by case: the lanes against the oracle on every SIMD target, and the whole against the study that counts.
#include "ninebit/study/exhaustive_sum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/oracle/combiner_oracle.h"
#include "combiner_tests/study/support.h"
#include "combiner_tests/support/slow_build.h"
#include "src/study/datapath/sum_kernels.h"

namespace {

using namespace ninebit;
using namespace ninebit::test;

// The oracle's code for each wide value of AB + CD.
std::vector<int> oracle_codes(const HardwareProfile& p, const OutputForm& form) {
  const int square = p.one * p.one;
  std::vector<int> codes;
  for (int wide = -2 * square; wide <= 2 * square; ++wide) {
    codes.push_back(oracle::general_output(p, form.scale, form.bias, {wide, square}));
  }
  return codes;
}

// Every C and D in plain loops, with fractions over 4 one² written out.
SumTotals by_hand(const HardwareProfile& p, const OutputForm& form, const std::vector<int>& codes, int a, int b) {
  const int one = p.one, square = one * one;
  SumTotals out;
  for (int c = -one; c <= one; ++c) {
    for (int d = -one; d <= one; ++d) {
      const int wide = a * b + c * d;
      const int code = codes[static_cast<std::size_t>(wide + 2 * square)];
      int exact = 4 * wide - (form.bias == Bias::none ? 0 : 2 * square);
      if (form.scale == Scale::by_two) exact *= 2;
      if (form.scale == Scale::by_four) exact *= 4;
      if (form.scale == Scale::by_one_half) exact /= 2;  // 4 wide is even, and a bias has no scale of one half
      exact = std::clamp(exact, -4 * square, 4 * square);
      const int error = 4 * one * code - exact;
      ++out.cases;
      if (error != 0) ++out.inexact;
      out.max_error = std::max<std::int64_t>(out.max_error, std::abs(error));
      out.sum_of_sizes += std::abs(error);
      out.sum_of_errors += error;
      out.sum_of_codes += code;
      out.sum_of_squares += code * code;
    }
  }
  return out;
}

std::string said(const SumTotals& t) {
  return std::to_string(t.cases) + " cases, " + std::to_string(t.inexact) + " inexact, at most " +
         std::to_string(t.max_error) + ", sizes " + std::to_string(t.sum_of_sizes) + ", errors " +
         std::to_string(t.sum_of_errors) + ", codes " + std::to_string(t.sum_of_codes) + ", squares " +
         std::to_string(t.sum_of_squares);
}

// The choices that the lanes read, and their rivals.
std::vector<HardwareProfile> with_rivals(const HardwareProfile& base) {
  std::vector<HardwareProfile> all;
  for (const Narrowing narrowing : {Narrowing::toward_zero, Narrowing::nearest_halves_up}) {
    for (const NarrowingPoint point : {NarrowingPoint::after_scale, NarrowingPoint::before_scale}) {
      HardwareProfile p = base;
      p.general_narrowing.value = narrowing;
      p.narrowing_point.value = point;
      all.push_back(p);
      p.lowest.value -= 1;
      p.lowest_output.value -= 1;
      p.half.value -= 1;
      all.push_back(p);
    }
  }
  return all;
}

void expect_by_hand(const HardwareProfile& p, const OutputForm& form, const std::vector<int>& codes, int a, int b) {
  const SumTotals expected = by_hand(p, form, codes, a, b);
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on_target(target);
    const SumTotals actual = sum_totals(datapath_of(p), form, a, b);
    ASSERT_TRUE(on_target.ran());
    ASSERT_EQ(actual, expected) << form.name << ", A = " << a << ", B = " << b << " on " << simd_target_name(target)
                                << "\n"
                                << said(actual) << "\ninstead of\n"
                                << said(expected);
  }
}

TEST(ExhaustiveSum, EveryCaseOfSmallCodesOnEverySimdTarget) {
  for (const int one : {1, 7}) {
    for (const HardwareProfile& p : with_rivals(small_profile(one))) {
      for (const OutputForm& form : kOutputForms) {
        const std::vector<int> codes = oracle_codes(p, form);
        for (int a = -one; a <= one; ++a) {
          for (int b = -one; b <= one; ++b) expect_by_hand(p, form, codes, a, b);
        }
      }
    }
  }
}

TEST(ExhaustiveSum, SlicesOfNineBitsOnEverySimdTarget) {
  for (const HardwareProfile& p : with_rivals(profiles::geforce2)) {
    for (const OutputForm& form : kOutputForms) {
      const std::vector<int> codes = oracle_codes(p, form);
      for (const auto& [a, b] : {std::pair{201, -77}, {255, 255}, {-255, 255}, {3, 1}}) {
        expect_by_hand(p, form, codes, a, b);
      }
    }
  }
}

struct Family {
  std::uint64_t cases = 0, exact = 0;
  double max_error = 0.0, sizes = 0.0, errors = 0.0;
};

Family family_of(const std::vector<StudyRow>& rows, std::string_view form) {
  Family all;
  for (const StudyRow& row : rows) {
    if (row.text("form") != form) continue;
    all.cases += row.count("cases");
    all.exact += row.count("exact");
    EXPECT_EQ(row.count("exact") + row.count("inexact"), row.count("cases"));
    all.max_error = std::max(all.max_error, row.number("max_error_codes"));
    all.sizes += row.number("sum_of_sizes_codes_times_4one");
    all.errors += row.number("sum_of_errors_codes_times_4one");
  }
  return all;
}

// The study that counts wide values and this one must find the same, whole family against whole family.
void expect_counted(const HardwareProfile& p, std::span<const OutputForm> forms) {
  const auto exhaustive = valid(exhaustive_sum_study({.study = "datapath", .profile = "small"}, p, forms));
  const auto counted = valid(datapath_study({.study = "datapath", .profile = "small"}, {&p, 1}));
  const std::vector<StudyRow> rows = all_rows(*exhaustive);
  std::size_t compared = 0;
  for (std::size_t unit = 0; unit < counted->units(); ++unit) {
    if (counted->unit_name(unit).find("AB + CD") == std::string::npos) continue;
    const auto expected_rows = counted->run(unit, {});
    ASSERT_TRUE(expected_rows.ok());
    for (const StudyRow& expected : *expected_rows) {
      const Family all = family_of(rows, expected.text("form"));
      if (all.cases == 0) continue;  // not among the forms
      ++compared;
      EXPECT_EQ(all.cases, expected.count("cases"));
      EXPECT_EQ(all.exact, expected.count("exact")) << expected.text("form");
      EXPECT_NEAR(all.max_error, expected.number("max_error_codes"), 1e-9);
      const double codes = 1.0 / (4.0 * p.one) / static_cast<double>(all.cases);
      EXPECT_NEAR(all.sizes * codes, expected.number("mean_error_codes"), 1e-9);
      EXPECT_NEAR(all.errors * codes, expected.number("mean_bias_codes"), 1e-9);
    }
  }
  EXPECT_EQ(compared, forms.size());
}

TEST(ExhaustiveSum, AgreesWithTheCountedStudy) {
  for (const HardwareProfile& p : with_rivals(small_profile(15))) expect_counted(p, kOutputForms);
}

// 255^4 cases of a shipped profile.
TEST(ExhaustiveSum, AgreesWithTheCountedStudyOnEightBits) {
  if (kSlowBuild) GTEST_SKIP() << "4.2 billion cases";
  expect_counted(profiles::geforce256_8bit, {&kOutputForms[2], 1});
}

TEST(ExhaustiveSum, UnitsAndReport) {
  const HardwareProfile p = small_profile(3);
  const auto study =
      valid(exhaustive_sum_study({.study = "datapath", .profile = "small"}, p, std::span(kOutputForms).first(2)));
  EXPECT_EQ(study->units(), 14U);
  EXPECT_EQ(study->unit_name(8), "small, x2, A = -2");
  const std::vector<StudyRow> rows = all_rows(*study);
  ASSERT_EQ(rows.size(), 14U);
  EXPECT_EQ(rows[8].number("a"), -2.0);
  const auto report = study->report(rows, 14);
  ASSERT_TRUE(report.ok());
  ASSERT_EQ(report->answers.size(), 2U);
  EXPECT_NE(report->answers[0].find("2401 cases"), std::string::npos) << report->answers[0];
  ASSERT_EQ(report->tables.size(), 1U);
  EXPECT_EQ(report->tables[0].rows.size(), 2U);
  const auto stopped = study->run(0, [] { return false; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().fault, Fault::cancelled);
}

TEST(ExhaustiveSum, RefusesWhatHasNoCases) {
  EXPECT_FALSE(exhaustive_sum_study({}, profiles::float_shader, kOutputForms).ok());
  EXPECT_FALSE(exhaustive_sum_study({}, profiles::geforce2, {}).ok());
}

}  // namespace

// Rows from files: every study says what its rows look like, refuses any other, and its report stands those that it
// accepts.
#include "ninebit/study/row_rules.h"

#include <gtest/gtest.h>

#include <limits>

#include "combiner_tests/fuzz/memory_file.h"
#include "combiner_tests/fuzz/small_studies.h"
#include "combiner_tests/support/random.h"
#include "ninebit/study/study_part.h"
#include "src/study/part/part_text.h"
#include "src/system/hashing/openssl.h"

namespace {

using namespace ninebit;
using fuzz::small_studies;

// Texts that somebody may put in place of a value.
const std::vector<StudyValue>& hostile_values() {
  static const std::vector<StudyValue> values{std::monostate(),
                                              std::int64_t{-1},
                                              std::int64_t{0},
                                              std::numeric_limits<std::int64_t>::min(),
                                              std::numeric_limits<std::uint64_t>::max(),
                                              1e308,
                                              -1e308,
                                              1e-320,
                                              0.5,
                                              std::numeric_limits<double>::infinity(),
                                              std::numeric_limits<double>::quiet_NaN(),
                                              std::string(),
                                              std::string("x"),
                                              std::string("%s%n"),
                                              std::string("\x1b[31m"),
                                              std::string(100'000, 'a')};
  return values;
}

TEST(RowRules, RowsThatAStudyMakesFollowItsOwn) {
  for (const auto& study : small_studies()) {
    SCOPED_TRACE(study->question().command());
    // The first and the last unit: those of the datapath take long.
    for (const std::size_t unit : {std::size_t{0}, study->units() - 1}) {
      const auto rows = study->run(unit, {});
      ASSERT_TRUE(rows) << rows.error().text();
      EXPECT_EQ(wrong_with_rows(study->row_rules(unit), *rows), "");
      // As they come back from a file, where a whole number has lost its type.
      std::string line = unit_line({unit, *rows});
      line.pop_back();
      const auto back = parse_unit_line(line);
      ASSERT_TRUE(back) << back.error().text();
      EXPECT_EQ(wrong_with_rows(study->row_rules(unit), back->rows), "");
    }
  }
}

TEST(RowRules, EveryNameTellsAStudyFromTheOthers) {
  for (const auto& study : small_studies()) {
    for (const auto& other : small_studies()) {
      if (study == other) continue;
      EXPECT_NE(wrong_with_rows(study->row_rules(0), fuzz::rows_by_rules(*other, 0, 0.5)), "")
          << study->unit_name(0) << " takes rows of " << other->unit_name(0);
    }
    if (study->units() > 1) {
      EXPECT_NE(wrong_with_rows(study->row_rules(0), fuzz::rows_by_rules(*study, 1, 0.5)), "") << study->unit_name(0);
    }
  }
}

TEST(RowRules, ChangedRowsAreRefused) {
  for (const auto& study : small_studies()) {
    SCOPED_TRACE(study->question().command());
    const std::vector<RowRule> rules = study->row_rules(0);
    const std::vector<StudyRow> rows = fuzz::rows_by_rules(*study, 0, 0.5);
    ASSERT_EQ(wrong_with_rows(rules, rows), "");
    const auto refused = [&](auto change) {
      std::vector<StudyRow> changed = rows;
      change(changed);
      return !wrong_with_rows(rules, changed).empty();
    };
    EXPECT_TRUE(refused([](auto& r) { r.pop_back(); }));
    EXPECT_TRUE(refused([](auto& r) { r.push_back(r.back()); }));
    EXPECT_TRUE(refused([](auto& r) { r.clear(); }));
    EXPECT_TRUE(refused([](auto& r) { r[0].table = "x"; }));
    EXPECT_TRUE(refused([](auto& r) { r[0].fields.pop_back(); }));
    EXPECT_TRUE(refused([](auto& r) { r[0].fields.push_back(r[0].fields[0]); }));
    EXPECT_TRUE(refused([](auto& r) { std::swap(r[0].fields[0], r[0].fields[1]); }));
    for (std::size_t i = 0; i < rows[0].fields.size(); ++i) {
      EXPECT_TRUE(refused([&](auto& r) { r[0].fields[i].first += 'x'; }));
      int taken = 0;
      for (const StudyValue& value : hostile_values()) {
        if (!refused([&](auto& r) { r[0].fields[i].second = value; })) ++taken;
      }
      // 0, 0.5, 1e-320, short texts and nothing are values of some field; no field takes all kinds.
      EXPECT_LE(taken, 4) << rows[0].fields[i].first;
    }
  }
}

// Rows at the ends of what the rules allow: the report is made, and soon.
TEST(RowRules, ReportsStandWhatTheRulesAllow) {
  for (const auto& study : small_studies()) {
    SCOPED_TRACE(study->question().command());
    for (const double share : {0.0, 1.0, 0.3}) {
      std::vector<StudyRow> rows;
      for (std::size_t unit = 0; unit < study->units(); ++unit) {
        const auto more = fuzz::rows_by_rules(*study, unit, share);
        ASSERT_EQ(wrong_with_rows(study->row_rules(unit), more), "");
        rows.insert(rows.end(), more.begin(), more.end());
      }
      const auto report = study->report(rows, study->units());
      EXPECT_TRUE(report) << report.error().text();
    }
  }
}

// A part of each study as somebody may alter it, with hashes that fit: read or refused, never more.
TEST(RowRules, AlteredPartsOfEveryStudy) {
  test::Random random(7);
  const auto pick = [&](std::size_t count) { return static_cast<std::size_t>(random.below(static_cast<int>(count))); };
  int accepted = 0, refused = 0;
  for (const auto& study : small_studies()) {
    const std::size_t units = study->units();
    for (int round = 0; round < 24; ++round) {
      const std::size_t chosen = pick(units);
      std::string text = header_line({study->question(), "build", units, {}});
      for (std::size_t unit = 0; unit < units; ++unit) {
        std::vector<StudyRow> rows = fuzz::rows_by_rules(*study, unit, 0.5);
        if (unit == chosen) {
          StudyRow& row = rows[pick(rows.size())];
          auto& field = row.fields[pick(row.fields.size())];
          field.second = hostile_values()[pick(hostile_values().size())];
        }
        text += unit_line({unit, std::move(rows)});
      }
      text += end_line(units, sha256(text));
      const fuzz::MemoryFile file(text);
      const auto part = read_part(file.path(), [&](const PartHeader&) -> Result<const Study*> { return study.get(); });
      if (!part) {
        ++refused;
        EXPECT_EQ(part.error().line, static_cast<int>(chosen) + 2) << part.error().text();
        EXPECT_NE(part.error().message.find("unit " + std::to_string(chosen)), std::string::npos);
        continue;
      }
      ++accepted;
      if (accepted % 8 == 0) {
        EXPECT_TRUE(study->report(rows_of(*part), units));
      }
    }
  }
  EXPECT_GT(refused, 60);
  EXPECT_GT(accepted, 0);
}

}  // namespace

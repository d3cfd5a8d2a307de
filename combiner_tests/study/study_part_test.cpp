// Units of a study on the disk: a run goes on where it was stopped, parts join to what one run gives, and whatever does
// not belong together is told apart.
#include "ninebit/study/study_part.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

#include "combiner_tests/study/support.h"
#include "combiner_tests/support/temp_folder.h"

namespace {

using namespace ninebit;
using test::all_rows;
namespace fs = std::filesystem;

// Squares: unit u has u % 3 rows, of every kind of value.
class Squares : public Study {
 public:
  explicit Squares(std::size_t units, std::string asked = "1-16") : units_(units) {
    question_ = {.study = "squares", .profile = "all", .options = {{"--steps", std::move(asked)}}, .arguments = ""};
  }
  [[nodiscard]] const StudyQuestion& question() const override { return question_; }
  [[nodiscard]] std::size_t units() const override { return units_; }
  [[nodiscard]] std::string unit_name(std::size_t unit) const override { return std::to_string(unit); }
  [[nodiscard]] Result<std::vector<StudyRow>> run(std::size_t unit, const GoOn& go_on) const override {
    if (go_on && !go_on()) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    ran.push_back(unit);
    std::vector<StudyRow> rows;
    for (std::size_t i = 0; i < unit % 3; ++i) {
      rows.push_back({.table = i == 0 ? "rows" : "others",
                      .fields = {{"unit", std::uint64_t{unit}},
                                 {"square", std::uint64_t{unit} * unit},
                                 {"below", -static_cast<std::int64_t>(unit) - 1},
                                 {"third", static_cast<double>(unit) / 3.0},
                                 {"text", "\"quoted\", </script>\n"},
                                 {"none", std::monostate{}}}});
    }
    return rows;
  }
  [[nodiscard]] std::vector<RowRule> row_rules(std::size_t unit) const override {
    std::vector<RowRule> rules;
    for (std::size_t i = 0; i < unit % 3; ++i) {
      rules.push_back({.table = i == 0 ? "rows" : "others",
                       .fields = {exactly("unit", std::uint64_t{unit}), count_up_to("square", 1e6),
                                  whole_in("below", -1e6, 0.0), real_in("third", 0.0, 1e6),
                                  exactly("text", "\"quoted\", </script>\n"), exactly("none", std::monostate{})}});
    }
    return rules;
  }
  [[nodiscard]] Result<StudyReport> report(std::span<const StudyRow>, std::size_t) const override {
    return StudyReport{};
  }

  mutable std::vector<std::size_t> ran;

 private:
  std::size_t units_;
  StudyQuestion question_;
};

// A folder that is not there yet.
class PartsFolder {
 public:
  [[nodiscard]] fs::path path() const { return made_.path() / "parts"; }
  [[nodiscard]] fs::path part(std::size_t index = 1, std::size_t count = 1) const {
    return path() / part_file_name({index, count});
  }

 private:
  test::TempFolder made_;
};

Result<StudyPart> run(const Squares& study, const PartsFolder& folder, Shard shard = {},
                      const PartLimits& limits = {}) {
  return run_part(study, "build", shard, folder.path(), limits, {});
}

TEST(StudyPart, HoldsWhatTheUnitsGave) {
  const PartsFolder folder;
  const Squares study(11);
  const auto part = run(study, folder);
  ASSERT_TRUE(part) << part.error().text();
  EXPECT_TRUE(part->complete);
  EXPECT_EQ(study.ran.size(), 11U);
  const auto read = read_part(folder.part());
  ASSERT_TRUE(read) << read.error().text();
  EXPECT_TRUE(read->complete);
  EXPECT_EQ(rows_of(*read), all_rows(Squares(11)));
  EXPECT_EQ(rows_of(*part), rows_of(*read));
  // Nothing is done again.
  ASSERT_TRUE(run(study, folder));
  EXPECT_EQ(study.ran.size(), 11U);
}

TEST(StudyPart, StoppedAfterEachUnitItGoesOnToTheSameBytes) {
  const PartsFolder whole, stopped;
  ASSERT_TRUE(run(Squares(7), whole));
  for (std::size_t first = 0; first < 7; ++first) {
    const Squares study(7);
    std::size_t asked = 0;
    const auto part = run(study, stopped, {}, {.seconds = {}, .go_on = [&] { return asked++ == 0; }});
    EXPECT_EQ(study.ran, std::vector<std::size_t>{first});
    if (first == 6) {
      ASSERT_TRUE(part) << part.error().text();
      EXPECT_TRUE(part->complete);
      continue;
    }
    ASSERT_FALSE(part);
    EXPECT_EQ(part.error().fault, Fault::cancelled);
    EXPECT_FALSE(read_part(stopped.part())->complete);
  }
  EXPECT_EQ(test::read_bytes(stopped.part()), test::read_bytes(whole.part()));
}

TEST(StudyPart, EndedAtEveryByteItGoesOnToTheSameBytes) {
  const PartsFolder folder;
  ASSERT_TRUE(run(Squares(5), folder));
  const std::string whole = test::read_bytes(folder.part());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    test::write_bytes(folder.part(), whole.substr(0, size));
    const Squares study(5);
    const auto part = run(study, folder);
    ASSERT_TRUE(part) << size << ": " << part.error().text();
    ASSERT_EQ(test::read_bytes(folder.part()), whole) << size;
    ASSERT_EQ(rows_of(*part), all_rows(Squares(5))) << size;
  }
}

TEST(StudyPart, EveryAlteredByteIsReported) {
  const PartsFolder folder;
  ASSERT_TRUE(run(Squares(4), folder));
  const std::string whole = test::read_bytes(folder.part());
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string altered = whole;
    altered[at] = static_cast<char>(altered[at] ^ 1);
    test::write_bytes(folder.part(), altered);
    const auto part = read_part(folder.part());
    if (part) {
      // The last newline: what stands before it is then not whole, as after an interruption.
      ASSERT_EQ(at, whole.size() - 1);
      ASSERT_FALSE(part->complete);
      continue;
    }
    ASSERT_EQ(part.error().fault, Fault::invalid_input);
    ASSERT_EQ(part.error().file, folder.part().string());
    ASSERT_GT(part.error().line, 0) << at;
  }
}

TEST(StudyPart, NoUnitIsBegunAfterTheTimeIsUp) {
  const PartsFolder folder;
  const Squares study(3);
  const auto part = run(study, folder, {}, {.seconds = 0.0, .go_on = {}});
  ASSERT_TRUE(part);
  EXPECT_FALSE(part->complete);
  EXPECT_TRUE(study.ran.empty());
}

TEST(StudyPart, PartsInAnyOrderJoinToAWholeRun) {
  const PartsFolder folder;
  std::vector<StudyPart> parts;
  for (const std::size_t index : {3U, 1U, 4U, 2U}) parts.push_back(*run(Squares(10), folder, {index, 4}));
  const auto rows = join_parts(parts);
  ASSERT_TRUE(rows) << rows.error().text();
  EXPECT_EQ(*rows, all_rows(Squares(10)));
}

void expect_fault(const Result<std::vector<StudyRow>>& joined, const std::string& words) {
  ASSERT_FALSE(joined);
  EXPECT_NE(joined.error().message.find(words), std::string::npos) << joined.error().text();
}

TEST(StudyPart, MissingDoubledAndForeignPartsAreTold) {
  const PartsFolder folder, other;
  const StudyPart first = *run(Squares(10), folder, {1, 2}), second = *run(Squares(10), folder, {2, 2});
  expect_fault(join_parts(std::vector{first}), "shard 2/2 is missing");
  expect_fault(join_parts(std::vector{first, second, first}), "repeats shard 1/2");
  expect_fault(join_parts({}), "no part");
  expect_fault(join_parts(std::vector{first, *run(Squares(10, "2-3"), other, {2, 2})}), "another question");
  fs::remove_all(other.path());
  expect_fault(join_parts(std::vector{first, *run(Squares(10), other, {2, 3})}), "3 shards");
  StudyPart foreign = second;
  foreign.header.build = "another";
  expect_fault(join_parts(std::vector{first, foreign}), "another build");
  StudyPart unfinished = second;
  unfinished.complete = false;
  unfinished.units.pop_back();
  expect_fault(join_parts(std::vector{first, unfinished}), "not complete: it holds 4 of 5 units");
}

TEST(StudyPart, AFolderOfAnotherQuestionOrBuildIsLeftAsItIs) {
  const PartsFolder folder;
  ASSERT_TRUE(run(Squares(4), folder));
  const std::string before = test::read_bytes(folder.part());
  const auto question = run(Squares(4, "1-3"), folder);
  ASSERT_FALSE(question);
  EXPECT_NE(question.error().message.find("--steps 1-3"), std::string::npos) << question.error().text();
  const auto build = run_part(Squares(4), "newer", {}, folder.path(), {}, {});
  ASSERT_FALSE(build);
  EXPECT_NE(build.error().message.find("another build"), std::string::npos) << build.error().text();
  EXPECT_EQ(test::read_bytes(folder.part()), before);
  test::write_bytes(folder.part(), "a letter");
  ASSERT_FALSE(run(Squares(4), folder));
  EXPECT_EQ(test::read_bytes(folder.part()), "a letter");
}

TEST(StudyPart, WhatCannotBeWrittenIsTold) {
  const PartsFolder folder;
  test::write_bytes(folder.path(), "a file where the folder should be");
  const auto part = run(Squares(4), folder);
  ASSERT_FALSE(part);
  EXPECT_EQ(part.error().fault, Fault::cannot_write);
}

TEST(StudyPart, AFileThatVanishesOrGrowsMeanwhileIsTold) {
  for (const bool vanishes : {true, false}) {
    const PartsFolder folder;
    std::size_t asked = 0;
    const auto meddle = [&](const std::string&, double) {
      if (++asked == 3 && vanishes) fs::remove_all(folder.path());
      if (asked == 3 && !vanishes) std::ofstream(folder.part(), std::ios::app) << "another run's line\n";
      return true;
    };
    const auto part = run_part(Squares(6), "build", {}, folder.path(), {}, meddle);
    ASSERT_FALSE(part);
    EXPECT_EQ(part.error().fault, Fault::cannot_write);
    EXPECT_EQ(part.error().file, folder.part().string());
    EXPECT_NE(part.error().message.find(vanishes ? "was removed" : "was altered"), std::string::npos)
        << part.error().text();
    EXPECT_EQ(asked, 3U);
  }
}

TEST(StudyPart, ShardsOutOfRangeAreTold) {
  const PartsFolder folder;
  for (const Shard shard : {Shard{0, 2}, Shard{3, 2}, Shard{5, 5}}) {
    const auto part = run(Squares(4), folder, shard);
    ASSERT_FALSE(part);
    EXPECT_EQ(part.error().fault, Fault::invalid_input);
  }
}

// A header alone, so that no later line gives it away.
TEST(StudyPart, AFileOfAShardOutOfRangeIsRefused) {
  const PartsFolder folder;
  ASSERT_TRUE(run(Squares(4), folder, {4, 4}));
  const std::string whole = test::read_bytes(folder.part(4, 4));
  const std::string header = whole.substr(0, whole.find('\n') + 1);
  const std::string shard = "\"shard\":[4,4]";
  const std::size_t at = header.find(shard);
  ASSERT_NE(at, std::string::npos) << header;
  for (const auto& [numbers, is_right] : {std::pair("4,4", true), {"4,5", false}, {"0,4", false}, {"4,3", false}}) {
    std::string changed = header;
    changed.replace(at, shard.size(), std::string("\"shard\":[") + numbers + ']');
    test::write_bytes(folder.part(4, 4), changed);
    EXPECT_EQ(read_part(folder.part(4, 4)).ok(), is_right) << numbers;
  }
}

TEST(StudyQuestion, IsTheCommandLineThatAsksIt) {
  const StudyQuestion question{.study = "shadows",
                               .profile = "geforce2",
                               .options = {{"--steps", "1 2"}, {"sha256 of a.gltf", "abc"}, {"--find-offset", ""}},
                               .arguments = "it's.gltf"};
  EXPECT_EQ(question.command(), "ninebit study shadows 'it'\\''s.gltf' --steps '1 2' --find-offset --profile geforce2");
  EXPECT_EQ(question.words(), (std::vector<std::string>{"shadows", "it's.gltf", "--steps", "1 2", "--find-offset",
                                                        "--profile", "geforce2"}));
}

}  // namespace

// The study of index steps: the ladder of docs/numerics.md against its rows, its question, its report, bad options.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <set>
#include <span>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "combiner_tests/study/support.h"
#include "ninebit/shadow/index_cube.h"
#include "ninebit/study/index_steps.h"

namespace {

using namespace ninebit;
using test::all_rows;

HardwareProfile early_to_nearest() {
  HardwareProfile p = profiles::geforce2_early_truncation;
  p.name = "early, to nearest";
  p.general_narrowing.value = Narrowing::nearest_halves_up;
  return p;
}

std::vector<IndexVariant> variants(const std::set<std::string_view>& names) {
  std::vector<IndexVariant> found;
  for (const IndexVariant& v : index_variants()) {
    if (names.count(v.name) > 0) found.push_back(v);
  }
  return found;
}

// The cells of the first table behind a heading, without its ruler, as text without bold, code marks and commas.
std::vector<std::vector<std::string>> table_behind(const std::string& file, const std::string& heading) {
  std::ifstream in(file);
  std::vector<std::vector<std::string>> rows;
  bool behind = false;
  for (std::string line; std::getline(in, line);) {
    behind = behind || line == heading;
    if (!behind || !line.starts_with("|")) {
      if (!rows.empty()) break;
      continue;
    }
    if (line.starts_with("|---")) continue;
    std::istringstream cells(line.substr(1));
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, '|');) {
      std::erase_if(cell, [](char c) { return c == '*' || c == '`' || c == ','; });
      cell.erase(0, cell.find_first_not_of(' '));
      cell.erase(cell.find_last_not_of(' ') + 1);
      rows.back().push_back(cell);
    }
  }
  return rows;
}

TEST(IndexStepsStudy, TheLadderOfTheDocumentsComesOut) {
  const HardwareProfile early = early_to_nearest();
  const auto study =
      index_steps_study({.profiles = {profiles::geforce2, early, profiles::geforce2_early_truncation,
                                      profiles::geforce256_8bit, profiles::ideal, profiles::float_shader},
                         .formats = {StudyFormat::channel},
                         .variants = variants({"both-x4", "no-scale"})});
  ASSERT_TRUE(study.ok()) << study.error().text();
  std::map<std::tuple<std::string, std::string, std::int64_t>, std::uint64_t> lost;
  for (const StudyRow& row : all_rows(**study)) {
    lost[{row.text("profile"), row.text("variant"), static_cast<std::int64_t>(row.count("step"))}] =
        row.count("false_matches");
  }
  // The values of the table's columns, by the names of profile and variant.
  const std::map<std::string, std::vector<std::pair<std::string, std::string>>> columns{
      {"geforce2", {{"geforce2", "both-x4"}}},
      {"early to nearest", {{"early, to nearest", "both-x4"}}},
      {"early truncation", {{"geforce2-early-truncation", "both-x4"}}},
      {"geforce256-8bit", {{"geforce256-8bit", "both-x4"}}},
      {"ideal float-shader", {{"ideal", "both-x4"}, {"float-shader", "both-x4"}}},
      {"geforce2 no scales", {{"geforce2", "no-scale"}}},
      {"ideal float-shader no scales", {{"ideal", "no-scale"}, {"float-shader", "no-scale"}}}};
  const auto table = table_behind(NINEBIT_SOURCE_DIR "/docs/numerics.md", "## The ladder");
  ASSERT_EQ(table.size(), 7U);
  int compared = 0;
  for (std::size_t r = 1; r < table.size(); ++r) {
    ASSERT_EQ(table[r].size(), table[0].size());
    for (std::size_t c = 1; c < table[0].size(); ++c) {
      ASSERT_EQ(columns.count(table[0][c]), 1U) << table[0][c];
      for (const auto& [profile, variant] : columns.at(table[0][c])) {
        EXPECT_EQ(lost.at({profile, variant, std::stoll(table[r][0])}), std::stoull(table[r][c]))
            << profile << ' ' << variant << " step " << table[r][0];
        ++compared;
      }
    }
  }
  EXPECT_EQ(compared, 6 * 9);
}

TEST(IndexStepsStudy, UnitsRowsAndQuestion) {
  const auto made = index_steps_study({.profiles = {profiles::geforce2, profiles::nv2a},
                                       .formats = {StudyFormat::luminance_alpha, StudyFormat::alpha},
                                       .variants = variants({"first-x4", "no-scale-separate"}),
                                       .first_step = 3,
                                       .last_step = 5});
  ASSERT_TRUE(made.ok()) << made.error().text();
  const Study& study = **made;
  const std::vector<std::pair<std::string, std::string>> options{
      {"--steps", "3-5"}, {"--formats", "la,a"}, {"--variants", "first-x4,no-scale-separate"}};
  EXPECT_EQ(study.question().study, "index-steps");
  EXPECT_EQ(study.question().profile, "all");
  EXPECT_EQ(study.question().options, options);
  // A single channel has no separate comparison.
  ASSERT_EQ(study.units(), 6U);
  EXPECT_EQ(study.unit_name(0), "geforce2, la, first-x4");
  EXPECT_EQ(study.unit_name(1), "geforce2, la, no-scale-separate");
  EXPECT_EQ(study.unit_name(5), "nv2a, a, first-x4");
  const std::vector<StudyRow> rows = all_rows(study);
  ASSERT_EQ(rows.size(), 18U);
  std::vector<std::string> keys;
  for (const auto& field : rows[0].fields) keys.push_back(field.first);
  EXPECT_EQ(keys,
            (std::vector<std::string>{"profile", "format", "variant", "step", "codes", "pairs", "false_matches"}));
  EXPECT_EQ(rows[2].count("step"), 5U);
  EXPECT_EQ(rows[2].count("codes"), 52U * 52U);
  EXPECT_EQ(rows[2].count("pairs"), 52U * 52U * (52U * 52U - 1U));
  EXPECT_EQ(study.run(3, {}).value(), study.run(3, {}).value());
  const auto stopped = study.run(0, [] { return false; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().fault, Fault::cancelled);
}

// The report's text, pictures and tables.
TEST(IndexStepsStudy, TheReportAnswersInWordsTablesAndPictures) {
  const auto made = index_steps_study({.profiles = {profiles::geforce2, profiles::geforce2_early_truncation},
                                       .formats = {StudyFormat::channel, StudyFormat::rgb},
                                       .variants = variants({"both-x4", "no-scale"}),
                                       .last_step = 4});
  ASSERT_TRUE(made.ok()) << made.error().text();
  const std::vector<StudyRow> rows = all_rows(**made);
  const auto report = (*made)->report(rows, (*made)->units());
  ASSERT_TRUE(report.ok()) << report.error().text();
  ASSERT_EQ(report->answers.size(), 3U);  // without scales both profiles lose the same
  EXPECT_EQ(report->answers[0],
            "geforce2 with both-x4: step 2 is the smallest safe one (128 codes in channel and 2,097,152 codes in rgb); "
            "at step 1, different pairs compare equal: 0.781 % in channel and 0.000154 % in rgb.");
  EXPECT_TRUE(report->answers[1].starts_with("geforce2, geforce2-early-truncation with no-scale: "))
      << report->answers[1];
  EXPECT_NE(report->answers[1].find("no studied step is safe in channel, rgb"), std::string::npos)
      << report->answers[1];
  ASSERT_EQ(report->tables.size(), 2U);
  for (const ReportTable& table : report->tables) {
    ASSERT_EQ(table.rows.size(), 8U) << table.title;
    for (const auto& row : table.rows) EXPECT_EQ(row.size(), table.columns.size()) << table.title;
  }
  EXPECT_EQ(report->tables[0].rows[0][3], StudyValue(std::int64_t{2}));
  EXPECT_EQ(report->tables[1].rows[0][3], StudyValue(std::uint64_t{510}));

  std::set<std::string> files;
  for (const Plot& plot : report->plots) {
    EXPECT_TRUE(files.insert(plot.file).second) << plot.file;
    EXPECT_EQ(plot.series.size(), 2U) << plot.file;
  }
  EXPECT_EQ(files.count("profiles-rgb"), 1U);
  EXPECT_EQ(files.count("variants-channel"), 1U);
  EXPECT_EQ(files.count("alpha-of-difference-geforce2"), 1U);
  for (const HeatMap& map : report->heat_maps) {
    EXPECT_TRUE(files.insert(map.file).second) << map.file;
    EXPECT_EQ(map.values.size(), static_cast<std::size_t>(map.width * map.height)) << map.file;
  }
  const auto map = std::find_if(report->heat_maps.begin(), report->heat_maps.end(),
                                [](const HeatMap& m) { return m.file == "equal-geforce2-both-x4"; });
  ASSERT_NE(map, report->heat_maps.end());
  const auto at = [&](int difference, int step) {
    return map->values[static_cast<std::size_t>((step - 1) * map->width + difference - static_cast<int>(map->x_first))];
  };
  EXPECT_EQ(at(0, 1), 1.0F);
  EXPECT_EQ(at(1, 1), 1.0F);
  EXPECT_EQ(at(-1, 1), 1.0F);
  EXPECT_EQ(at(2, 1), 0.0F);
  EXPECT_TRUE(std::isnan(at(1, 2)));  // even values have no such pair
  EXPECT_EQ(at(2, 2), 0.0F);
  EXPECT_EQ(map->low, 0.0F);
  const auto pairs = std::find_if(report->heat_maps.begin(), report->heat_maps.end(),
                                  [](const HeatMap& m) { return m.file == "alpha-geforce2-both-x4"; });
  ASSERT_NE(pairs, report->heat_maps.end());
  EXPECT_EQ(pairs->values[0], 0.0F);          // equal
  EXPECT_TRUE(std::isnan(pairs->values[1]));  // 0 and 1 compare equal
  EXPECT_GT(pairs->values[255], 200.0F);

  // The page begins with one sentence and a table of steps.
  EXPECT_EQ(
      report->headlines,
      (std::vector<std::string>{"both-x4: the smallest safe step is 2 on geforce2; 4 on geforce2-early-truncation."}));
  ASSERT_EQ(report->summary.size(), 1U);
  EXPECT_EQ(report->summary[0].columns, (std::vector<std::string>{"variant", "geforce2", "geforce2-early-truncation"}));
  EXPECT_EQ(report->summary[0].rows[0][2], StudyValue(std::int64_t{4}));
  EXPECT_EQ(report->summary[0].rows[1][1], StudyValue(std::string("none")));

  const auto part = (*made)->report(std::span(rows).first(4), 1);
  ASSERT_TRUE(part.ok());
  EXPECT_EQ(part->answers[0], "1 of 8 combinations of profile, format and variant were counted.");
  EXPECT_EQ(part->headlines[0], part->answers[0]);
}

TEST(IndexStepsStudy, PlotsCompareWhatThereIs) {
  const auto plots_of = [](const std::set<std::string_view>& names, int profiles) {
    IndexStepsOptions options{.profiles = {profiles::geforce2},
                              .formats = {StudyFormat::channel, StudyFormat::luminance, StudyFormat::alpha},
                              .variants = variants(names),
                              .last_step = 2};
    if (profiles > 1) options.profiles.push_back(profiles::geforce2_early_truncation);
    const auto made = index_steps_study(options);
    std::vector<std::string> titles;
    const auto report = (*made)->report(all_rows(**made), (*made)->units());
    for (const Plot& plot : report->plots) {
      if (plot.title.starts_with("False matches")) titles.push_back(plot.title);
    }
    return titles;
  };
  using Titles = std::vector<std::string>;
  // The lines of these formats are the same, so they share a plot.
  EXPECT_EQ(plots_of({"both-x4"}, 1), (Titles{"False matches in channel, l, a: both-x4, geforce2"}));
  EXPECT_EQ(plots_of({"both-x4", "no-scale"}, 1),
            (Titles{"False matches in channel, l, a: geforce2, by variant of the program"}));
  EXPECT_EQ(plots_of({"both-x4"}, 2), (Titles{"False matches in channel, l, a: both-x4, by profile"}));
}

TEST(IndexStepsStudy, AProgramOfOnesOwn) {
  const CombinerState state = *index_comparison_state(profiles::geforce2);
  IndexStepsOptions options{.profiles = {profiles::geforce2},
                            .formats = {StudyFormat::rgb, StudyFormat::channel},
                            .last_step = 2,
                            .program = IndexProgram{"mine.gl", {state}}};
  const auto own = index_steps_study(options);
  ASSERT_TRUE(own.ok()) << own.error().text();
  const std::vector<std::pair<std::string, std::string>> asked{
      {"--steps", "1-2"}, {"--formats", "rgb,channel"}, {"--program", "mine.gl"}};
  EXPECT_EQ((*own)->question().options, asked);
  const std::vector<StudyRow> rows = all_rows(**own);
  options.program.reset();
  options.variants = variants({"both-x4"});
  const std::vector<StudyRow> article = all_rows(**index_steps_study(options));
  ASSERT_EQ(rows.size(), article.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_EQ(rows[i].text("variant"), "program");
    EXPECT_EQ(rows[i].count("false_matches"), article[i].count("false_matches"));
  }
}

TEST(IndexStepsStudy, BadOptionsAreReported) {
  const auto message = [](IndexStepsOptions options) {
    const auto made = index_steps_study(std::move(options));
    return made ? std::string() : made.error().text();
  };
  EXPECT_NE(message({.profiles = {}}).find("no profile"), std::string::npos);
  EXPECT_NE(message({.profiles = {profiles::nv2a}, .formats = {}}).find("no format"), std::string::npos);
  EXPECT_NE(message({.profiles = {profiles::nv2a}, .variants = {}}).find("no program"), std::string::npos);
  EXPECT_NE(message({.profiles = {profiles::nv2a}, .first_step = 0}).find("1 to 255"), std::string::npos);
  EXPECT_NE(message({.profiles = {profiles::nv2a}, .last_step = 256}).find("1 to 255"), std::string::npos);
  EXPECT_NE(message({.profiles = {profiles::nv2a}, .first_step = 4, .last_step = 3}).find("1 to 255"),
            std::string::npos);
  EXPECT_NE(
      message(
          {.profiles = {profiles::nv2a}, .formats = {StudyFormat::channel}, .variants = variants({"both-x4-separate"})})
          .find("several channels"),
      std::string::npos);

  CombinerState three = *index_comparison_state(profiles::nv2a);
  three.num_general_combiners = 3;
  const std::string refused = message({.profiles = {profiles::geforce2}, .program = IndexProgram{"three.gl", {three}}});
  EXPECT_TRUE(refused.starts_with("three.gl: profile geforce2 refuses the program: ")) << refused;
  EXPECT_EQ(refused.find('\n'), std::string::npos);

  CombinerState mixed = *index_comparison_state(profiles::geforce2);
  mixed.general[0].rgb.out = {.ab = Register::spare0, .sum = Register::discard, .ab_dot_product = true};
  const auto study = index_steps_study(
      {.profiles = {profiles::geforce2}, .formats = {StudyFormat::rgb}, .program = IndexProgram{"mixed.gl", {mixed}}});
  ASSERT_TRUE(study.ok()) << study.error().text();
  const auto rows = (*study)->run(0, {});
  ASSERT_FALSE(rows.ok());
  EXPECT_EQ(rows.error().file, "mixed.gl");
  EXPECT_NE(rows.error().message.find("more than one channel"), std::string::npos);
}

}  // namespace

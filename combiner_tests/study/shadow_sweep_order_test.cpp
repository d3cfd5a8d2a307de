// The order of indices and the scales of the comparison as axes of a sweep: their columns, rules and words.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>

#include "combiner_tests/support/index_room.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/study/shadow_sweep.h"
#include "src/study/shadows/shadow_sweep_report.h"

namespace {

using namespace ninebit;
using Names = std::vector<std::string>;

Result<std::unique_ptr<Study>> ordered_sweep(const ShadowGrid& grid, const IndexSettings& index = {},
                                             std::string_view name = "index-cube") {
  const Technique& drawn = *find_technique(name);
  RenderSettings settings;
  settings.width = 96;
  settings.height = 72;
  settings.map_size = 64;
  settings.light_facing = true;
  settings.index = index;
  return make_shadow_sweep({.study = "shadows", .profile = "geforce2"}, test::index_room(drawn.lights), drawn, settings,
                           grid);
}

StudyRow single_row(const Study& study, std::size_t unit) {
  const auto rows = study.run(unit, {});
  if (!rows) throw std::runtime_error(rows.error().text());
  EXPECT_EQ(wrong_with_rows(study.row_rules(unit), *rows), "");
  return rows->at(0);
}

Names columns_of(const StudyRow& row) {
  Names names;
  for (const auto& field : row.fields) names.push_back(field.first);
  return names;
}

TEST(ShadowSweepOrder, OrdersAndScalesAreAxes) {
  const ShadowGrid grid{{"index-order", {"file", "neighbour"}}, {"index-scales", {"both-x4", "no-scale"}}};
  const auto study = ordered_sweep(grid);
  ASSERT_TRUE(study) << study.error().text();
  ASSERT_EQ((*study)->units(), 4U);
  EXPECT_EQ((*study)->unit_name(1),
            "map_size 64, index_format rgb, index_scope polygon, index_step 2, index_order file, index_scales "
            "no-scale");
  std::vector<StudyRow> rows;
  for (std::size_t unit = 0; unit < 4; ++unit) {
    rows.push_back(single_row(**study, unit));
    EXPECT_EQ(rows[unit].text("index_order"), unit < 2 ? "file" : "neighbour");
    EXPECT_EQ(rows[unit].text("index_scales"), unit % 2 == 0 ? "both-x4" : "no-scale");
    EXPECT_EQ(columns_of(rows[unit]), columns_of(rows[0]));
  }
  EXPECT_LT(rows[2].count("joint"), rows[0].count("joint"));
  EXPECT_EQ(rows[0].count("truncation"), 0U);
  EXPECT_GT(rows[1].count("truncation"), 0U);
  // The row of another order is not accepted in its place.
  EXPECT_NE(wrong_with_rows((*study)->row_rules(0), std::vector{rows[2]}), "");
}

// Parts and tables of sweeps without these settings keep their columns.
TEST(ShadowSweepOrder, ColumnsOnlyWhereTheyVary) {
  const Names plain = columns_of(single_row(**ordered_sweep({}), 0));
  EXPECT_EQ(plain, (Names{"point", "technique", "map_size", "index_format", "index_scope", "index_step", "lit",
                          "shadowed", "false_lit", "false_shadowed", "wrong", "wrong_share", "truncation", "joint",
                          "vanished", "shared", "sampling", "refused"}));
  const auto more = [&](const ShadowGrid& grid, const IndexSettings& index) {
    Names names;
    for (const std::string& name : columns_of(single_row(**ordered_sweep(grid, index), 0))) {
      if (std::find(plain.begin(), plain.end(), name) == plain.end()) names.push_back(name);
    }
    return names;
  };
  const ShadowGrid orders{{"index-order", {"file"}}}, scales{{"index-scales", {"both-x4"}}};
  IndexSettings neighbour, first;
  neighbour.order = IndexOrder::neighbour;
  first.scales = IndexScales::first;
  EXPECT_EQ(more(orders, {}), (Names{"index_order", "index_order_reason"}));
  EXPECT_EQ(more({}, neighbour), (Names{"index_order", "index_order_reason"}));
  EXPECT_EQ(more(scales, {}), Names{"index_scales"});
  EXPECT_EQ(more({}, first), Names{"index_scales"});
  EXPECT_EQ(more(scales, neighbour), (Names{"index_order", "index_scales", "index_order_reason"}));
}

TEST(ShadowSweepOrder, TechniquesWithoutIndices) {
  const ShadowGrid grid{{"index-order", {"file"}}, {"index-scales", {"no-scale"}}};
  const auto refused = ordered_sweep(grid, {}, "shadow-map");
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "technique shadow-map does not support --orders, --scales");
  IndexSettings neighbour;
  neighbour.order = IndexOrder::neighbour;
  const auto study = ordered_sweep({}, neighbour, "shadow-map");
  ASSERT_TRUE(study) << study.error().text();
  const Names names = columns_of(single_row(**study, 0));
  EXPECT_EQ(std::find(names.begin(), names.end(), "index_order"), names.end());
}

StudyRow ordered_row(std::uint64_t point, const std::string& order, std::uint64_t wrong, const std::string& reason) {
  return {.fields = {{"point", point},
                     {"technique", std::string("index-cube")},
                     {"index_order", order},
                     {"lit", std::uint64_t{9000}},
                     {"shadowed", std::uint64_t{1000}},
                     {"false_lit", std::uint64_t{0}},
                     {"false_shadowed", wrong},
                     {"wrong", wrong},
                     {"wrong_share", static_cast<double>(wrong) / 10000.0},
                     {"truncation", std::uint64_t{0}},
                     {"joint", wrong},
                     {"index_order_reason", reason.empty() ? StudyValue() : StudyValue(reason)},
                     {"refused", StudyValue()}}};
}

TEST(ShadowSweepOrder, TheReportNamesPointsInTheOrderOfTheFile) {
  const Technique& drawn = *find_technique("index-cube");
  const ShadowGrid grid{{"index-order", {"file", "neighbour"}}};
  const SweptSettings known = *swept_settings(drawn, {}, grid);
  const auto axes = axes_of(known, grid);
  ASSERT_TRUE(axes);
  const auto answers = [&](const std::string& reason) {
    const std::vector<StudyRow> rows{ordered_row(0, "file", 300, ""), ordered_row(1, "neighbour", 200, reason)};
    const auto found = shadow_sweep_report(known, *axes, rows, 2, 2).answers;
    std::string text;
    for (const std::string& line : found) text += line + '\n';
    return text;
  };
  EXPECT_NE(answers("").find("Fewest wrong pixels by index_order: file: 300, neighbour: 200.\n"), std::string::npos);
  EXPECT_EQ(answers("").find("instead of neighbour"), std::string::npos);
  EXPECT_NE(answers("too few codes")
                .find("1 of 2 points were drawn with index_order file instead of neighbour; the "
                      "first of them: too few codes.\n"),
            std::string::npos)
      << answers("too few codes");
}

}  // namespace

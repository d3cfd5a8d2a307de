// Sweeps of shadows: each point against a rendering and a judgement of its own, the report against rows made by hand.
#include "ninebit/study/shadow_sweep.h"

#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <set>
#include <stdexcept>

#include "combiner_tests/study/support.h"
#include "combiner_tests/support/index_room.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/ground_truth.h"
#include "src/study/shadows/shadow_sweep_report.h"

namespace {

using namespace ninebit;
using test::all_rows;

const Technique& technique(std::string_view name) {
  const Technique* found = find_technique(name);
  if (found == nullptr) throw std::runtime_error("no such technique");
  return *found;
}

RenderSettings small() {
  RenderSettings settings;
  settings.width = 96;
  settings.height = 72;
  settings.map_size = 64;
  return settings;
}

Result<std::unique_ptr<Study>> sweep_of(std::string_view name, const ShadowGrid& grid) {
  const Technique& drawn = technique(name);
  return make_shadow_sweep({.study = "shadows", .profile = "geforce2"}, test::index_room(drawn.lights), drawn, small(),
                           grid);
}

std::string answers_of(const StudyReport& report) {
  std::string text;
  for (const std::string& line : report.answers) text += line + '\n';
  return text;
}

// Counted pixel by pixel, from what was drawn and what the rays say.
void expect_counts(const StudyRow& row, const Technique& drawn, RenderSettings settings) {
  settings.evidence = true;
  const Scene scene = test::index_room(drawn.lights);
  const auto rendering = drawn.render(scene, settings, {});
  ASSERT_TRUE(rendering);
  const auto rays = GroundTruthScene::make(scene);
  ASSERT_TRUE(rays);
  const auto truth = measure(*rays, settings, *rendering);
  ASSERT_TRUE(truth);
  std::uint64_t lit = 0, shadowed = 0, false_lit = 0, false_shadowed = 0;
  for (std::size_t i = 0; i < truth->truth.size(); ++i) {
    if (truth->truth[i] == PixelTruth::background) continue;
    const bool is_lit = rendering->frame.stencil()[i] == 0;
    ++(is_lit ? lit : shadowed);
    if (is_lit && truth->truth[i] == PixelTruth::shadowed) ++false_lit;
    if (!is_lit && truth->truth[i] == PixelTruth::lit) ++false_shadowed;
  }
  EXPECT_EQ(row.count("lit"), lit);
  EXPECT_EQ(row.count("shadowed"), shadowed);
  EXPECT_EQ(row.count("false_lit"), false_lit);
  EXPECT_EQ(row.count("false_shadowed"), false_shadowed);
  EXPECT_EQ(row.count("wrong"), false_lit + false_shadowed);
  EXPECT_EQ(row.number("wrong_share"),
            static_cast<double>(false_lit + false_shadowed) / static_cast<double>(lit + shadowed));
  std::uint64_t by_cause = 0;
  for (const ErrorCause cause : causes_of(*rendering->evidence)) {
    EXPECT_EQ(row.count(name_of(cause)), truth->by_cause[static_cast<std::size_t>(cause)]) << name_of(cause);
    by_cause += row.count(name_of(cause));
  }
  EXPECT_EQ(by_cause, false_lit + false_shadowed);
  EXPECT_GT(by_cause, 0U);
}

TEST(ShadowSweep, PointsAreDrawnAndJudgedOneByOne) {
  const ShadowGrid grid{
      {"map-size", {"32", "64"}}, {"index-scope", {"polygon", "object"}}, {"index-step", {"1", "2", "3"}}};
  const auto study = sweep_of("index-cube", grid);
  ASSERT_TRUE(study) << study.error().text();
  ASSERT_EQ((*study)->units(), 12U);
  EXPECT_EQ((*study)->unit_name(7), "map_size 64, index_format rgb, index_scope polygon, index_step 2");
  const std::vector<StudyRow> rows = all_rows(**study);
  ASSERT_EQ(rows.size(), 12U);
  for (const std::size_t unit : {0U, 4U, 7U, 11U}) {
    RenderSettings settings = small();
    settings.map_size = unit < 6 ? 32 : 64;
    settings.index.scope = unit / 3 % 2 == 0 ? IndexScope::polygon : IndexScope::object;
    settings.index.step = static_cast<int>(unit % 3) + 1;
    EXPECT_EQ(rows[unit].count("point"), unit);
    EXPECT_EQ(rows[unit].count("map_size"), static_cast<std::uint64_t>(settings.map_size));
    EXPECT_EQ(rows[unit].text("index_scope"), name_of(settings.index.scope));
    EXPECT_EQ(rows[unit].count("index_step"), static_cast<std::uint64_t>(settings.index.step));
    expect_counts(rows[unit], technique("index-cube"), settings);
  }
  // Same fields everywhere, and nothing was refused.
  for (const StudyRow& row : rows) {
    ASSERT_EQ(row.fields.size(), rows[0].fields.size());
    for (std::size_t f = 0; f < row.fields.size(); ++f) EXPECT_EQ(row.fields[f].first, rows[0].fields[f].first);
    EXPECT_EQ(row.text("refused"), "");
  }
}

TEST(ShadowSweep, DepthTechniquesSweepTheirOwnSettings) {
  const ShadowGrid cube{{"depth-bits", {"8", "float"}}, {"bias", {"0", "0.05"}}};
  auto study = sweep_of("depth-cube", cube);
  ASSERT_TRUE(study) << study.error().text();
  std::vector<StudyRow> rows = all_rows(**study);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[3].text("depth_bits"), "float");
  EXPECT_EQ(rows[3].text("bias"), "0.05");
  RenderSettings settings = small();
  settings.depth_cube = {.bits = DepthCubeBits::real, .bias = 0.05F};
  expect_counts(rows[3], technique("depth-cube"), settings);

  const ShadowGrid map{{"depth-encoding", {"d24", "rgba8-fract"}}, {"polygon-offset", {"0,0", "2,64"}}};
  study = sweep_of("shadow-map", map);
  ASSERT_TRUE(study) << study.error().text();
  rows = all_rows(**study);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[2].text("encoding"), "rgba8-fract");
  EXPECT_EQ(rows[3].number("polygon_offset_units"), 64.0);
  settings = small();
  settings.shadow_map = {.polygon_offset = OffsetArguments{2.0F, 64.0F}, .encoding = DepthEncoding::rgba8_fract};
  expect_counts(rows[3], technique("shadow-map"), settings);
}

// A bias and an offset that the technique chose itself are told as it says; a volume has no map.
TEST(ShadowSweep, DefaultsAreTold) {
  auto study = sweep_of("shadow-map", {});
  ASSERT_TRUE(study);
  EXPECT_EQ((*study)->units(), 1U);
  const StudyRow row = all_rows(**study)[0];
  EXPECT_EQ(row.number("polygon_offset_factor"), 1.125);
  EXPECT_EQ(row.number("polygon_offset_units"), 16.0);
  study = sweep_of("shadow-volume", {});
  ASSERT_TRUE(study);
  EXPECT_EQ((*study)->unit_name(0), "shadow-volume");
  EXPECT_TRUE(std::holds_alternative<std::monostate>(all_rows(**study)[0]["map_size"]));
}

TEST(ShadowSweep, AxesOfOtherTechniquesAreRefused) {
  const ShadowGrid grid{{"map-size", {"64"}}, {"index-step", {"1", "2"}}, {"polygon-offset", {"0,0"}}};
  const auto message = [&](std::string_view name) {
    const auto study = sweep_of(name, grid);
    return study ? std::string("no error") : study.error().message;
  };
  EXPECT_EQ(message("index-cube"), "technique index-cube does not support --polygon-offsets");
  EXPECT_EQ(message("shadow-map"), "technique shadow-map does not support --steps");
  EXPECT_EQ(message("depth-cube"), "technique depth-cube does not support --steps, --polygon-offsets");
  EXPECT_EQ(message("shadow-volume"),
            "technique shadow-volume does not support --map-sizes, --steps, --polygon-offsets");
  EXPECT_EQ(message("reflective"), "technique reflective draws no shadows to compare");
}

TEST(ShadowSweep, WrongAxesAreRefused) {
  const auto message = [](const ShadowGrid& grid) {
    const auto study = sweep_of("index-cube", grid);
    return study ? std::string("no error") : study.error().message;
  };
  EXPECT_EQ(message({{"index-stp", {"1"}}}), "'index-stp' is not a setting that can be swept");
  EXPECT_EQ(message({{"section-size", {"64"}}}), "'section-size' is not a setting that can be swept");
  EXPECT_EQ(message({{"index-step", {"1", "17"}}}), "'17' is not a valid value of index-step");
  EXPECT_EQ(message({{"map-size", {"48"}}}), "'48' is not a valid value of map-size");
  EXPECT_EQ(message({{"index-step", {}}}), "index-step: expected at least one value");
  EXPECT_EQ(message({{"index-step", {"1"}}, {"index-step", {"2"}}}),
            "index-step is swept twice; expected one list of its values");
}

TEST(ShadowSweep, KnowsEveryTechniqueWithShadows) {
  for (const Technique& t : techniques()) {
    EXPECT_EQ(swept_settings(t, {}).ok(), t.name != "reflective") << t.name;
  }
  RenderSettings settings;
  settings.light_cookie.shadows = false;
  EXPECT_FALSE(swept_settings(technique("light-cookie"), settings).ok());
}

// 2,096 polygons do not fit into a luminance: a row says so, and the others are drawn.
TEST(ShadowSweep, WhatTheTechniqueRefusesIsARow) {
  auto study = sweep_of("index-cube", {{"index-format", {"l", "rgb"}}});
  ASSERT_TRUE(study);
  const std::vector<StudyRow> rows = all_rows(**study);
  EXPECT_NE(rows[0].text("refused"), "");
  EXPECT_TRUE(std::holds_alternative<std::monostate>(rows[0]["wrong"]));
  EXPECT_EQ(rows[1].text("refused"), "");
  const auto report = (*study)->report(rows, 2);
  ASSERT_TRUE(report);
  EXPECT_NE(answers_of(*report).find("1 of 2 points cannot be drawn; the first of them: " + rows[0].text("refused")),
            std::string::npos);
  ASSERT_EQ(report->pictures.size(), 1U);  // the best point is the worst one, too
  EXPECT_EQ(report->pictures[0].image.width, 96);

  study = sweep_of("index-cube", {{"index-format", {"l"}}});
  const auto none = (*study)->report(all_rows(**study), 1);
  ASSERT_FALSE(none);
  EXPECT_NE(none.error().message.find("no point can be drawn"), std::string::npos);
}

TEST(ShadowSweep, ThreadsChangeNothing) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  const ShadowGrid grid{{"map-size", {"32", "128"}}};
  const auto with_threads = [&](std::size_t n) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, n);
    const auto study = sweep_of("index-cube", grid);
    return all_rows(**study);
  };
  EXPECT_EQ(with_threads(1), with_threads(4));
}

// Each listed pixel gets the text that the caller makes of it, with the point's settings.
TEST(ShadowSweep, DrawAddsTheTextsOfTraces) {
  const Technique& drawn = technique("index-cube");
  bool goes_on = true;
  const auto texts_of = [&goes_on](const RenderSettings& settings, const Progress& progress) {
    std::vector<std::string> texts;
    for (const glm::ivec2& pixel : settings.pixels) {
      texts.push_back(std::to_string(settings.map_size) + ' ' + std::to_string(pixel.x) + ',' +
                      std::to_string(settings.height - 1 - pixel.y));
    }
    goes_on = progress("", 0.5);
    return Result<std::vector<std::string>>(std::move(texts));
  };
  const auto study =
      make_shadow_sweep({.study = "shadows", .profile = "geforce2", .arguments = "room.gltf"},
                        test::index_room(drawn.lights), drawn, small(), {{"map-size", {"32", "128"}}}, texts_of);
  ASSERT_TRUE(study);
  const std::vector<StudyRow> rows = all_rows(**study);
  auto report = (*study)->report(rows, 2);
  ASSERT_TRUE(report);
  ASSERT_EQ(report->pictures.size(), 2U);
  EXPECT_EQ(report->pictures[0].traces.at(0).text, "");
  std::vector<double> shares;
  const auto drawing = [&shares](double done) {
    shares.push_back(done);
    return true;
  };
  ASSERT_TRUE((*study)->draw(rows, drawing, *report).ok());
  EXPECT_EQ(shares, (std::vector<double>{0.0, 0.25, 0.5, 0.75}));
  EXPECT_TRUE(goes_on);
  std::size_t listed = 0;
  for (const ReportPicture& picture : report->pictures) {
    for (const PictureTrace& one : picture.traces) {
      const StudyRow& row = report->rows.at(listed++);
      EXPECT_EQ(one.text, (row.count("point") == 0 ? "32 " : "128 ") + row.text("x") + ',' + row.text("y"));
      EXPECT_EQ(one.command, row.text("command"));
    }
  }
  EXPECT_EQ(listed, report->rows.size());
  const Status stopped = (*study)->draw(
      rows, [](double) { return false; }, *report);
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().fault, Fault::cancelled);
}

TEST(ShadowSweep, StopsWhenAsked) {
  const auto study = sweep_of("index-cube", {});
  const auto rows = (*study)->run(0, [] { return false; });
  ASSERT_FALSE(rows);
  EXPECT_EQ(rows.error().fault, Fault::cancelled);
}

TEST(ShadowSweep, OtherTrianglesAreAnotherQuestion) {
  const Technique& drawn = technique("index-cube");
  Scene scene = test::index_room(drawn.lights);
  const auto question = [&] { return (*make_shadow_sweep({}, scene, drawn, small(), {}))->question(); };
  const StudyQuestion before = question();
  EXPECT_EQ(before, question());
  scene.positions[0].x += 0.001F;
  EXPECT_NE(before, question());
}

TEST(ShadowSweep, SearchStartsWithoutAnOffset) {
  const auto offsets = offsets_to_search();
  EXPECT_EQ(offsets[0].factor, 0.0F);
  EXPECT_EQ(offsets[0].units, 0.0F);
  std::set<std::pair<float, float>> all;
  for (const OffsetArguments& o : offsets) all.emplace(o.factor, o.units);
  EXPECT_EQ(all.size(), offsets.size());
}

// Rows as a shadow map might give them: wrong pixels, of which so many are falsely lit.
StudyRow map_row(std::uint64_t point, std::int64_t map_size, double factor, double units, std::uint64_t false_lit,
                 std::uint64_t false_shadowed) {
  const std::uint64_t wrong = false_lit + false_shadowed;
  return {.fields = {{"point", point},
                     {"technique", std::string("shadow-map")},
                     {"map_size", map_size},
                     {"encoding", std::string("d24")},
                     {"polygon_offset_factor", factor},
                     {"polygon_offset_units", units},
                     {"lit", std::uint64_t{9000}},
                     {"shadowed", std::uint64_t{1000}},
                     {"false_lit", false_lit},
                     {"false_shadowed", false_shadowed},
                     {"wrong", wrong},
                     {"wrong_share", static_cast<double>(wrong) / 10000.0},
                     {"acne", false_shadowed},
                     {"detached", false_lit},
                     {"sampling", std::uint64_t{0}},
                     {"refused", StudyValue()}}};
}

StudyReport report_on(const std::vector<StudyRow>& rows) {
  const SweptSettings known = *swept_settings(technique("shadow-map"), {});
  // Only the columns matter here, not the values.
  const ShadowGrid grid{{"map-size", {"1"}}, {"polygon-offset", {"0,0"}}};
  const auto axes = axes_of(known, grid);
  return shadow_sweep_report(known, *axes, rows, rows.size(), rows.size());
}

TEST(ShadowSweepReport, FindsTheBestOffsetAndItsPrice) {
  const std::vector<StudyRow> rows{map_row(0, 512, 0, 0, 10, 8000), map_row(1, 512, 0, 16, 11, 5000),
                                   map_row(2, 512, 1, 0, 40, 500),  map_row(3, 512, 1, 16, 50, 100),
                                   map_row(4, 512, 4, 0, 300, 20),  map_row(5, 512, 4, 16, 400, 10)};
  const StudyReport report = report_on(rows);
  EXPECT_EQ(best_row(rows), &rows[3]);
  EXPECT_EQ(worst_row(rows), &rows[0]);
  const std::string answers = answers_of(report);
  EXPECT_NE(
      answers.find("Best polygon offset: 1,16, with 150 wrong pixels (1.5 %): 50 falsely lit, 100 falsely shadowed. "
                   "Without one there are 8010 wrong pixels (80.1 %): 10 falsely lit, 8000 falsely shadowed; so the "
                   "offset changes falsely shadowed pixels by -7900, at the cost of +40 falsely lit."),
      std::string::npos)
      << answers;
  EXPECT_NE(answers.find(" Larger units were not tried."), std::string::npos) << answers;
  EXPECT_EQ(answers.find("Larger factors"), std::string::npos) << answers;
  ASSERT_EQ(report.heat_maps.size(), 1U);
  EXPECT_EQ(report.heat_maps[0].width, 2);
  EXPECT_EQ(report.heat_maps[0].height, 3);
  EXPECT_EQ(report.heat_maps[0].values, (std::vector<float>{8010, 5011, 540, 150, 320, 410}));
  EXPECT_EQ(report.heat_maps[0].low, 150.0F);
  EXPECT_EQ(report.heat_maps[0].high, 8010.0F);
  EXPECT_EQ(report.heat_maps[0].x_values, (std::vector<double>{0, 16}));
  EXPECT_EQ(report.heat_maps[0].y_values, (std::vector<double>{0, 1, 4}));
}

TEST(ShadowSweepReport, TellsHowErrorsFallWithTheMap) {
  const std::vector<StudyRow> rows{map_row(0, 128, 1, 1, 0, 800), map_row(1, 256, 1, 1, 0, 500),
                                   map_row(2, 512, 1, 1, 0, 200)};
  const StudyReport report = report_on(rows);
  EXPECT_NE(
      answers_of(report).find("From map_size 128 to 512 the wrong pixels go from 800 to 200, ×0.50 per doubling."),
      std::string::npos)
      << answers_of(report);
  EXPECT_TRUE(report.heat_maps.empty());
  ASSERT_EQ(report.plots.size(), 2U);
  EXPECT_EQ(report.plots[0].file, "wrong-by-map-size");
  ASSERT_EQ(report.plots[0].series.size(), 1U);
  EXPECT_EQ(report.plots[0].series[0].points,
            (std::vector<std::pair<double, double>>{{128, 800}, {256, 500}, {512, 200}}));
  ASSERT_EQ(report.plots[1].series.size(), 1U);
  EXPECT_EQ(report.plots[1].series[0].name, "acne");
  EXPECT_NE(report.plots[1].caption.find("Causes without a pixel: detached, sampling."), std::string::npos);
  EXPECT_TRUE(report.plots[0].log_x);
  EXPECT_FALSE(report.plots[0].log_y);  // 800 to 200
  // The table shows what differs, and keeps the wrong pixels in view.
  ASSERT_EQ(report.tables.size(), 1U);
  EXPECT_EQ(report.tables[0].kept, "wrong");
  const auto& columns = report.tables[0].columns;
  EXPECT_NE(std::find(columns.begin(), columns.end(), "wrong"), columns.end());
  EXPECT_EQ(std::find(columns.begin(), columns.end(), "technique"), columns.end());
  EXPECT_NE(report.tables[0].caption.find("technique shadow-map"), std::string::npos) << report.tables[0].caption;
}

TEST(ShadowSweepReport, SaysWhatIsNotDoneYet) {
  const SweptSettings known = *swept_settings(technique("shadow-map"), {});
  EXPECT_EQ(shadow_sweep_report(known, {}, {}, 0, 7).answers,
            (std::vector<std::string>{"0 of 7 points were drawn so far."}));
}

}  // namespace

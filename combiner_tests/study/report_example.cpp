#include "combiner_tests/study/report_example.h"

#include <cmath>
#include <limits>

namespace report_test {
namespace {

using namespace ninebit;

// As if each doubling of a step lost a tenth of the pairs.
std::uint64_t lost(std::size_t profile, int step) {
  return step > 9 ? 0 : static_cast<std::uint64_t>(40000.0 * std::pow(0.3, step)) * (profile + 1);
}

HeatMap errors_of_products() {
  HeatMap map{.file = "product-errors",
              .title = "Error of a product",
              .x_label = "A",
              .y_label = "B",
              .x_first = -255,
              .x_last = 255,
              .y_first = 255,
              .y_last = -255,
              .width = 511,
              .height = 511,
              .values = {},
              .low = -1.0F,
              .high = 1.0F,
              .caption = "In codes: what comes out less the exact product."};
  for (int b = 255; b >= -255; --b) {
    for (int a = -255; a <= 255; ++a) {
      const double exact = a * b / 255.0;
      map.values.push_back(static_cast<float>(std::trunc(exact) - exact));
    }
  }
  return map;
}

HeatMap counts_by_step() {
  HeatMap map{.file = "by-step",
              .title = "Lost pairs by step and difference",
              .x_label = "step",
              .y_label = "difference",
              .x_first = 1,
              .x_last = 8,
              .y_first = 4,
              .y_last = 1,
              .width = 8,
              .height = 4,
              .values = {},
              .low = 0.0F,
              .high = 31.0F};
  for (int i = 0; i < 32; ++i) map.values.push_back(static_cast<float>(i));
  map.values[5] = std::numeric_limits<float>::quiet_NaN();
  return map;
}

ReportPicture picture() {
  ReportPicture picture{"wrong-pixels", "Wrong pixels", {96, 64, 3, {}}, "Red: lit where it should not be."};
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 96; ++x) {
      const bool wrong = (x - 60) * (x - 60) + (y - 30) * (y - 30) < 100;
      const auto grey = static_cast<std::uint8_t>(2 * x);
      picture.image.pixels.insert(picture.image.pixels.end(), {wrong ? std::uint8_t{220} : grey, grey, grey});
    }
  }
  return picture;
}

}  // namespace

ExampleReport example() {
  ExampleReport made;
  made.question = {
      "index-steps", "all", {{"--steps", "1-16"}, {"sha256 of a</script><b>.gl", "0123abcd"}}, "a</script><b>.gl"};
  const std::vector<std::string> profiles{"geforce2", "geforce2-early-truncation", "geforce256-8bit"};
  Plot lines{.file = "false-matches",
             .title = "False matches by step",
             .x_label = "step",
             .y_label = "false matches",
             .log_y = true,
             .series = {},
             .caption = "Steps without false matches have no point on this axis."};
  ReportTable table{"All rows", {"profile", "step", "false matches", "share"}, {}, "A click on a head sorts by it."};
  for (std::size_t p = 0; p < profiles.size(); ++p) {
    lines.series.push_back({profiles[p], {}});
    for (int step = 1; step <= 40; ++step) {
      const std::uint64_t pairs = 65280U / static_cast<unsigned>(step), matches = lost(p, step);
      const double share = static_cast<double>(matches) / static_cast<double>(pairs);
      made.rows.push_back({"rows",
                           {{"profile", profiles[p]},
                            {"step", std::int64_t{step}},
                            {"false_matches", matches},
                            {"share", share},
                            {"note", step == 1 ? StudyValue("a \"quote\", a comma\nand </script>") : StudyValue{}}}});
      lines.series.back().points.emplace_back(step, matches);
      table.rows.push_back({profiles[p], std::int64_t{step}, matches, share});
    }
  }
  made.rows.push_back({"worst", {{"operation", std::string("product")}, {"error", 1.0 / 3.0}}});
  Plot bars{
      .file = "errors-by-stage",
      .title = "Mean error by stage",
      .x_label = "stage",
      .y_label = "mean error",
      .bars = true,
      .series = {{"rgb", {{1, 0.25}, {2, 0.75}, {3, 1.5}}}, {"<img src=x onerror=alert(1)>", {{1, -0.5}, {3, 1.0}}}}};
  made.report = {.title = "Index steps <example>",
                 .answers = {"geforce2: step 2 is the smallest that loses no pair; it leaves 128 codes a channel.",
                             "geforce256-8bit: step 4; step 3 loses 86 of 7,140 pairs (1.2 %)."},
                 .tables = {table},
                 .plots = {lines, bars},
                 .heat_maps = {errors_of_products(), counts_by_step()},
                 .pictures = {picture()},
                 .rows = {{"worst", {{"operation", std::string("of the report")}, {"error", 0.25}}}}};
  return made;
}

}  // namespace report_test

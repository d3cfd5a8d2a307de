// Plots and heat maps as pictures, and the ticks of axes.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "combiner_tests/study/report_example.h"
#include "src/study/report/plot_axis.h"
#include "src/study/report/plot_picture.h"
#include "src/study/report/report_colors.h"

namespace {

using namespace ninebit;

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> found;
  for (const Tick& tick : axis.ticks) {
    if (!tick.label.empty()) found.push_back(tick.label);
  }
  return found;
}

std::size_t pixels_of(const Image8& image, Rgb color) {
  std::size_t found = 0;
  for (std::size_t i = 0; i + 2 < image.pixels.size(); i += 3) {
    found += Rgb{image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]} == color ? 1U : 0U;
  }
  return found;
}

Rgb pixel(const Image8& image, int x, int y) {
  const auto at = static_cast<std::size_t>((y * image.width + x) * 3);
  return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
}

using Labels = std::vector<std::string>;

TEST(PlotAxis, TicksAreRound) {
  EXPECT_EQ(labels(linear_axis({1, 16}, 8, false)), (Labels{"0", "2", "4", "6", "8", "10", "12", "14", "16"}));
  EXPECT_EQ(labels(linear_axis({0.31, 0.29}, 5, false)), (Labels{"0.290", "0.295", "0.300", "0.305", "0.310"}));
  EXPECT_EQ(labels(linear_axis({-1, 1}, 4, false)), (Labels{"-1.0", "-0.5", "0", "0.5", "1.0"}));
  EXPECT_EQ(labels(linear_axis({0, 2500000}, 5, false)),
            (Labels{"0", "500 000", "1 000 000", "1 500 000", "2 000 000", "2 500 000"}));
  // Thousands stand apart from the fifth digit on, as 1024 is usual; a sign and decimals are no digits of theirs.
  EXPECT_EQ(labels(linear_axis({0, 9000}, 3, false)), (Labels{"0", "5000", "10 000"}));
  EXPECT_EQ(labels(linear_axis({-9000, 0}, 3, false)), (Labels{"-10 000", "-5000", "0"}));
  EXPECT_EQ(labels(linear_axis({-200000, -100000}, 2, false)), (Labels{"-200 000", "-100 000", "0"}));
  EXPECT_EQ(labels(linear_axis({12000, 12001}, 2, false)), (Labels{"12 000.0", "12 000.5", "12 001.0"}));
  EXPECT_EQ(labels(linear_axis({1000, 1001}, 2, false)), (Labels{"1000.0", "1000.5", "1001.0"}));
  EXPECT_EQ(labels(linear_axis({100, 101}, 2, false)).front(), "100.0");
  EXPECT_EQ(labels(linear_axis({100, 101}, 2, true)).front(), "0");
  EXPECT_EQ(labels(linear_axis({0.3}, 3, false)).empty(), false);
  EXPECT_EQ(labels(logarithmic_axis({3, 4000}, 8)), (Labels{"1", "10", "100", "1000", "10⁴"}));
  EXPECT_EQ(labels(logarithmic_axis({1e-6, 1e-4}, 8)),
            (Labels{"10⁻⁶", "0.000002", "0.000005", "10⁻⁵", "0.00002", "0.00005", "10⁻⁴"}));
  EXPECT_EQ(labels(logarithmic_axis({1, 100}, 8)), (Labels{"1", "2", "5", "10", "20", "50", "100"}));
}

TEST(PlotAxis, HoldsWhatItIsMadeFor) {
  std::vector<std::vector<double>> cases{
      {}, {0}, {7}, {-7}, {1, 1 + 1e-15}, {-1e149, 1e149}, {5e-324}, {1e-100, 2e-100}};
  for (int i = 0; i < 200; ++i) cases.push_back({std::sin(i) * std::pow(10.0, i % 17 - 8), std::cos(3 * i)});
  for (const auto& values : cases) {
    for (const bool from_zero : {false, true}) {
      const Axis axis = linear_axis(values, 6, from_zero);
      ASSERT_LT(axis.low, axis.high);
      EXPECT_GE(axis.ticks.size(), 2U);
      EXPECT_LE(axis.ticks.size(), 16U);
      for (const double value : values) {
        EXPECT_GE(axis.place(value), -1e-9) << value;
        EXPECT_LE(axis.place(value), 1.0 + 1e-9) << value;
      }
      EXPECT_TRUE(std::is_sorted(axis.ticks.begin(), axis.ticks.end(),
                                 [](const Tick& a, const Tick& b) { return a.value < b.value; }));
    }
  }
}

TEST(PlotPicture, SameBytesAndEachSeries) {
  const Plot plot = report_test::example().report.plots[0];
  const auto first = picture_of(plot), second = picture_of(plot);
  ASSERT_TRUE(first.ok()) << first.error().text();
  EXPECT_EQ(first->pixels, second->pixels);
  for (std::size_t s = 0; s < plot.series.size(); ++s) EXPECT_GT(pixels_of(*first, kSeriesColors[s]), 500U) << s;
  EXPECT_EQ(pixels_of(*first, kSeriesColors[3]), 0U);
  EXPECT_EQ(pixel(*first, 0, 0), (Rgb{255, 255, 255}));
  EXPECT_GT(pixels_of(*first, {0x22, 0x22, 0x22}), 50U) << "no title";
}

TEST(PlotPicture, BarsStandOnZero) {
  Plot plot{.file = "a", .title = "", .x_label = "", .y_label = "", .bars = true, .series = {{"a", {{1, 2}, {2, -1}}}}};
  const auto both = picture_of(plot);
  plot.series[0].points[1].second = -2;
  const auto lower = picture_of(plot);
  ASSERT_TRUE(both.ok() && lower.ok());
  EXPECT_GT(pixels_of(*lower, kSeriesColors[0]), pixels_of(*both, kSeriesColors[0]) / 10 * 9);
  EXPECT_GT(pixels_of(*both, kSeriesColors[0]), 50000U);
}

TEST(PlotPicture, WhatHasNoPlaceIsLeftOut) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  const Plot sparse{.file = "a",
                    .title = "",
                    .x_label = "",
                    .y_label = "",
                    .log_y = true,
                    .series = {{"a", {{1, 10}, {2, 0}, {3, kNone}, {kInfinite, 4}, {5, -3}, {6, 1e300}, {7, 1000}}}}};
  Plot kept = sparse;
  kept.series[0].points = {{1, 10}, {7, 1000}};
  const auto image = picture_of(sparse);
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image->pixels, picture_of(kept)->pixels);
  kept.series.clear();
  ASSERT_TRUE(picture_of(kept).ok());
  EXPECT_NE(image->pixels, picture_of(kept)->pixels);
}

// Fontconfig reads its configuration once a process, so that this stands in one of its own.
TEST(PlotPictureDeathTest, DrawsWithoutAnyFont) {
  testing::FLAGS_gtest_death_test_style = "threadsafe";
  EXPECT_EXIT(
      {
        ::setenv("FONTCONFIG_FILE", "/dev/null", 1);
        const auto image = picture_of(report_test::example().report.plots[0]);
        std::exit(image.ok() && pixels_of(*image, kSeriesColors[0]) > 500U ? 0 : 1);
      },
      testing::ExitedWithCode(0), "");
}

TEST(HeatMapPicture, ColoursAreThoseOfTheirValues) {
  HeatMap map{.file = "a",
              .title = "a",
              .x_label = "",
              .y_label = "",
              .width = 3,
              .height = 2,
              .values = {-2, 0, 1, 0.5F, 9, std::numeric_limits<float>::quiet_NaN()},
              .low = -2.0F,
              .high = 1.0F};
  const auto image = picture_of(map, 1);
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image->width, 3);
  EXPECT_EQ(pixel(*image, 0, 0), color_ramp(map).front());
  EXPECT_EQ(pixel(*image, 1, 0), (Rgb{255, 255, 255}));
  EXPECT_EQ(pixel(*image, 2, 0), color_ramp(map).back());
  EXPECT_EQ(pixel(*image, 0, 1), color_ramp(map)[255 + 128]);
  EXPECT_EQ(pixel(*image, 1, 1), color_ramp(map).back());
  EXPECT_EQ(pixel(*image, 2, 1), kNoValue);
  // Enlarged by whole factors.
  const auto large = picture_of(map, 32);
  ASSERT_TRUE(large.ok());
  EXPECT_EQ(large->width, 30);
  EXPECT_EQ(large->height, 20);
  EXPECT_EQ(pixel(*large, 9, 9), color_ramp(map).front());
  EXPECT_EQ(pixel(*large, 10, 9), (Rgb{255, 255, 255}));
}

TEST(HeatMapPicture, LightnessFallsFromZero) {
  HeatMap map;
  for (const float low : {0.0F, -1.0F}) {
    map.low = low;
    const ColorRamp& ramp = color_ramp(map);
    const auto light = [&](std::size_t i) { return 0.2126 * ramp[i].r + 0.7152 * ramp[i].g + 0.0722 * ramp[i].b; };
    for (std::size_t i = 255; i + 1 < kRampSize; ++i) EXPECT_LE(light(i + 1), light(i)) << i;
    for (std::size_t i = 255; i > 0; --i) EXPECT_LE(light(i - 1), light(i)) << i;
    EXPECT_LT(light(kRampSize - 1), 60.0);
  }
}

}  // namespace

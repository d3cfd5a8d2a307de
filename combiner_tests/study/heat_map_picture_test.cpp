// Heat maps as pictures.
#include <gtest/gtest.h>

#include <limits>

#include "src/study/report/report_colors.h"

namespace {

using namespace ninebit;

Rgb pixel(const Image8& image, int x, int y) {
  const auto at = static_cast<std::size_t>((y * image.width + x) * 3);
  return {image.pixels[at], image.pixels[at + 1], image.pixels[at + 2]};
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

#include <gtest/gtest.h>
#include <ninebit/raster/color_format.h>
#include <ninebit/raster/surface.h>

TEST(Examples, ColorFormat) {
  using namespace ninebit;
  EXPECT_EQ(facts_of(ColorFormat::r5g6b5).name, "r5g6b5");
  EXPECT_EQ(facts_of(ColorFormat::r5g6b5).word_bits(), 16);
  EXPECT_FALSE(facts_of(ColorFormat::b8).blends());
  Surface surface = Surface::make(4, 4, {.color = ColorFormat::r5g6b5}).value();
  surface.fill({.color = {200, 100, 50, 7}});
  // 25, 25 and 6 of 5, 6 and 5 bits; as bytes their bits repeat. Alpha is not stored.
  const std::array<std::uint8_t, 4> stored = stored_color(ColorFormat::r5g6b5, {200, 100, 50, 7});
  EXPECT_EQ(stored, (std::array<std::uint8_t, 4>{206, 101, 49, 255}));
  EXPECT_EQ(surface.color(kRed)[0], stored[0]);
  EXPECT_EQ(color_word(ColorFormat::r5g6b5, stored), (25U << 11) | (25U << 5) | 6U);
}

#include <gtest/gtest.h>
#include <ninebit/raster/plane_samples.h>

TEST(Examples, PlaneSamples) {
  using namespace ninebit;
  PlaneSamples<std::uint8_t> red = undrawn_samples<std::uint8_t>(1024 * 768);
  EXPECT_EQ(reinterpret_cast<std::uintptr_t>(red.data()) % 64, 0U);  // it begins on a cache line
  red.assign(red.size(), 255);
  const PlaneSamples<std::uint8_t> zeros(16);
  EXPECT_EQ(zeros.back(), 0);
}

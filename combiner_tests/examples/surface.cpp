#include <gtest/gtest.h>
#include <ninebit/raster/surface.h>

TEST(Examples, Surface) {
  using namespace ninebit;
  EXPECT_FALSE(Surface::make(0, 48).ok());
  Result<Surface> surface = Surface::make(64, 48, {.depth_stencil = DepthStencilFormat::d16});
  ASSERT_TRUE(surface.ok());
  surface->fill({.color = {10, 20, 30, 255}, .depth = 0.5});
  EXPECT_EQ(surface->color(kBlue).size(), 64U * 48U);
  EXPECT_EQ(surface->depth()[0], 32768U);  // of 65535
  surface->target().color[kRed].at(3, 0) = 99;
  EXPECT_EQ(surface->color(kRed)[3], 99);
}

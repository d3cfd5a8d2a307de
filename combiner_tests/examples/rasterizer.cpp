#include <gtest/gtest.h>
#include <ninebit/raster/rasterizer.h>

#include <vector>

TEST(Examples, Rasterizer) {
  using namespace ninebit;
  Result<Surface> surface = Surface::make(64, 64);
  ASSERT_TRUE(surface.ok());
  RenderTarget target = surface->target();
  const std::vector<glm::vec3> corners{{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}};
  const std::vector<ColorBytes> colors(3, ColorBytes{255, 128, 0, 255});
  const VertexArrays triangle{.positions = corners, .vertex_colors = colors};
  const Status drawn = rasterize(PipelineState{}, glm::mat4(1.0F), triangle, {}, target);
  ASSERT_TRUE(drawn.ok());
  EXPECT_EQ(surface->color(kGreen).front(), 128);  // the lower left pixel
  EXPECT_EQ(surface->color(kGreen).back(), 0);     // the upper right one
}

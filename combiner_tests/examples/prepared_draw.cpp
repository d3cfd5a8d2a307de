#include <gtest/gtest.h>
#include <ninebit/raster/prepared_draw.h>

#include <array>
#include <vector>

TEST(Examples, PreparedDraw) {
  using namespace ninebit;
  Result<Surface> surface = Surface::make(64, 64);
  RenderTarget target = surface->target();
  const std::vector<glm::vec3> corners{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}};
  const VertexArrays triangle{.positions = corners};
  PipelineState depth_only, color;
  depth_only.depth_test.enabled = color.depth_test.enabled = true;
  depth_only.color_mask = {false, false, false, false};
  color.depth_test.function = CompareFunction::equal;

  PreparedDraw prepared;
  ASSERT_TRUE(prepare(depth_only, glm::mat4(1.0F), triangle, target, prepared).ok());
  const std::array passes{DrawPass{.state = &depth_only, .arrays = triangle},
                          DrawPass{.state = &color, .arrays = triangle}};
  ASSERT_TRUE(rasterize(passes, prepared, {.clear = ClearValues{}}, target).ok());
  EXPECT_EQ(surface->color(kRed)[32], 255);
}

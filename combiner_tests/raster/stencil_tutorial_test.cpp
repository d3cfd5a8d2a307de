// The stencil example of docs/tutorials/stencil.md: compiled, run, and the very text of that page.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "combiner_tests/oracle/raster_oracle.h"
#include "ninebit/raster/rasterizer.h"

namespace ninebit::test {
namespace {

// clang-format off
// [example]
Status draw_through(const VertexArrays& some_polygon, const VertexArrays& scene, RenderTarget& target) {
  PipelineState state;
  if (Status s = clear(state, {}, {.stencil = 0}, target); !s) return s;
  state.stencil_test.enabled = true;

  // Write 1 to stencil where polygon is drawn.
  state.stencil_test.front = {.function = CompareFunction::always, .reference = 1,
                              .fail = StencilOperation::keep, .depth_fail = StencilOperation::keep,
                              .depth_pass = StencilOperation::replace};
  if (Status s = rasterize(state, glm::mat4(1.0F), some_polygon, {}, target); !s) return s;

  // Draw scene only where stencil buffer is 1.
  state.stencil_test.front = {.function = CompareFunction::equal, .reference = 1};
  return rasterize(state, glm::mat4(1.0F), scene, {}, target);
}
// [example]
// clang-format on

TEST(StencilTutorial, ShowsTheCodeThatRuns) {
  const auto content = [](const std::string& file) {
    std::ifstream in(std::string(NINEBIT_SOURCE_DIR) + "/" + file);
    return std::string(std::istreambuf_iterator<char>(in), {});
  };
  const std::string source = content("combiner_tests/raster/stencil_tutorial_test.cpp");
  const std::string mark = "// [example]\n";
  const std::size_t begin = source.find(mark) + mark.size(), end = source.find(mark, begin);
  ASSERT_NE(end, std::string::npos);
  EXPECT_NE(content("docs/tutorials/stencil.md").find("```cpp\n" + source.substr(begin, end - begin) + "```"),
            std::string::npos);
}

TEST(StencilTutorial, DrawsTheSceneOnlyWhereThePolygonWas) {
  const int size = 90;
  // Window positions in sixteenths of a pixel, in the middle of their snapping cells.
  const oracle::WindowTriangle corners{{{216, 288, 0}, {1296, 504, 0}, {792, 1368, 0}}};
  std::vector<glm::vec3> polygon;
  const auto clip = [](std::int64_t q4) { return static_cast<float>((static_cast<double>(q4) + 0.5) / 720.0 - 1.0); };
  for (const oracle::WindowVertex& v : corners) polygon.emplace_back(clip(v.x_q4), clip(v.y_q4), -1);
  const std::vector<glm::vec3> scene{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  const std::vector<ColorBytes> dark{{0, 0, 40, 255}}, bright{{200, 100, 50, 25}};
  Surface surface = Surface::make(size, size).value();
  surface.fill({.stencil = 7});
  RenderTarget target = surface.target();
  const VertexArrays some_polygon{.positions = polygon, .primitive_colors = dark};
  const VertexArrays quad{.type = PrimitiveType::quads, .positions = scene, .primitive_colors = bright};
  const Status status = draw_through(some_polygon, quad, target);
  ASSERT_TRUE(status.ok()) << status.error().message;
  int inside = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const auto at = static_cast<std::size_t>(y * size + x);
      const bool in = oracle::covers(corners, x, y);
      inside += in ? 1 : 0;
      ASSERT_EQ(surface.stencil()[at], in ? 1 : 0) << x << ' ' << y;
      for (int k = 0; k < 4; ++k) ASSERT_EQ(surface.color(k)[at], in ? bright[0][static_cast<std::size_t>(k)] : 0);
    }
  }
  EXPECT_GE(inside, 1000);
}

}  // namespace
}  // namespace ninebit::test

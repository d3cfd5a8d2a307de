// Meshes of more triangles than are set up before they are drawn: what is drawn does not tell.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/raster/support.h"
#include "ninebit/raster/prepared_draw.h"

namespace ninebit::test {
namespace {

struct Window {
  int width, height;
  double leg;  // pixels
};

// Triangles of about that size anywhere, some of them large.
Mesh scattered_triangles(const Window& window) {
  constexpr std::uint32_t kTriangles = 200001;
  Random random(47);
  Mesh mesh;
  for (std::uint32_t i = 0; i < kTriangles; ++i) {
    const double leg = random.one_in(2000) ? 100.0 : window.leg, across = 2 * leg / window.width,
                 up = 2 * leg / window.height;
    const glm::vec3 middle(random.real_f(-1, 1), random.real_f(-1, 1), random.real_f(-1, 1));
    for (int k = 0; k < 3; ++k) {
      mesh.add(middle + glm::vec3(random.real_f(-across, across), random.real_f(-up, up), random.real_f(-0.1, 0.1)));
    }
    mesh.add_triangle(3 * i, 3 * i + 1, 3 * i + 2);
  }
  return mesh;
}

// Of few tiles, which many chunks meet, and of many, with few triangles each.
TEST(LargeMesh, IsDrawnInChunksAsAtOnce) {
  for (const Window& window : {Window{100, 70, 2.0}, Window{2048, 1536, 4.0}}) {
    const Mesh mesh = scattered_triangles(window);
    PipelineState state;
    state.depth_test = {true, CompareFunction::less, true};
    state.stencil_test = {.enabled = true, .front = {.depth_pass = StencilOperation::incr_wrap}};
    std::vector<ColorBytes> colors;
    for (std::uint32_t i = 0; i < mesh.arrays().indices.size() / 3; ++i) {
      colors.push_back(
          {static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8), static_cast<std::uint8_t>(i >> 16), 255});
    }
    VertexArrays arrays = mesh.arrays();
    arrays.primitive_colors = colors;
    const auto draw = [&](auto rasterize_into) {
      Surface surface = Surface::make(window.width, window.height).value();
      RenderTarget target = surface.target();
      EXPECT_TRUE(rasterize_into(target).ok());
      return surface;
    };
    const Surface at_once = draw([&](RenderTarget& target) {
      PreparedDraw prepared;
      if (Status made = prepare(state, kIdentity, arrays, target, prepared); !made) return made;
      return rasterize(state, prepared, arrays, {}, target);
    });
    const auto drawn = std::count_if(at_once.stencil().begin(), at_once.stencil().end(), [](auto s) { return s != 0; });
    EXPECT_GT(drawn, window.width * window.height / 4);
    for (const int threads : {1, 7}) {
      with_threads(threads, [&] {
        const Surface in_chunks =
            draw([&](RenderTarget& target) { return rasterize(state, kIdentity, arrays, {}, target); });
        for (int c = 0; c < 3; ++c) EXPECT_EQ(in_chunks.color(c), at_once.color(c)) << threads;
        EXPECT_EQ(in_chunks.depth(), at_once.depth()) << threads;
        EXPECT_EQ(in_chunks.stencil(), at_once.stencil()) << threads;
      });
    }
  }
}

}  // namespace
}  // namespace ninebit::test

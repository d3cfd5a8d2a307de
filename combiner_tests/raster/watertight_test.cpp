// Meshes without cracks and without pixels drawn twice.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

constexpr double kPi = std::numbers::pi;

// A grid of cells over [x0, x0 + columns * cell] in sixteenths of a pixel, with jittered corners and random diagonals.
Mesh jittered_grid(Random& random, int width, int height, int cell_x, int cell_y, int jitter_x, int jitter_y) {
  Mesh mesh;
  const int columns = (16 * width) / cell_x + 4, rows = (16 * height) / cell_y + 4;
  for (int row = 0; row <= rows; ++row) {
    for (int column = 0; column <= columns; ++column) {
      oracle::WindowVertex v;
      v.x_q4 = (column - 2) * cell_x + random.between(-jitter_x, jitter_x);
      v.y_q4 = (row - 2) * cell_y + random.between(-jitter_y, jitter_y);
      if (random.one_in(4) && cell_x >= 64 && cell_y >= 64) {  // onto a pixel's centre
        v.x_q4 = (v.x_q4 & ~std::int64_t{15}) + 8;
        v.y_q4 = (v.y_q4 & ~std::int64_t{15}) + 8;
      }
      mesh.add(clip_position(v, width, height));
    }
  }
  const auto at = [&](int column, int row) { return static_cast<std::uint32_t>(row * (columns + 1) + column); };
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const std::uint32_t a = at(column, row), b = at(column + 1, row), c = at(column + 1, row + 1),
                          d = at(column, row + 1);
      if (random.one_in(2)) {
        mesh.add_triangle(a, b, c);
        mesh.add_triangle(c, d, a);
      } else {
        mesh.add_triangle(b, d, a);
        mesh.add_triangle(d, b, c);
      }
    }
  }
  return mesh;
}

TEST(Watertight, JitteredGridsDrawEveryPixelOnce) {
  for (std::uint64_t index = 0; index < 60; ++index) {
    Random random(11, index);
    const int width = random.between(1, 200), height = random.between(1, 200);
    const int cell_x = random.pick({16, 33, 80, 128, 400}), cell_y = random.pick({16, 33, 80, 128, 400});
    const Mesh mesh = jittered_grid(random, width, height, cell_x, cell_y, cell_x / 8, cell_y / 8);
    const PlaneSamples<std::uint8_t> count = coverage(mesh, kIdentity, width, height);
    EXPECT_EQ(std::count(count.begin(), count.end(), 1), width * height) << "grid " << index;
  }
}

TEST(Watertight, GridsOfSliversDrawEveryPixelOnce) {
  for (std::uint64_t index = 0; index < 20; ++index) {
    Random random(12, index);
    const bool upright = random.one_in(2);
    const int thin = random.between(1, 3), wide = 700;
    const Mesh mesh = jittered_grid(random, 70, 70, upright ? thin : wide, upright ? wide : thin, 0, upright ? 60 : 0);
    const PlaneSamples<std::uint8_t> count = coverage(mesh, kIdentity, 70, 70);
    EXPECT_EQ(std::count(count.begin(), count.end(), 1), 70 * 70) << "grid " << index;
  }
}

TEST(Watertight, FansAroundAPixelCentreDrawItOnce) {
  for (std::uint64_t index = 0; index < 400; ++index) {
    Random random(13, index);
    const int size = 64, cx = random.between(20, 44), cy = random.between(20, 44);
    // Either all around the target, or within it.
    const bool large = random.one_in(2);
    const double radius = large ? 16 * 200 : random.real(40, 280);
    const int spokes = random.between(3, 40);
    Mesh mesh;
    const std::uint32_t centre = mesh.add(clip_position({16 * cx + 8, 16 * cy + 8, 1000}, size, size));
    const double turn = random.one_in(3) ? 0.0 : random.real(0, kPi);  // 0: spokes along the rows and columns
    for (int i = 0; i < spokes; ++i) {
      const double angle = turn + 2 * kPi * i / spokes;
      const auto along = [&](double unit, int c) { return 16 * c + 8 + std::llround(radius * unit); };
      mesh.add(clip_position({along(std::cos(angle), cx), along(std::sin(angle), cy), 2000}, size, size));
    }
    for (int i = 0; i < spokes; ++i) {
      const auto ring = [&](int k) { return centre + 1 + static_cast<std::uint32_t>(k % spokes); };
      mesh.add_triangle(centre, ring(i), ring(i + 1));
    }
    const PlaneSamples<std::uint8_t> count = coverage(mesh, kIdentity, size, size);
    EXPECT_EQ(count[static_cast<std::size_t>(cy * size + cx)], 1) << "fan " << index;
    EXPECT_LE(*std::max_element(count.begin(), count.end()), 1) << "fan " << index;
    if (large) {
      EXPECT_EQ(std::count(count.begin(), count.end(), 1), size * size) << "fan " << index;
    }
  }
}

Mesh sphere(const glm::vec3& middle, float radius, int slices, int stacks) {
  Mesh mesh;
  const auto point = [&](double polar, double azimuth) {
    return middle + radius * glm::vec3(static_cast<float>(std::sin(polar) * std::cos(azimuth)),
                                       static_cast<float>(std::cos(polar)),
                                       static_cast<float>(std::sin(polar) * std::sin(azimuth)));
  };
  const std::uint32_t top = mesh.add(point(0, 0)), bottom = mesh.add(point(kPi, 0));
  for (int stack = 1; stack < stacks; ++stack) {
    for (int slice = 0; slice < slices; ++slice) mesh.add(point(kPi * stack / stacks, 2 * kPi * slice / slices));
  }
  const auto at = [&](int stack, int slice) {
    return static_cast<std::uint32_t>(2 + (stack - 1) * slices + slice % slices);
  };
  for (int slice = 0; slice < slices; ++slice) {
    mesh.add_triangle(top, at(1, slice + 1), at(1, slice));
    mesh.add_triangle(bottom, at(stacks - 1, slice), at(stacks - 1, slice + 1));
    for (int stack = 1; stack + 1 < stacks; ++stack) {
      mesh.add_triangle(at(stack, slice), at(stack, slice + 1), at(stack + 1, slice));
      mesh.add_triangle(at(stack, slice + 1), at(stack + 1, slice + 1), at(stack + 1, slice));
    }
  }
  return mesh;
}

// The front faces of a convex body cover what its back faces cover, each pixel once.
TEST(Watertight, ConvexBodiesCoverTheirSilhouetteOnceFromEachSide) {
  for (std::uint64_t index = 0; index < 40; ++index) {
    Random random(14, index);
    const int width = random.between(100, 300), height = random.between(100, 300);
    const glm::vec3 middle(random.real_f(-0.7, 0.7), random.real_f(-0.7, 0.7), random.real_f(-4, -2.2));
    const Mesh mesh = sphere(middle, random.real_f(0.5, 1.0), random.between(3, 24), random.between(2, 16));
    const glm::mat4 matrix = perspective(0.5, static_cast<double>(width) / height, 0.5, 20);
    const auto front = coverage(mesh, matrix, width, height, CullFace::back);
    const auto back = coverage(mesh, matrix, width, height, CullFace::front);
    EXPECT_EQ(front, back) << "body " << index;
    EXPECT_LE(*std::max_element(front.begin(), front.end()), 1) << "body " << index;
    EXPECT_GE(std::count(front.begin(), front.end(), 1), 200) << "body " << index;
  }
}

// Also for bodies with needles, in which snapping turns triangles over, and for bodies that the guard band cuts: what
// front faces add at a pixel, back faces take away.
TEST(Watertight, ClosedMeshesHaveAsManyFrontsAsBacksAtEveryPixel) {
  std::int64_t drawn = 0;
  for (std::uint64_t index = 0; index < 40; ++index) {
    Random random(15, index);
    const int size = random.between(10, 120);
    Mesh mesh = sphere({0, 0, -3}, 1.0F, random.between(3, 60), random.between(2, 60));
    for (glm::vec3& p : mesh.positions) {
      const float far = random.one_in(4) ? 900.0F : 0.5F;
      p += glm::vec3(random.real_f(-far, far), random.real_f(-far, far), random.real_f(-0.5, 0.5));
    }
    Surface surface = Surface::make(size, size).value();
    surface.fill({.stencil = 100});
    RenderTarget target = surface.target();
    PipelineState state = counting_state();
    const glm::mat4 matrix = perspective(0.5, 1.0, 0.1, 20);
    state.cull_face = CullFace::back;
    state.stencil_test.front.depth_pass = StencilOperation::incr_wrap;
    ASSERT_TRUE(rasterize(state, matrix, mesh.arrays(), {}, target).ok());
    for (const std::uint8_t s : surface.stencil()) drawn += s != 100 ? 1 : 0;
    state.cull_face = CullFace::front;
    state.stencil_test.front.depth_pass = StencilOperation::decr_wrap;
    ASSERT_TRUE(rasterize(state, matrix, mesh.arrays(), {}, target).ok());
    EXPECT_EQ(std::count(surface.stencil().begin(), surface.stencil().end(), 100), size * size) << "mesh " << index;
  }
  EXPECT_GE(drawn, 20000);
}

}  // namespace
}  // namespace ninebit::test

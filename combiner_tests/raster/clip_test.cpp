// Clipping at the near and far planes and at the guard band: what remains has no cracks and lies where it should.
#include "src/raster/setup/clip.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

// A floor at y = -1 below the camera and behind it, jittered within its plane.
struct Floor {
  Mesh mesh;
  double extent;
  double cell;
};

Floor jittered_floor(Random& random, int cells, double extent) {
  const double cell = 2 * extent / cells;
  Floor floor{{}, extent, cell};
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column) {
      const bool rim = row == 0 || column == 0 || row == cells || column == cells;
      const double jitter = rim ? 0.0 : cell / 6;
      floor.mesh.add({static_cast<float>(-extent + column * cell + random.real(-jitter, jitter)), -1.0F,
                      static_cast<float>(-extent + row * cell + random.real(-jitter, jitter))});
    }
  }
  const auto at = [&](int column, int row) { return static_cast<std::uint32_t>(row * (cells + 1) + column); };
  for (int row = 0; row < cells; ++row) {
    for (int column = 0; column < cells; ++column) {
      floor.mesh.add_triangle(at(column, row), at(column, row + 1), at(column + 1, row + 1));
      floor.mesh.add_triangle(at(column + 1, row + 1), at(column + 1, row), at(column, row));
    }
  }
  return floor;
}

enum class Where { inside, outside, near_a_border };

// Where the ray through a window position meets the floor.
Where floor_at(const Floor& floor, double x, double y, int width, int height, double tangent, double near_plane,
               double far_plane) {
  const double aspect = static_cast<double>(width) / height;
  const double dx = (x / width * 2 - 1) * tangent * aspect, dy = (y / height * 2 - 1) * tangent;
  if (dy >= 0) return dy < 1e-9 ? Where::near_a_border : Where::outside;
  const double distance = -1.0 / dy;  // along -z
  // Close to the horizon, where a cell is hardly higher than a step of the grid that positions are snapped to, snapping
  // folds triangles over.
  const double cell_height = floor.cell * height / (2 * tangent * distance * distance);
  if (cell_height < 1.0) return Where::near_a_border;
  const double sides[] = {distance - near_plane, far_plane - distance, floor.extent - std::fabs(dx * distance),
                          floor.extent - distance};
  return *std::min_element(std::begin(sides), std::end(sides)) >= 0 ? Where::inside : Where::outside;
}

Where floor_around(const Floor& floor, int px, int py, int width, int height, double tangent, double near_plane,
                   double far_plane) {
  // A quarter of a pixel around the centre: more than snapping moves a border.
  const Where centre = floor_at(floor, px + 0.5, py + 0.5, width, height, tangent, near_plane, far_plane);
  for (const double ox : {0.25, 0.75}) {
    for (const double oy : {0.25, 0.75}) {
      if (floor_at(floor, px + ox, py + oy, width, height, tangent, near_plane, far_plane) != centre) {
        return Where::near_a_border;
      }
    }
  }
  return centre;
}

void expect_floor_once(std::uint64_t seed, double near_low, double near_high, std::int64_t least_inside) {
  std::int64_t inside = 0, outside = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    Random random(seed, index);
    const int width = random.between(8, 160), height = random.between(8, 160);
    const Floor floor = jittered_floor(random, random.between(1, 30), random.real(3, 60));
    const double tangent = random.real(0.3, 3.0), near_plane = random.real(near_low, near_high);
    const double far_plane = random.real(2, 50);
    const glm::mat4 matrix = perspective(tangent, static_cast<double>(width) / height, near_plane, far_plane);
    const auto count = coverage(floor.mesh, matrix, width, height);
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const int drawn = count[static_cast<std::size_t>(y * width + x)];
        const Where where = floor_around(floor, x, y, width, height, tangent, near_plane, far_plane);
        if (where == Where::inside) {
          ++inside;
          ASSERT_EQ(drawn, 1) << "floor " << index << " pixel " << x << ' ' << y;
        } else if (where == Where::outside) {
          ++outside;
          ASSERT_EQ(drawn, 0) << "floor " << index << " pixel " << x << ' ' << y;
        }
      }
    }
  }
  EXPECT_GE(inside, least_inside);
  EXPECT_GE(outside, least_inside);
}

TEST(Clip, FloorThroughTheNearPlaneIsDrawnOnce) {
  expect_floor_once(21, 0.05, 2.0, 50000);
}

// The near plane so close that the floor there lies far beyond the guard band.
TEST(Clip, FloorThroughTheGuardBandIsDrawnOnce) {
  expect_floor_once(22, 1e-6, 1e-3, 50000);
}

// An edge of what is left lies on the edge of the triangle across from a corner of which neither end has anything, and
// is on the boundary if that edge is. All others run along clip planes and are on the boundary. Where an edge enters
// the view volume counts as much as where it leaves it.
TEST(Clip, PiecesOfAnEdgeAreOnTheBoundaryAsTheEdgeIs) {
  constexpr GuardBand kGuard{1.5F, 1.5F};
  int entering = 0, inner = 0, made = 0;
  for (std::uint64_t index = 0; index < 4000; ++index) {
    Random random(27, index);
    std::array<glm::vec4, 3> clip;
    for (glm::vec4& p : clip) {
      p = {random.real_f(-3, 3), random.real_f(-3, 3), random.real_f(-2, 2), random.real_f(0.5, 2)};
    }
    const std::array<bool, 3> boundary{random.one_in(2), random.one_in(2), random.one_in(2)};
    const auto crossed = crossed_planes(clip, kGuard);
    if (!crossed || *crossed == 0) continue;
    const ClipPolygon polygon = clip_triangle(clip, boundary, *crossed, kGuard);
    for (int i = 0; i < polygon.count; ++i) {
      const ClipVertex& a = polygon.vertex[static_cast<std::size_t>(i)];
      const ClipVertex& b = polygon.vertex[static_cast<std::size_t>((i + 1) % polygon.count)];
      bool expected = true;
      for (int corner = 0; corner < 3; ++corner) {
        if (a.weight[corner] == 0.0 && b.weight[corner] == 0.0) {
          expected = boundary[static_cast<std::size_t>((corner + 1) % 3)];
          inner += expected ? 0 : 1;
          entering += !expected && a.weight[(corner + 1) % 3] < 1.0 ? 1 : 0;
        }
      }
      made += a.weight[0] * a.weight[1] * a.weight[2] != 0.0 ? 1 : 0;
      ASSERT_EQ(a.boundary, expected) << "case " << index << ", edge " << i;
    }
  }
  EXPECT_GT(entering, 300);
  EXPECT_GT(inner, 600);
  EXPECT_GT(made, 100);
}

TEST(Clip, WhatLiesBeyondAPlaneIsNotDrawn) {
  // Screen-parallel triangles with w = 1 just within and just beyond each plane.
  const float beyond = std::nextafter(1.0F, 2.0F);
  for (const float z : {-1.0F, 1.0F, -beyond, beyond}) {
    const auto count = coverage(level_triangle(z), kIdentity, 16, 16);
    EXPECT_EQ(std::count(count.begin(), count.end(), 1), std::fabs(z) <= 1.0F ? 256 : 0) << z;
  }
}

// A triangle that leaves the depth range: drawn just where its depth plane lies within it, with that depth.
TEST(Clip, DepthOfWhatRemainsIsThatOfTheWholePlane) {
  Mesh mesh;
  mesh.add({-1.5F, -1.5F, -2.0F});
  mesh.add({1.5F, -1.5F, 2.0F});
  mesh.add({-1.5F, 4.5F, -2.0F});
  mesh.add_triangle(0, 1, 2);
  const int size = 128;
  Surface surface = Surface::make(size, size).value();
  surface.fill({.depth = 0x123456 / double{0xFFFFFF}});
  RenderTarget target = surface.target();
  PipelineState state = counting_state();
  state.depth_test = {true, CompareFunction::always, true};
  ASSERT_TRUE(rasterize(state, kIdentity, mesh.arrays(), {}, target).ok());
  int drawn = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double cx = (x + 0.5) / size * 2 - 1, cy = (y + 0.5) / size * 2 - 1;
      const double z = cx / 1.5 * 2;  // the plane through the three corners
      const bool in_triangle = (cx + 1.5) / 3 + (cy + 1.5) / 6 < 1;
      if (std::fabs(std::fabs(z) - 1) < 0.01 || !in_triangle) continue;
      const std::size_t at = static_cast<std::size_t>(y * size + x);
      EXPECT_EQ(surface.stencil()[at], std::fabs(z) < 1 ? 1 : 0) << x << ' ' << y;
      if (std::fabs(z) >= 1) continue;
      ++drawn;
      // Corners of the clipped polygon are snapped, at most 1/16 pixel.
      EXPECT_NEAR(surface.depth()[at], (z * 0.5 + 0.5) * 0xFFFFFF, 2.0 / 1.5 * 0.5 * 0xFFFFFF / size / 4);
    }
  }
  EXPECT_GE(drawn, 6000);
}

}  // namespace
}  // namespace ninebit::test

// Quads, strips, fans and polygons: cut into triangles without cracks, and edges through pixel centres drawn once.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "combiner_tests/raster/support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

constexpr int kWindow = 64;

PlaneSamples<std::uint8_t> counts(PrimitiveType type, const std::vector<glm::vec3>& positions,
                                  const std::vector<std::uint32_t>& indices, const glm::mat4& matrix = kIdentity) {
  return drawn_surface(kWindow, kWindow, counting_state(), {.type = type, .positions = positions, .indices = indices},
                       {}, {}, matrix)
      .stencil();
}

// A grid of cells over more than the target, its corners jittered or moved onto pixel centres.
struct Grid {
  static constexpr int kCells = 10;
  std::vector<glm::vec3> positions;
  [[nodiscard]] std::uint32_t at(int column, int row) const {
    return static_cast<std::uint32_t>(row * (kCells + 1) + column);
  }
};

Grid random_grid(Random& random) {
  Grid grid;
  const int cell = 16 * 7;
  for (int row = 0; row <= Grid::kCells; ++row) {
    for (int column = 0; column <= Grid::kCells; ++column) {
      const auto place = [&](int i) {
        const std::int64_t q4 = i * cell - 32 + random.between(-20, 20);
        return random.one_in(3) ? (q4 & ~std::int64_t{15}) + 8 : q4;
      };
      grid.positions.push_back(clip_position({place(column), place(row), 0}, kWindow, kWindow));
    }
  }
  return grid;
}

TEST(WatertightPolygons, GridsOfEveryTypeDrawEveryPixelOnce) {
  for (std::uint64_t index = 0; index < cases_here(150U); ++index) {
    Random random(101, index);
    const Grid grid = random_grid(random);
    std::vector<std::uint32_t> quads;
    PlaneSamples<std::uint8_t> strips(kWindow * kWindow), quad_strips(kWindow * kWindow), polygons(kWindow * kWindow);
    const auto add = [](PlaneSamples<std::uint8_t>& sum, const PlaneSamples<std::uint8_t>& more) {
      for (std::size_t i = 0; i < sum.size(); ++i) sum[i] = static_cast<std::uint8_t>(sum[i] + more[i]);
    };
    for (int row = 0; row < Grid::kCells; ++row) {
      std::vector<std::uint32_t> zigzag;
      for (int column = 0; column <= Grid::kCells; ++column) {
        zigzag.insert(zigzag.end(), {grid.at(column, row + 1), grid.at(column, row)});
        if (column == Grid::kCells) continue;
        const std::vector<std::uint32_t> ring{grid.at(column, row), grid.at(column + 1, row),
                                              grid.at(column + 1, row + 1), grid.at(column, row + 1)};
        quads.insert(quads.end(), ring.begin(), ring.end());
        const PrimitiveType type = random.one_in(2) ? PrimitiveType::polygon : PrimitiveType::triangle_fan;
        add(polygons, counts(type, grid.positions, ring));
      }
      add(strips, counts(PrimitiveType::triangle_strip, grid.positions, zigzag));
      add(quad_strips, counts(PrimitiveType::quad_strip, grid.positions, zigzag));
    }
    const PlaneSamples<std::uint8_t> once(kWindow * kWindow, 1);
    ASSERT_EQ(counts(PrimitiveType::quads, grid.positions, quads), once) << index;
    ASSERT_EQ(strips, once) << index;
    ASSERT_EQ(quad_strips, once) << index;
    ASSERT_EQ(polygons, once) << index;
  }
}

// Two polygons on both sides of a line through pixel centres, in perspective and through the near plane.
TEST(WatertightPolygons, SharedEdgesStayClosedWhereTheyAreClipped) {
  std::int64_t drawn = 0;
  for (std::uint64_t index = 0; index < 400; ++index) {
    Random random(102, index);
    // A floor of two quads that reaches behind the eye, the line between them turned at random.
    const auto far = [&] { return -random.real_f(6, 30); };
    const float a = random.real_f(-2, 2), b = random.real_f(-2, 2), z = far();
    const std::vector<glm::vec3> positions{{-50, -1, 3}, {a, -1, 3},  {b, -1, z},
                                           {-50, -1, z}, {50, -1, 3}, {50, -1, z}};
    const auto both = counts(PrimitiveType::quads, positions, {0, 1, 2, 3, 1, 4, 5, 2}, perspective(1, 1, 0.1, 100));
    const auto whole = counts(PrimitiveType::quads, positions, {0, 4, 5, 3}, perspective(1, 1, 0.1, 100));
    // Rows that both reach fully: from the bottom to below the far edge.
    const int rows = static_cast<int>(std::floor(kWindow / 2.0 * (1 - 1 / double{-z}))) - 1;
    for (int i = 0; i < rows * kWindow; ++i) {
      ASSERT_EQ(both[static_cast<std::size_t>(i)], 1) << index << " pixel " << i % kWindow << ' ' << i / kWindow;
      ASSERT_EQ(whole[static_cast<std::size_t>(i)], 1) << index << " pixel " << i % kWindow << ' ' << i / kWindow;
      ++drawn;
    }
  }
  EXPECT_GE(drawn, 400 * 20 * kWindow);
}

}  // namespace
}  // namespace ninebit::test

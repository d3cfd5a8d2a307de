// Points, polygon modes, facing and culling, provoking vertices.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

constexpr int kModeWindow = 48;
constexpr std::array<std::uint32_t, 4> kZigzag{0, 1, 3, 2};  // a quad's corners as a quad strip has them

PlaneSamples<std::uint8_t> draw(PipelineState state, const VertexArrays& arrays, const glm::mat4& matrix = kIdentity) {
  state.stencil_test = counting_state().stencil_test;
  return drawn_surface(kModeWindow, kModeWindow, state, arrays, {}, {}, matrix).stencil();
}

std::vector<glm::vec3> clip_positions(const std::vector<oracle::WindowVertex>& vertices) {
  std::vector<glm::vec3> positions;
  for (const oracle::WindowVertex& v : vertices) positions.push_back(clip_position(v, kModeWindow, kModeWindow));
  return positions;
}

std::int64_t total(const PlaneSamples<std::uint8_t>& count) {
  std::int64_t sum = 0;
  for (const std::uint8_t c : count) sum += c;
  return sum;
}

TEST(Point, SquaresOfEverySizeStandWhereTheSpecificationPutsThem) {
  for (int size = 1; size <= 64; ++size) {
    for (const int q4 : {320, 324, 327, 328, 332, 335}) {  // within pixel 20
      PipelineState state;
      state.profile.point_shape.value = PointShape::whole_pixels;
      state.point_size = static_cast<float>(size);
      const auto positions = clip_positions({{q4, q4 + 16, 0}});
      const auto count = draw(state, {.type = PrimitiveType::points, .positions = positions});
      // Odd: around the pixel. Even: around its nearest corner.
      const int left = size % 2 == 1 ? 20 - size / 2 : (q4 < 328 ? 20 : 21) - size / 2;
      for (int y = 0; y < kModeWindow; ++y) {
        for (int x = 0; x < kModeWindow; ++x) {
          const bool in = x >= left && x < left + size && y > left && y <= left + size;
          ASSERT_EQ(count[static_cast<std::size_t>(y * kModeWindow + x)], in ? 1 : 0) << size << ' ' << q4 << ' ' << x;
        }
      }
    }
  }
}

// Rule 31.
TEST(Point, SquaresByHand) {
  struct Extent {
    int first, last;  // columns from pixel 20 on; none if last is before first
  };
  const auto extents = [](int q4, int eighths) {
    PipelineState state;
    state.point_size = static_cast<float>(eighths) / 8.0F;
    const auto positions = clip_positions({{320 + q4, 320 + 16 - q4, 0}});
    const auto count = draw(state, {.type = PrimitiveType::points, .positions = positions});
    Extent columns{99, -99}, rows{99, -99};
    for (int y = 0; y < kModeWindow; ++y) {
      for (int x = 0; x < kModeWindow; ++x) {
        if (count[static_cast<std::size_t>(y * kModeWindow + x)] == 0) continue;
        columns = {std::min(columns.first, x - 20), std::max(columns.last, x - 20)};
        rows = {std::min(rows.first, 20 - y), std::max(rows.last, 20 - y)};  // downwards
      }
    }
    EXPECT_EQ(columns.first, rows.first) << q4 << ' ' << eighths;
    EXPECT_EQ(columns.last, rows.last) << q4 << ' ' << eighths;
    return columns;
  };
  const auto expect = [&](int q4, int eighths, int first, int last) {
    const Extent e = extents(q4, eighths);
    EXPECT_EQ(e.first, first) << q4 << ' ' << eighths;
    EXPECT_EQ(e.last, last) << q4 << ' ' << eighths;
  };
  expect(0, 0, 0, 0);     // without size: the pixel to the right and below
  expect(15, 0, 0, 0);    // that holds the position
  expect(0, 7, 99, -99);  // between four centres
  expect(8, 1, 0, 0);     // on a centre
  expect(0, 8, -1, -1);   // a power of two: open to the right and below
  expect(1, 8, 0, 0);
  expect(0, 24, -2, 1);  // three pixels: closed
  expect(8, 16, -1, 0);  // two, from centre to centre
  expect(8, 17, -1, 1);
  expect(0, 40, -3, 2);
}

TEST(Point, OutsideTheViewVolumeNothingIsDrawn) {
  PipelineState state;
  state.point_size = 9;
  const float beyond = std::nextafter(1.0F, 2.0F);
  for (int axis = 0; axis < 3; ++axis) {
    for (const float place : {-1.0F, 1.0F, -beyond, beyond}) {
      glm::vec3 p(0.0F);
      p[axis] = place;
      const std::array<glm::vec3, 1> positions{p};
      const auto count = draw(state, {.type = PrimitiveType::points, .positions = positions});
      EXPECT_EQ(total(count) > 0, std::fabs(place) <= 1.0F) << axis << ' ' << place;
    }
  }
}

TEST(PolygonMode, LinesAreALoopAndPointsAreTheCorners) {
  std::int64_t drawn = 0;
  for (std::uint64_t index = 0; index < 400; ++index) {
    Random random(81, index);
    const int corners = random.pick({3, 4, 5, 8});
    std::vector<oracle::WindowVertex> ring;
    const double turn = random.real(0, 1);
    for (int i = 0; i < corners; ++i) {
      const double angle = turn + i * 6.2831853 / corners, radius = 16 * 18;
      ring.push_back(
          {std::llround(16 * 24 + radius * std::cos(angle)), std::llround(16 * 24 + radius * std::sin(angle)), 0});
    }
    const auto positions = clip_positions(ring);
    const PrimitiveType type = corners == 3   ? PrimitiveType::triangles
                               : corners == 4 ? PrimitiveType::quads
                                              : PrimitiveType::polygon;
    VertexArrays arrays{.type = type, .positions = positions};
    PipelineState state;
    state.line_width = static_cast<float>(random.between(1, 40)) / 8.0F;
    state.point_size = static_cast<float>(random.between(0, 40)) / 8.0F;
    for (const PolygonMode mode : {PolygonMode::line, PolygonMode::point}) {
      state.front_mode = mode;
      state.back_mode = PolygonMode::fill;
      const auto outline = draw(state, arrays);
      if (corners == 4) {
        const VertexArrays strip{.type = PrimitiveType::quad_strip, .positions = positions, .indices = kZigzag};
        ASSERT_EQ(draw(state, strip), outline) << index;
      }
      arrays.type = mode == PolygonMode::line ? PrimitiveType::line_loop : PrimitiveType::points;
      ASSERT_EQ(outline, draw(state, arrays)) << index;
      arrays.type = type;
      drawn += total(outline);
      // Seen from behind, it is filled.
      state.front_face = FrontFace::clockwise;
      const auto filled = draw(state, arrays);
      state.front_mode = PolygonMode::fill;
      state.front_face = FrontFace::counter_clockwise;
      ASSERT_EQ(filled, draw(state, arrays)) << index;
      ASSERT_LE(*std::max_element(filled.begin(), filled.end()), 1);
      // Each face is culled as the whole.
      state.front_mode = mode;
      state.cull_face = CullFace::front;
      EXPECT_EQ(total(draw(state, arrays)), 0);
      state.cull_face = CullFace::back;
      EXPECT_EQ(draw(state, arrays), outline);
      state.cull_face = CullFace::front_and_back;
      EXPECT_EQ(total(draw(state, arrays)), 0);
      state.cull_face = CullFace::none;
    }
  }
  EXPECT_GE(drawn, 100000);
}

// A triangle that stands through the near plane: what is left has four corners, and an edge along the plane.
TEST(PolygonMode, ClippingAddsEdgesAndCorners) {
  Mesh mesh;
  for (const glm::vec3& p : {glm::vec3(-0.75, -0.5, 0), glm::vec3(0.75, -0.5, 0), glm::vec3(0, 0.5, -2)}) mesh.add(p);
  mesh.add_triangle(0, 1, 2);
  PipelineState state;
  state.profile.point_shape.value = PointShape::whole_pixels;
  state.profile.line_shape.value = LineShape::diamonds;
  state.front_mode = state.back_mode = PolygonMode::point;
  state.point_size = 3;
  EXPECT_EQ(total(draw(state, mesh.arrays())), 4 * 9);
  state.front_mode = state.back_mode = PolygonMode::line;
  const auto outline = draw(state, mesh.arrays());
  // z = -1 is halfway up, at y = 0: row 24, between x = -0.375 and 0.375.
  for (int x = 16; x < 32; ++x) {
    EXPECT_EQ(outline[static_cast<std::size_t>(23 * kModeWindow + x)] +
                  outline[static_cast<std::size_t>(24 * kModeWindow + x)],
              1)
        << x;
  }
  for (int y = 26; y < kModeWindow; ++y) {
    for (int x = 0; x < kModeWindow; ++x)
      EXPECT_EQ(outline[static_cast<std::size_t>(y * kModeWindow + x)], 0) << x << ' ' << y;
  }
}

TEST(PolygonMode, CutsThroughAPolygonAreNotDrawnAsEdges) {
  const auto positions = clip_positions({{64, 64, 0}, {640, 64, 0}, {640, 640, 0}, {64, 640, 0}});
  PipelineState state;
  state.front_mode = PolygonMode::line;
  for (const PrimitiveType type : {PrimitiveType::quads, PrimitiveType::polygon, PrimitiveType::quad_strip}) {
    VertexArrays arrays{.type = type, .positions = positions};
    if (type == PrimitiveType::quad_strip) arrays.indices = kZigzag;
    const auto count = draw(state, arrays);
    for (int i = 6; i < 38; ++i) {
      EXPECT_EQ(count[static_cast<std::size_t>(i * kModeWindow + i)], 0) << i;
      EXPECT_EQ(count[static_cast<std::size_t>(i * kModeWindow + 43 - i)], 0) << i;
    }
    EXPECT_EQ(total(count), 4 * 36);
  }
}

// OpenGL 1.3, table 2.12, by primitive of the list 0, 1, 2, …, which has as many vertices as `colors`.
TEST(ShadeModel, FlatColorsComeFromTheProvokingVertex) {
  struct Row {
    PrimitiveType type;
    std::vector<int> provoking;
  };
  const Row rows[] = {{PrimitiveType::points, {0, 1, 2, 3, 4, 5, 6, 7, 8}},
                      {PrimitiveType::lines, {1, 3, 5, 7}},
                      {PrimitiveType::line_strip, {1, 2, 3, 4, 5, 6, 7, 8}},
                      {PrimitiveType::line_loop, {1, 2, 3, 4, 5, 6, 7, 8, 0}},
                      {PrimitiveType::triangles, {2, 5, 8}},
                      {PrimitiveType::triangle_strip, {2, 3, 4, 5, 6, 7, 8}},
                      {PrimitiveType::triangle_fan, {2, 3, 4, 5, 6, 7, 8}},
                      {PrimitiveType::quads, {3, 7}},
                      {PrimitiveType::quad_strip, {3, 5, 7}},
                      {PrimitiveType::polygon, {0}}};
  std::vector<glm::vec3> positions;  // on a curve, so that nothing is without area
  std::vector<ColorBytes> colors;
  for (int i = 0; i < 9; ++i) {
    positions.emplace_back(-0.9F + 0.2F * static_cast<float>(i),
                           i % 2 == 0 ? -0.8F : 0.7F + 0.02F * static_cast<float>(i), 0);
    colors.push_back({static_cast<std::uint8_t>(10 + i), 0, 0, 255});
  }
  for (const Row& row : rows) {
    PipelineState state;
    state.shade_model = ShadeModel::flat;
    const Surface surface = drawn_surface(kModeWindow, kModeWindow, state,
                                          {.type = row.type, .positions = positions, .vertex_colors = colors}, {},
                                          {.with_primitive = true});
    const PlaneSamples<std::uint32_t>& number = surface.primitive();
    std::vector<bool> seen(row.provoking.size());
    for (std::size_t i = 0; i < number.size(); ++i) {
      if (number[i] == 0xFFFFFFFF) continue;
      ASSERT_LT(number[i], row.provoking.size());
      seen[number[i]] = true;
      ASSERT_EQ(surface.color(kRed)[i], 10 + row.provoking[number[i]]) << static_cast<int>(row.type);
    }
    EXPECT_GE(std::count(seen.begin(), seen.end(), true), static_cast<std::ptrdiff_t>((seen.size() + 1) / 2));
  }
}

}  // namespace
}  // namespace ninebit::test

// Lines: the diamond-exit rule and the NV2A's rectangles on every kind of tie, wide lines, strips and loops, values
// along a line, clipping.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "combiner_tests/raster/texture_support.h"

namespace ninebit::test {
namespace {

using Pixels = std::vector<std::array<int, 2>>;

// How often each pixel is drawn by one call of this type.
PlaneSamples<std::uint8_t> counts(PrimitiveType type, const std::vector<oracle::WindowVertex>& vertices, int size,
                                  float line_width = 1.0F, LineShape shape = LineShape::diamonds) {
  std::vector<glm::vec3> positions;
  for (const oracle::WindowVertex& v : vertices) positions.push_back(clip_position(v, size, size));
  PipelineState state = counting_state();
  state.line_width = line_width;
  state.profile.line_shape.value = shape;
  return drawn_surface(size, size, state, {.type = type, .positions = positions}).stencil();
}

Pixels drawn_pixels(const PlaneSamples<std::uint8_t>& count, int size) {
  Pixels pixels;
  for (std::size_t i = 0; i < count.size(); ++i) {
    for (int n = 0; n < count[i]; ++n) {
      pixels.push_back({static_cast<int>(i) % size, static_cast<int>(i) / size});
    }
  }
  return pixels;
}

Pixels line(int ax, int ay, int bx, int by, float width = 1.0F, LineShape shape = LineShape::diamonds) {
  return drawn_pixels(counts(PrimitiveType::lines, {{ax, ay, 0}, {bx, by, 0}}, 8, width, shape), 8);
}

Pixels rectangle(int ax, int ay, int bx, int by, float width = 1.0F) {
  return line(ax, ay, bx, by, width, LineShape::rectangles);
}

// Positions in sixteenths: the centre of pixel i is at 16 i + 8.
TEST(Line, EndsByHand) {
  EXPECT_EQ(line(24, 40, 72, 40), (Pixels{{1, 2}, {2, 2}, {3, 2}}));  // centre to centre: half open
  EXPECT_EQ(line(72, 40, 24, 40), (Pixels{{2, 2}, {3, 2}, {4, 2}}));
  EXPECT_EQ(line(24, 40, 24, 88), (Pixels{{1, 2}, {1, 3}, {1, 4}}));
  EXPECT_EQ(line(24, 24, 56, 56), (Pixels{{1, 1}, {2, 2}}));
  EXPECT_EQ(line(24, 56, 56, 24), (Pixels{{2, 2}, {1, 3}}));
  EXPECT_EQ(line(24, 40, 24, 40), Pixels{});  // no length
  EXPECT_EQ(line(20, 40, 28, 42), Pixels{});  // never leaves the diamond
  EXPECT_EQ(line(20, 40, 33, 40), (Pixels{{1, 2}}));
  // An end on the right corner of a diamond is moved to the left, into it; on the left corner, out of it.
  EXPECT_EQ(line(20, 40, 32, 40), Pixels{});
  EXPECT_EQ(line(28, 40, 16, 40), (Pixels{{1, 2}}));
  EXPECT_EQ(line(32, 40, 24, 40), Pixels{});
  EXPECT_EQ(line(16, 40, 33, 40), (Pixels{{0, 2}, {1, 2}}));  // starts within the left pixel's diamond
}

TEST(Line, HalfwayBetweenTwoCentres) {
  EXPECT_EQ(line(24, 48, 72, 48), (Pixels{{1, 2}, {2, 2}, {3, 2}}));  // level: below
  EXPECT_EQ(line(48, 24, 48, 72), (Pixels{{2, 1}, {2, 2}, {2, 3}}));  // upright: to the left
  // Through (40, 48), the border between the rows 2 and 3 in the middle of column 2.
  EXPECT_EQ(line(8, 32, 72, 64), (Pixels{{0, 2}, {1, 2}, {2, 3}, {3, 3}}));
  EXPECT_EQ(line(8, 64, 72, 32), (Pixels{{2, 2}, {3, 2}, {0, 3}, {1, 3}}));
}

TEST(Line, WideOnesAreColumnsOrRows) {
  EXPECT_EQ(line(24, 40, 56, 40, 3), (Pixels{{1, 1}, {2, 1}, {1, 2}, {2, 2}, {1, 3}, {2, 3}}));
  // Of an even width there is one more below than above: the lowest line lies half a pixel lower, on a border.
  EXPECT_EQ(line(24, 40, 56, 40, 2), (Pixels{{1, 1}, {2, 1}, {1, 2}, {2, 2}}));
  EXPECT_EQ(line(24, 40, 24, 72, 2), (Pixels{{0, 2}, {1, 2}, {0, 3}, {1, 3}}));
}

// Rule 30. A level or upright line has the centres on its left and its upper side.
TEST(Line, RectanglesByHand) {
  EXPECT_EQ(rectangle(24, 40, 72, 40), (Pixels{{1, 2}, {2, 2}, {3, 2}}));  // from left side to right side
  EXPECT_EQ(rectangle(72, 40, 24, 40), (Pixels{{1, 2}, {2, 2}, {3, 2}}));
  EXPECT_EQ(rectangle(24, 40, 24, 88), (Pixels{{1, 3}, {1, 4}, {1, 5}}));  // from lower side to upper side
  EXPECT_EQ(rectangle(16, 48, 64, 48), (Pixels{{1, 3}, {2, 3}, {3, 3}}));  // centres on both long sides
  EXPECT_EQ(rectangle(32, 16, 32, 64), (Pixels{{1, 1}, {1, 2}, {1, 3}}));
  EXPECT_EQ(rectangle(16, 48, 64, 48, 1.125F), (Pixels{{1, 2}, {2, 2}, {3, 2}, {1, 3}, {2, 3}, {3, 3}}));  // and within
  EXPECT_EQ(rectangle(16, 48, 64, 48, 0.875F), Pixels{});
  EXPECT_EQ(rectangle(16, 40, 64, 40, 0.125F), (Pixels{{1, 2}, {2, 2}, {3, 2}}));
  EXPECT_EQ(rectangle(24, 40, 24, 40, 64), Pixels{});      // no length
  EXPECT_EQ(rectangle(23, 40, 25, 40), (Pixels{{1, 2}}));  // shorter than a pixel, around a centre
  EXPECT_EQ(rectangle(25, 40, 31, 40), Pixels{});          // between two
}

// Centres lie 40 / 1.414 = 28.28 sixteenths beside a diagonal through the borders of pixels. A rectangle that is not
// too wide reaches them with 29 eighths; that of rule 30, which is 1.5 / 1.414 as wide, with 27.
TEST(Line, DiagonalRectanglesAreTooWide) {
  const auto diagonal = [](float width) { return rectangle(16, 8, 112, 104, width); };
  EXPECT_EQ(diagonal(0.625F), Pixels{});  // 5 × 1.5 / 1.414 is less than 8 / 1.414
  EXPECT_EQ(diagonal(0.75F).size(), 12U);
  EXPECT_EQ(diagonal(3.25F).size(), 24U);
  EXPECT_EQ(diagonal(3.375F).size(), 35U);
}

// Of a line that is neither level nor upright, a side to the right has the centres on it, and one to the left has not:
// so all pictures of an NV2A.
TEST(Line, CentresOnSlantedSidesFallToTheRight) {
  // The line is d = (20, 40), and |d| |h| is 4 × 50 = 200: a centre 5 sixteenths to the right or left is on a side.
  const Pixels left_of = rectangle(19 - 10, 24 - 20, 19 + 10, 24 + 20, 0.5F);   // the centre (24, 24) to the right
  const Pixels right_of = rectangle(29 - 10, 24 - 20, 29 + 10, 24 + 20, 0.5F);  // and to the left
  const auto has = [](const Pixels& pixels) {
    return std::count(pixels.begin(), pixels.end(), Pixels::value_type{1, 1});
  };
  EXPECT_EQ(has(left_of), 1);
  EXPECT_EQ(has(right_of), 0);
}

// Every line between points on a grid of so many places a side, `step` sixteenths apart.
void expect_grid(int places, int step, float width, LineShape shape,
                 const std::function<bool(const oracle::WindowLine&, int x, int y)>& is_drawn, std::int64_t& drawn) {
  const int size = 4;
  const auto place = [&](int i) { return oracle::WindowVertex{i % places * step + 8, i / places * step + 8, 0}; };
  for (int start = 0; start < places * places; ++start) {
    std::vector<oracle::WindowVertex> vertices;
    std::vector<int> expected(size * size);
    for (int end = 0; end < places * places; ++end) {
      const oracle::WindowLine line{place(start), place(end)};
      vertices.insert(vertices.end(), line.begin(), line.end());
      for (int i = 0; i < size * size; ++i) {
        expected[static_cast<std::size_t>(i)] += is_drawn(line, i % size, i / size) ? 1 : 0;
      }
    }
    const auto count = counts(PrimitiveType::lines, vertices, size, width, shape);
    for (std::size_t i = 0; i < count.size(); ++i) {
      ASSERT_EQ(count[i], expected[i]) << width << ": from place " << start << " pixel " << i;
      drawn += count[i];
    }
  }
}

// In widths of which many have centres on sides.
TEST(Line, EveryRectangleOnACoarseGridIsTheOracles) {
  std::int64_t drawn = 0;
  for (const int eighths : {1, 3, 4, 8, 11, 16}) {
    const auto covers = [&](const oracle::WindowLine& line, int x, int y) {
      return oracle::rectangle_covers(line, eighths, x, y);
    };
    ASSERT_NO_FATAL_FAILURE(
        expect_grid(9, 6, static_cast<float>(eighths) / 8.0F, LineShape::rectangles, covers, drawn));
  }
  EXPECT_GE(drawn, 40000);
}

// On quarters of a pixel, where all ties lie.
TEST(Line, EveryLineOnACoarseGridExitsTheDiamondsThatTheSpecificationNames) {
  std::int64_t drawn = 0;
  expect_grid(13, 4, 1.0F, LineShape::diamonds, oracle::exits_diamond, drawn);
  EXPECT_GE(drawn, 40000);
}

// A strip draws a joint once, wherever it lies: the segments together draw what the parts draw, and where a line is cut
// at a point on it nothing changes.
TEST(Line, CutLinesDrawTheSamePixelsOnce) {
  int cut = 0;
  for (std::uint64_t index = 0; index < 3000; ++index) {
    Random random(61, index);
    const int size = 24;
    const auto place = [&] { return std::int64_t{random.between(0, 16 * size)}; };
    const oracle::WindowVertex a{place(), place(), 0};
    const std::int64_t dx = random.between(-30, 30), dy = random.between(-30, 30);
    const int parts = random.between(2, 8);
    std::vector<oracle::WindowVertex> strip{a};
    for (int i = 1; i <= parts; ++i) strip.push_back({a.x_q4 + i * dx, a.y_q4 + i * dy, 0});
    const bool inside = std::min({strip.back().x_q4, strip.back().y_q4}) >= 0 &&
                        std::max({strip.back().x_q4, strip.back().y_q4}) < 16 * size;
    if (!inside) continue;
    ++cut;
    for (const LineShape shape : {LineShape::diamonds, LineShape::rectangles}) {
      const float width = shape == LineShape::diamonds ? 1.0F : static_cast<float>(random.between(1, 40)) / 8.0F;
      ASSERT_EQ(counts(PrimitiveType::line_strip, strip, size, width, shape),
                counts(PrimitiveType::lines, {a, strip.back()}, size, width, shape))
          << "line " << index;
    }
  }
  EXPECT_GE(cut, 500);
}

TEST(Line, ALoopDrawsTheCornersOnceAndIsAStripWithOneMoreLine) {
  for (std::uint64_t index = 0; index < 200; ++index) {
    Random random(62, index);
    const int size = 64;
    std::vector<oracle::WindowVertex> corners;  // of an octagon, on centres
    for (int i = 0; i < 8; ++i) {
      const double angle = (i + random.real(-0.2, 0.2)) * 0.785398;
      const auto centre = [](double unit) { return 16 * std::llround(32 + 26 * unit) + 8; };
      corners.push_back({centre(std::cos(angle)), centre(std::sin(angle)), 0});
    }
    const auto loop = counts(PrimitiveType::line_loop, corners, size);
    std::vector<oracle::WindowVertex> closed = corners;
    closed.push_back(corners[0]);
    EXPECT_EQ(loop, counts(PrimitiveType::line_strip, closed, size));
    EXPECT_EQ(*std::max_element(loop.begin(), loop.end()), 1);
    for (const auto& c : corners) EXPECT_EQ(loop[static_cast<std::size_t>((c.y_q4 >> 4) * size + (c.x_q4 >> 4))], 1);
  }
}

// A line seen in perspective, also through the near plane: an attribute that is the place along it in space.
void expect_attribute(bool clipped, std::uint64_t seed) {
  const int size = 128;
  const double tangent = 0.7, near_plane = 0.5;
  std::int64_t checked = 0;
  for (std::uint64_t index = 0; index < 300; ++index) {
    Random random(seed, index);
    const std::array<glm::vec3, 2> positions{
        glm::vec3(random.real_f(-1, 1), random.real_f(-1, 1),
                  clipped ? random.real_f(-0.4, 1.0) : random.real_f(-2, -1)),
        glm::vec3(random.real_f(-3, 3), random.real_f(-3, 3), random.real_f(-9, -3))};
    const std::array<glm::vec4, 2> attribute{glm::vec4(0, 5, 0, 0), glm::vec4(1, 5, 0, 0)};
    std::vector<float> along(size * size, -9.0F), constant(size * size, -9.0F);
    Surface surface = Surface::make(size, size).value();
    RenderTarget target = surface.target();
    target.outputs = {
        {.source = OutputSource::attribute, .attribute = 2, .component = 0, .plane = Plane<float>{along.data(), size}},
        {.source = OutputSource::attribute,
         .attribute = 2,
         .component = 1,
         .plane = Plane<float>{constant.data(), size}}};
    VertexArrays arrays{.type = PrimitiveType::lines, .positions = positions};
    arrays.attributes[2] = attribute;
    ASSERT_TRUE(rasterize({}, perspective(tangent, 1, near_plane, 20), arrays, {}, target).ok());
    const glm::dvec3 a(positions[0]), d = glm::dvec3(positions[1]) - a;
    const auto window = [&](double t) {
      const glm::dvec3 p = a + t * d;
      return glm::dvec2(p.x, p.y) / (-p.z * tangent) * (size / 2.0) + size / 2.0;
    };
    const double least = clipped && a.z > -near_plane ? (-near_plane - a.z) / d.z : 0;
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const float t = along[static_cast<std::size_t>(y * size + x)];
        if (t == -9.0F) continue;
        ++checked;
        ASSERT_NEAR(constant[static_cast<std::size_t>(y * size + x)], 5.0, 1e-4);
        ASSERT_GE(t, least - 0.01);
        ASSERT_LE(t, 1.0001);
        // The place in space is seen within half a pixel's diagonal of the centre and what snapping moves.
        ASSERT_LE(glm::length(window(t) - glm::dvec2(x + 0.5, y + 0.5)), 0.9) << "line " << index << ' ' << t;
      }
    }
  }
  EXPECT_GE(checked, 2000);
}

TEST(Line, AttributesAreInterpolatedInPerspective) {
  expect_attribute(false, 63);
}
TEST(Line, ClippedLinesInterpolateLikeWholeOnes) {
  expect_attribute(true, 64);
}

// OpenGL 1.3, 3.8.8: what counts for a line is how many texels a pixel along it spans, whatever its direction.
TEST(Line, MipmapsFollowTheTexelsPerPixelAlongIt) {
  constexpr int kTexels = 64, kLevels = 7;
  const Texture texture = texture_of_levels(kTexels, {10, 20, 30, 40, 50, 60, 70});
  const std::array<TextureUnit, 1> units{
      TextureUnit{&texture, {.min_filter = MinFilter::nearest_mipmap_nearest, .mag_filter = MagFilter::nearest}}};
  PipelineState state;
  state.profile.line_shape.value = LineShape::diamonds;  // a pixel a column
  state.program = pass_through(Register::texture0, Register::primary);
  constexpr std::array<std::array<int, 2>, 6> kDirections{{{40, 0}, {0, 40}, {-40, 0}, {24, 32}, {-32, 24}, {30, -40}}};
  for (const auto& [dx, dy] : kDirections) {
    const float length = std::hypot(static_cast<float>(dx), static_cast<float>(dy));
    const int left = dx < 0 ? 55 : 8, bottom = dy < 0 ? 55 : 8;
    const auto centre = [](int x, int y) { return oracle::WindowVertex{16 * x + 8, 16 * y + 8, 0}; };
    const std::vector<glm::vec3> positions{clip_position(centre(left, bottom), kTexels, kTexels),
                                           clip_position(centre(left + dx, bottom + dy), kTexels, kTexels)};
    for (int k = 0; k < kLevels; ++k) {
      for (const float factor : {0.75F, 1.35F}) {  // the switch points are at the square roots of 1/2 and 2
        const float end = factor * std::exp2(static_cast<float>(k)) * length / kTexels;
        for (const bool along_t : {false, true}) {
          const std::vector<glm::vec3> coordinates{{0, 0, 0}, along_t ? glm::vec3(0, end, 0) : glm::vec3(end, 0, 0)};
          VertexArrays arrays{.type = PrimitiveType::lines, .positions = positions};
          arrays.texture_coordinates[0] = coordinates;
          const PlaneSamples<std::uint8_t> red = drawn_surface(kTexels, kTexels, state, arrays, units).color(kRed);
          const auto drawn = std::max(std::abs(dx), std::abs(dy));
          EXPECT_EQ(std::count(red.begin(), red.end(), 10 * (k + 1)), drawn)
              << dx << ' ' << dy << ", level " << k << ", " << factor;
          EXPECT_EQ(std::count(red.begin(), red.end(), 0), kTexels * kTexels - drawn);
        }
      }
    }
  }
}

TEST(Line, DepthIsExactAlongTheLine) {
  const int size = 40;
  for (std::uint64_t index = 0; index < 500; ++index) {
    Random random(65, index);
    const auto vertex = [&] {
      return oracle::WindowVertex{random.between(0, 16 * size - 1), random.between(0, 16 * size - 1),
                                  static_cast<std::int64_t>(random.next() & 0xFFFFFF)};
    };
    const oracle::WindowLine l{vertex(), vertex()};
    const std::array<glm::vec3, 2> positions{clip_position(l[0], size, size), clip_position(l[1], size, size)};
    PipelineState state = counting_state();
    state.depth_test = {true, CompareFunction::always, true};
    const bool is_rectangle = random.one_in(2);
    if (!is_rectangle) state.profile.line_shape.value = LineShape::diamonds;
    const int eighths = is_rectangle ? random.between(1, 80) : 8;
    state.line_width = static_cast<float>(eighths) / 8.0F;
    const Surface surface = drawn_surface(size, size, state, {.type = PrimitiveType::lines, .positions = positions});
    for (int y = 0; y < size; ++y) {
      for (int x = 0; x < size; ++x) {
        const auto at = static_cast<std::size_t>(y * size + x);
        const bool is_drawn =
            is_rectangle ? oracle::rectangle_covers(l, eighths, x, y) : oracle::exits_diamond(l, x, y);
        ASSERT_EQ(surface.stencil()[at], is_drawn ? 1 : 0);
        if (surface.stencil()[at] == 0) continue;
        const oracle::Along t = oracle::along_line(l, x, y);
        const std::int64_t sum = (t.squared_length - t.along) * l[0].z24 + t.along * l[1].z24;
        ASSERT_EQ(surface.depth()[at], sum / t.squared_length) << index;
      }
    }
  }
}

}  // namespace
}  // namespace ninebit::test

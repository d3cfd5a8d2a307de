// Homogeneous positions: as the oracle draws them, with vertices at infinity.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/raster/fragment_support.h"
#include "combiner_tests/raster/random_scene.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/raster/prepared_draw.h"

namespace ninebit::test {
namespace {

// Clip x, y = x, y; clip w = z; clip z = z - 2 n w with n = 1/2: a view along z without a far plane.
glm::mat4 infinite_view() {
  glm::mat4 m(0.0F);
  m[0][0] = m[1][1] = m[2][2] = m[2][3] = 1.0F;
  m[3][2] = -1.0F;
  return m;
}

// Gives every vertex a distance that is a power of two, or infinity, and the window depth that goes with it.
std::vector<glm::vec4> at_random_distances(Random& random, const RandomScene& scene, RandomDraw& draw, int& infinite) {
  const PixelRect viewport = draw.state.viewport.value_or(PixelRect{0, 0, scene.width, scene.height});
  const DepthStencilFormat format = scene.start.format;
  const std::int64_t deepest = std::int64_t{max_depth(format)} << (24 - depth_bits(format));
  std::vector<glm::vec4> positions;
  for (oracle::WindowVertex& v : draw.vertices) {
    const glm::vec3 ndc = clip_position(v, viewport, draw.state.profile.subpixel_bits);
    const bool is_infinite = random.one_in(2);
    const int power = is_infinite ? random.between(-20, 20) : random.between(-1, 18);
    const auto distance = static_cast<float>(std::ldexp(1.0, power));
    positions.emplace_back(ndc.x * distance, ndc.y * distance, distance, is_infinite ? 0.0F : 1.0F);
    // 1 - n / distance = 1 - 2^-(power + 1), rounded to nearest, halves up.
    const std::int64_t parts = std::int64_t{2} << (power + 1 > 0 ? power + 1 : 0);
    v.z24 = is_infinite ? deepest : (2 * deepest * (parts / 2 - 1) + parts / 2) / parts;
    infinite += is_infinite ? 1 : 0;
  }
  return positions;
}

// Every plane to the bit: on every SIMD target, directly and prepared.
TEST(Homogeneous, RandomScenesAreDrawnAsTheOracleDoes) {
  int infinite = 0, changed = 0;
  PreparedDraw prepared;
  constexpr std::uint64_t kScenes = kSlowBuild ? 100 : 2500;
  for (std::uint64_t index = 0; index < kScenes; ++index) {
    Random random(0x40406E, index);
    RandomScene scene = random_scene(random, false);
    oracle::Picture expected = scene.start;
    std::vector<std::vector<glm::vec4>> positions;
    for (RandomDraw& draw : scene.draws) {
      if (!draw.exact_color) draw.state.shade_model = ShadeModel::flat;
      draw.state.depth_near = 0.0F;
      draw.state.depth_far = 1.0F;
      positions.push_back(at_random_distances(random, scene, draw, infinite));
      oracle::Tally tally;
      oracle::draw(draw.state, for_oracle(draw), expected, tally);
    }
    expected.captured = scene.start.captured;
    changed += same_samples(expected, scene.start) ? 0 : 1;
    for (const std::int64_t simd : simd_targets()) {
      const OnTarget on(simd);
      PicturePlanes planes(scene.start, false), again(scene.start, false);
      for (std::size_t i = 0; i < scene.draws.size(); ++i) {
        const RandomDraw& draw = scene.draws[i];
        const LibraryDraw library = for_library(draw, scene.width, scene.height);
        VertexArrays arrays = library.arrays;
        arrays.positions = {};
        arrays.homogeneous_positions = positions[i];
        Status status = rasterize(draw.state, infinite_view(), arrays, {}, planes.target);
        ASSERT_TRUE(status.ok()) << status.error().message;
        status = prepare(draw.state, infinite_view(), arrays, again.target, prepared);
        if (status) status = rasterize(draw.state, prepared, arrays, {}, again.target);
        ASSERT_TRUE(status.ok()) << status.error().message;
      }
      ASSERT_TRUE(same_samples(planes.picture(), expected)) << "scene " << index << '\n' << describe(scene);
      ASSERT_TRUE(same_samples(again.picture(), expected)) << "scene " << index << ", prepared\n" << describe(scene);
    }
  }
  EXPECT_GT(changed, static_cast<int>(kScenes * 2 / 5));
  EXPECT_GT(infinite, static_cast<int>(kScenes));
}

// The whole plane y = -1, four triangles of one point below the eye and two directions each: all that is below the
// horizon, once, wherever the directions point.
TEST(Homogeneous, APlaneReachesTheHorizon) {
  std::int64_t below = 0, above = 0;
  for (std::uint64_t index = 0; index < 200; ++index) {
    Random random(0x40406F, index);
    const int width = random.between(20, 120), height = random.between(20, 120);
    const double turn = random.real(0, 6.28), tangent = random.real(0.3, 2), near_plane = random.real(0.001, 0.5);
    glm::mat4 matrix = perspective(tangent, static_cast<double>(width) / height, near_plane, 10);
    matrix[2][2] = -1.0F;  // no far plane
    matrix[3][2] = static_cast<float>(-2 * near_plane);
    std::vector<glm::vec4> positions{{random.real(-3, 3), -1, random.real(-3, 3), 1}};
    for (int i = 0; i < 4; ++i) {
      const double a = turn + i * 1.5707963;
      positions.emplace_back(std::cos(a), 0, std::sin(a), 0);
    }
    const PlaneSamples<std::uint32_t> indices{0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1};
    PipelineState state = counting_state();
    state.depth_test = {true, CompareFunction::always, true};
    const Surface surface =
        drawn_surface(width, height, state, {.homogeneous_positions = positions, .indices = indices}, {}, {}, matrix);
    for (int y = 0; y < height; ++y) {
      const double slope = ((y + 0.5) / height * 2 - 1) * tangent;
      if (std::fabs(y + 0.5 - height * 0.5) < 0.75) continue;
      for (int x = 0; x < width; ++x) {
        const std::size_t at = static_cast<std::size_t>(y * width + x);
        const bool is_below = slope < 0 && -1 / slope > near_plane;
        ASSERT_EQ(surface.stencil()[at], is_below ? 1 : 0) << index << ": " << x << ' ' << y;
        ++(is_below ? below : above);
        // Window depth is 1 - near / distance, and changes by this much within a sixteenth of a pixel.
        const double change = near_plane * tangent * 2 / height / 16;
        if (is_below) {
          ASSERT_NEAR(surface.depth()[at], (1 + near_plane * slope) * 0xFFFFFF, 3 + 4 * change * 0xFFFFFF) << index;
        }
      }
    }
  }
  EXPECT_GT(below, 100000);
  EXPECT_GT(above, 100000);
}

// Vertices at infinity have the depth to which the plane is cleared, to the bit, whatever the view.
TEST(Homogeneous, InfinityHasTheDepthOne) {
  int drawn = 0;
  for (std::uint64_t index = 0; index < 300; ++index) {
    Random random(0x404070, index);
    const auto real = [&](double low, double high) { return random.real_f(low, high); };
    glm::mat4 matrix(0.0F);
    for (int column = 0; column < 4; ++column) {
      for (int row = 0; row < 4; ++row) matrix[column][row] = real(-3, 3);
      matrix[column][2] = matrix[column][3];
    }
    matrix[3][2] -= real(0.01, 1);
    std::vector<glm::vec4> positions;
    for (int i = 0; i < 60; ++i) positions.emplace_back(real(-9, 9), real(-9, 9), real(-9, 9), 0.0F);
    Surface surface = Surface::make(32, 32).value();
    RenderTarget target = surface.target();
    PipelineState state;
    state.color_mask = {false, false, false, false};
    state.depth_test = {.enabled = true, .function = CompareFunction::less, .write = true};
    state.stencil_test = {.enabled = true,
                          .front = {.depth_fail = StencilOperation::incr, .depth_pass = StencilOperation::replace}};
    VertexArrays arrays;
    arrays.homogeneous_positions = positions;
    surface.fill({.stencil = 1});
    ASSERT_TRUE(rasterize(state, matrix, arrays, {}, target).ok());
    for (std::size_t i = 0; i < surface.stencil().size(); ++i) {
      ASSERT_GE(surface.stencil()[i], 1) << "a fragment passed LESS";
      ASSERT_EQ(surface.depth()[i], 0xFFFFFFU);
      drawn += surface.stencil()[i] > 1 ? 1 : 0;
    }
  }
  EXPECT_GT(drawn, 50000);
}

TEST(Homogeneous, BadPositions) {
  Surface surface = Surface::make(8, 8).value();
  RenderTarget target = surface.target();
  const std::vector<glm::vec3> points{{-3, -3, 0}, {5, -3, 0}, {-3, 5, 0}};
  std::vector<glm::vec4> homogeneous{{-3, -3, 0, 1}, {5, -3, 0, 1}, {-3, 5, 0, 1}};
  VertexArrays both;
  both.positions = points;
  both.homogeneous_positions = homogeneous;
  const Status refused = rasterize({}, kIdentity, both, {}, target);
  ASSERT_FALSE(refused.ok());
  EXPECT_NE(refused.error().message.find("with and without w"), std::string::npos);
  PreparedDraw prepared;
  EXPECT_FALSE(prepare({}, kIdentity, both, target, prepared).ok());

  VertexArrays arrays;
  arrays.homogeneous_positions = homogeneous;
  const std::vector<ColorBytes> two_colors(2);
  arrays.vertex_colors = two_colors;
  EXPECT_FALSE(rasterize({}, kIdentity, arrays, {}, target).ok());
  arrays.vertex_colors = {};
  const PlaneSamples<std::uint32_t> beyond{0, 1, 3};
  arrays.indices = beyond;
  EXPECT_FALSE(rasterize({}, kIdentity, arrays, {}, target).ok());
  arrays.indices = {};
  for (int component = 0; component < 4; ++component) {
    for (const float bad : {std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()}) {
      std::vector<glm::vec4> odd = homogeneous;
      odd[1][component] = bad;
      arrays.homogeneous_positions = odd;
      ASSERT_TRUE(rasterize(counting_state(), kIdentity, arrays, {}, target).ok());
    }
  }
  for (const glm::vec4 nowhere : {glm::vec4(0.0F), glm::vec4(1, 1, 1, 0), glm::vec4(1, 1, 1, -1)}) {
    const std::vector<glm::vec4> one_place(3, nowhere);
    arrays.homogeneous_positions = one_place;
    ASSERT_TRUE(rasterize(counting_state(), kIdentity, arrays, {}, target).ok());
  }
  EXPECT_EQ(std::count(surface.stencil().begin(), surface.stencil().end(), 0), 64);
}

}  // namespace
}  // namespace ninebit::test

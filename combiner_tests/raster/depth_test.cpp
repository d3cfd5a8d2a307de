// Depth: the exact plane, the same in every pass, from one end of a format's codes to the other; the depth functions.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>

#include "combiner_tests/raster/fragment_support.h"

namespace ninebit::test {
namespace {

constexpr int kWide = 16384, kHigh = 64;
constexpr std::uint32_t kDeepest = 0xFFFFFF;

// Draws one triangle's depth alone onto the widest target.
class WideDepth {
 public:
  WideDepth() : depth_(static_cast<std::size_t>(kWide) * kHigh) {}

  void draw(const oracle::WindowTriangle& triangle) {
    std::fill(depth_.begin(), depth_.end(), kDeepest);
    Mesh mesh;
    for (const auto& v : triangle) mesh.add(clip_position(v, kWide, kHigh));
    mesh.add_triangle(0, 1, 2);
    RenderTarget target;
    target.width = kWide;
    target.height = kHigh;
    target.depth = {depth_.data(), kWide};
    PipelineState state;
    state.depth_test = {true, CompareFunction::always, true};
    ASSERT_TRUE(rasterize(state, kIdentity, mesh.arrays(), {}, target).ok());
  }
  std::uint32_t at(int x, int y) const {
    return depth_[static_cast<std::size_t>(y) * kWide + static_cast<std::size_t>(x)];
  }

 private:
  std::vector<std::uint32_t> depth_;
};

oracle::WindowTriangle largest_triangle(Random& random) {
  // The guard band reaches 8,192 pixels to each side of the middle.
  const int low = 16 * (kHigh / 2 - 8190), high = 16 * (kHigh / 2 + 8190);
  const auto near_end = [&](int end, int inward) { return end + inward * random.below(4000); };
  const auto z = [&] { return static_cast<std::int64_t>(random.next() & kDeepest); };
  return {{{near_end(0, 1), near_end(low, 1), z()},
           {near_end(16 * kWide, -1), near_end(low, 1), z()},
           {random.between(0, 16 * kWide), near_end(high, -1), z()}}};
}

TEST(Depth, LargestTrianglesFollowTheExactPlane) {
  WideDepth wide;
  for (std::uint64_t index = 0; index < (kSlowBuild ? 3 : 20); ++index) {
    Random random(31, index);
    const oracle::WindowTriangle t = largest_triangle(random);
    wide.draw(t);
    int drawn = 0;
    for (int i = 0; i < 4000; ++i) {
      const int x = random.below(kWide), y = random.below(kHigh);
      if (!oracle::covers(t, x, y)) {
        ASSERT_EQ(wide.at(x, y), kDeepest);
        continue;
      }
      ++drawn;
      ASSERT_EQ(wide.at(x, y), oracle::depth_at(t, x, y)) << "triangle " << index << " pixel " << x << ' ' << y;
    }
    EXPECT_GE(drawn, 1000);
  }
}

std::int64_t inverse_modulo(std::int64_t value, std::int64_t modulus) {
  std::int64_t r0 = modulus, r1 = value % modulus, t0 = 0, t1 = 1;
  while (r1 != 0) {
    const std::int64_t q = r0 / r1;
    r0 = std::exchange(r1, r0 - q * r1);
    t0 = std::exchange(t1, t0 - q * t1);
  }
  return r0 != 1 ? 0 : (t0 + modulus) % modulus;
}

// Depths that lie one part in 2^37 below a half: a quotient in floating point calls them a half. Found by solving
// e1 * dz1 + e2 * dz2 = (area - 1) / 2 modulo the area for a depth difference that fits.
TEST(Depth, JustBelowAHalfIsRoundedDown) {
  __extension__ using WideInteger = __int128;
  WideDepth wide;
  int found = 0;
  Random random(32);
  for (int attempt = 0; attempt < 4000000 && found < 12; ++attempt) {
    oracle::WindowTriangle t = largest_triangle(random);
    const int x = random.below(kWide), y = random.below(kHigh);
    const auto twice_area = [&](std::int64_t ax, std::int64_t ay, std::int64_t bx, std::int64_t by) {
      return (bx - ax) * (16 * y + 8 - ay) - (by - ay) * (16 * x + 8 - ax);
    };
    const std::int64_t e0 = twice_area(t[1].x_q4, t[1].y_q4, t[2].x_q4, t[2].y_q4);
    const std::int64_t e1 = twice_area(t[2].x_q4, t[2].y_q4, t[0].x_q4, t[0].y_q4);
    const std::int64_t e2 = twice_area(t[0].x_q4, t[0].y_q4, t[1].x_q4, t[1].y_q4);
    const std::int64_t area = e0 + e1 + e2;
    if (area % 2 == 0 || e0 <= 0 || e1 <= 0 || e2 <= 0) continue;
    const std::int64_t inverse = inverse_modulo(e1, area);
    if (inverse == 0) continue;
    for (int tries = 0; tries < 4000; ++tries) {
      const std::int64_t dz2 = -static_cast<std::int64_t>(random.next() & kDeepest);
      const WideInteger right = ((WideInteger{(area - 1) / 2} - WideInteger{e2} * dz2) % area + area) % area;
      const std::int64_t dz1 = static_cast<std::int64_t>(right * inverse % area) - area;
      if (dz1 < -std::int64_t{kDeepest}) continue;
      t[0].z24 = kDeepest;
      t[1].z24 = kDeepest + dz1;
      t[2].z24 = kDeepest + dz2;
      ++found;
      wide.draw(t);
      EXPECT_EQ(wide.at(x, y), oracle::depth_at(t, x, y)) << "pixel " << x << ' ' << y;
      break;
    }
  }
  EXPECT_EQ(found, 12);
}

// A pixel's centre in the middle of a left edge whose ends lie an odd number of steps apart.
TEST(Depth, ExactHalvesAreCutOrRoundedUp) {
  const int size = 64;
  for (std::uint64_t index = 0; index < 500; ++index) {
    Random random(35, index);
    const int x = random.below(20), y = random.between(20, 40), reach = random.between(1, 4000);
    const auto z = [&] { return static_cast<std::int64_t>(random.next() & (kDeepest - 1)); };
    oracle::WindowTriangle t{{{16 * x + 8, 16 * y + 8 + reach, z()},
                              {16 * x + 8, 16 * y + 8 - reach, z()},
                              {16 * x + 8 + random.between(1, 4000), random.between(-2000, 2000), z()}}};
    if ((t[0].z24 + t[1].z24) % 2 == 0) ++t[0].z24;
    Mesh mesh;
    for (const auto& v : t) mesh.add(clip_position(v, size, size));
    mesh.add_triangle(0, 1, 2);
    PipelineState state;
    state.depth_test = {true, CompareFunction::always, true};
    const auto at = static_cast<std::size_t>(y * size + x);
    ASSERT_EQ(drawn_surface(size, size, state, mesh.arrays()).depth()[at], (t[0].z24 + t[1].z24) / 2);
    state.profile.depth_narrowing.value = Narrowing::nearest_halves_up;
    ASSERT_EQ(drawn_surface(size, size, state, mesh.arrays()).depth()[at], (t[0].z24 + t[1].z24 + 1) / 2);
  }
}

TEST(Depth, EndsOfTheRange) {
  struct Row {
    float z;
    std::array<std::uint32_t, 3> code;  // of kFormats; 24 bits are those of the vertices, which are rounded
  };
  for (const Row& row :
       {Row{-1.0F, {0, 0, 0}}, Row{1.0F, {0xFFFFFF, 0xFFFF, 0x7FFF}}, Row{0.0F, {0x800000, 0x7FFF, 0x3FFF}},
        Row{0.5F, {12582911, 49151, 24575}}, Row{-0.5F, {4194304, 16383, 8191}}}) {
    for (std::size_t i = 0; i < 3; ++i) {
      Surface surface = Surface::make(3, 2, {.depth_stencil = kFormats[i]}).value();
      surface.fill({.depth = 0.3});
      RenderTarget target = surface.target();
      PipelineState state;
      state.depth_test = {true, CompareFunction::always, true};
      ASSERT_TRUE(rasterize(state, kIdentity, level_triangle(row.z).arrays(), {}, target).ok());
      EXPECT_EQ(surface.depth(), PlaneSamples<std::uint32_t>(6, row.code[i])) << row.z;
    }
  }
}

// Every function at and beside every edge of a format's codes, through whole draws: pixel i of the target holds code i.
TEST(Depth, EveryFunctionAtTheEdgesOfEachFormat) {
  for (const DepthStencilFormat format : kFormats) {
    const std::uint32_t largest = max_depth(format), middle = largest / 2;
    const std::vector<std::uint32_t> codes{0, 1, 2, middle - 1, middle, middle + 1, largest - 2, largest - 1, largest};
    const int width = static_cast<int>(codes.size());
    for (int function = 0; function < 8; ++function) {
      for (const std::uint32_t drawn : codes) {
        Surface surface = Surface::make(width, 1, {.depth_stencil = format}).value();
        RenderTarget target = surface.target();
        std::copy(codes.begin(), codes.end(), target.depth.data);
        PipelineState state;
        state.depth_test = {true, static_cast<CompareFunction>(function), true};
        const std::int64_t z24 = std::int64_t{drawn} << (24 - depth_bits(format));
        const float z = clip_position({0, 0, z24}, {0, 0, width, 1}, 4, format).z;
        ASSERT_TRUE(rasterize(state, kIdentity, level_triangle(z).arrays(), {}, target).ok());
        for (std::size_t i = 0; i < codes.size(); ++i) {
          const std::uint32_t stored = codes[i];
          const std::array<bool, 8> passes{false, drawn<stored, drawn == stored, drawn <= stored, drawn> stored,
                                           drawn != stored, drawn >= stored, true};
          const bool expected = passes[static_cast<std::size_t>(function)];
          ASSERT_EQ(surface.depth()[i], expected ? drawn : stored) << "function " << function << " over " << stored;
          ASSERT_EQ(surface.color(0)[i], expected ? 255 : 0);
        }
      }
    }
  }
}

// Without the test, or without its writing, the plane stays; without the test, everything is drawn.
TEST(Depth, TestAndMaskAreApart) {
  for (const bool enabled : {false, true}) {
    for (const bool write : {false, true}) {
      Surface surface = Surface::make(3, 2).value();
      surface.fill({.depth = 0.25});
      const PlaneSamples<std::uint32_t> before = surface.depth();
      RenderTarget target = surface.target();
      PipelineState state;
      state.depth_test = {enabled, CompareFunction::less, write};
      ASSERT_TRUE(rasterize(state, kIdentity, level_triangle(0.0F).arrays(), {}, target).ok());
      EXPECT_EQ(surface.color(0)[0], enabled ? 0 : 255);
      EXPECT_EQ(surface.depth(), before);
      ASSERT_TRUE(rasterize(state, kIdentity, level_triangle(-0.9F).arrays(), {}, target).ok());
      EXPECT_EQ(surface.color(0)[0], 255);
      EXPECT_EQ(surface.depth() != before, enabled && write);
    }
  }
}

// Triangles anywhere before the camera, also through the near plane.
Mesh soup(Random& random, int triangles) {
  Mesh mesh;
  for (int i = 0; i < triangles; ++i) {
    const glm::vec3 middle(random.real_f(-3, 3), random.real_f(-3, 3), random.real_f(-8, 0.5));
    const double spread = random.pick({0.1, 0.5, 3.0});
    for (int k = 0; k < 3; ++k) {
      mesh.add(middle + glm::vec3(random.real_f(-spread, spread), random.real_f(-spread, spread),
                                  random.real_f(-spread, spread)));
      mesh.vertex_colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
    }
    const auto first = static_cast<std::uint32_t>(3 * i);
    mesh.add_triangle(first, first + 1, first + 2);
  }
  return mesh;
}

TEST(Depth, IsTheSameForEveryOrderOfAnUnclippedTrianglesVertices) {
  const int size = 200;
  const glm::mat4 matrix = perspective(1.0, 1.0, 0.1, 20);
  std::int64_t drawn = 0;
  for (std::uint64_t index = 0; index < 60; ++index) {
    Random random(33, index);
    Mesh mesh;
    for (int k = 0; k < 3; ++k) mesh.add({random.real_f(-4, 4), random.real_f(-4, 4), random.real_f(-6, -0.2)});
    std::array<std::uint32_t, 3> order{0, 1, 2};
    PlaneSamples<std::uint32_t> first;
    do {
      mesh.triangles.clear();
      mesh.add_triangle(order[0], order[1], order[2]);
      PipelineState state;
      state.depth_test = {true, CompareFunction::always, true};
      const Surface surface = drawn_surface(size, size, state, mesh.arrays(), {}, {}, matrix);
      if (first.empty()) {
        first = surface.depth();
        for (const std::uint32_t z : first) drawn += z != kDeepest ? 1 : 0;
      }
      ASSERT_EQ(first, surface.depth()) << "triangle " << index;
    } while (std::next_permutation(order.begin(), order.end()));
  }
  EXPECT_GE(drawn, 100000);
}

// A depth pass without colour, then the same triangles with EQUAL through the combiners: every pixel is met again.
TEST(Depth, EqualMeetsWhatAnEarlierPassWrote) {
  for (std::uint64_t index = 0; index < 10; ++index) {
    Random random(34, index);
    const int width = random.between(60, 200), height = random.between(60, 200);
    const Mesh mesh = soup(random, 300);
    const glm::mat4 matrix = perspective(0.8, static_cast<double>(width) / height, 0.1, 20);
    Surface surface = Surface::make(width, height).value();
    RenderTarget target = surface.target();
    PipelineState depth_pass;
    depth_pass.color_mask = {};
    depth_pass.depth_test.enabled = true;
    ASSERT_TRUE(rasterize(depth_pass, matrix, mesh.arrays(), {}, target).ok());
    const PlaneSamples<std::uint32_t> depth = surface.depth();

    PipelineState color_pass = counting_state();
    color_pass.color_mask = {true, true, true, true};
    color_pass.depth_test = {true, CompareFunction::equal, false};
    color_pass.stencil_test.front = {.reference = 1, .depth_pass = StencilOperation::replace};
    color_pass.program = pass_through(Register::primary, Register::primary);
    ASSERT_TRUE(rasterize(color_pass, matrix, mesh.arrays(), {}, target).ok());
    EXPECT_EQ(surface.depth(), depth);
    std::int64_t drawn = 0;
    for (std::size_t i = 0; i < depth.size(); ++i) {
      ASSERT_EQ(surface.stencil()[i], depth[i] != kDeepest ? 1 : 0) << "scene " << index << " sample " << i;
      drawn += surface.stencil()[i];
    }
    EXPECT_GE(drawn, width * height / 4);
  }
}

}  // namespace
}  // namespace ninebit::test

// Floating-point depth and W buffers: codes, primitives and offsets against the oracle, vectors against the scalar
// path, and what is refused.
#include <gtest/gtest.h>

#include <cmath>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/raster/fragment_support.h"
#include "ninebit/raster/prepared_draw.h"
#include "src/raster/setup/window_transform.h"

namespace ninebit::test {
namespace {

constexpr int kNumberWindow = 48;
constexpr std::array kNumberFormats{DepthStencilFormat::f24s8, DepthStencilFormat::f16,    DepthStencilFormat::w24s8,
                                    DepthStencilFormat::w16,   DepthStencilFormat::wf24s8, DepthStencilFormat::wf16};

struct NumberCase {
  DepthStencilFormat format = DepthStencilFormat::f24s8;
  PipelineState state;
  std::vector<glm::vec4> clip;
  std::vector<ColorBytes> colors;
  std::vector<oracle::DrawnVertex> vertices;  // as the oracle has them
};

// Clip coordinates of the middle of the snapping cell, toward zero.
glm::vec4 clip_of_corner(const oracle::WindowVertex& v, float z, float w) {
  const auto middle = [](std::int64_t q4) {
    return static_cast<float>((static_cast<double>(q4) + (q4 < 0 ? -0.5 : 0.5)) / (8.0 * kNumberWindow) - 1.0);
  };
  return glm::vec4(middle(v.x_q4), middle(v.y_q4), z, 1.0F) * w;
}

NumberCase random_numbers(Random& random) {
  NumberCase c;
  c.format = random.pick({kNumberFormats[0], kNumberFormats[1], kNumberFormats[2], kNumberFormats[3], kNumberFormats[4],
                          kNumberFormats[5]});
  const DepthStencilLayout& layout = layout_of(c.format);
  c.state.depth_test = {true, random.pick({CompareFunction::always, CompareFunction::less}), true};
  if (random.one_in(4)) c.state.profile.depth_narrowing.value = Narrowing::nearest_halves_up;
  if (random.one_in(3)) c.state.profile.polygon_offset_slope.value = OffsetSlope::root;
  if (!layout.is_w && random.one_in(2)) c.state.float_depth_one = random.pick({1.0F, 512.0F, 0x1p25F, 1e30F, 0.01F});
  if (random.one_in(3)) {
    c.state.polygon_offset = {.fill = true, .factor = random.real_f(-3, 3), .units = random.real_f(-9, 9)};
  }
  const double largest = oracle::largest_number(layout.depth_bits, layout.exponent_bits);
  const double one = c.state.float_depth_one ? static_cast<double>(*c.state.float_depth_one) : largest;
  const int triangles = random.between(1, 6);
  for (int i = 0; i < triangles; ++i) {
    const float size = random.pick({1.0F, 30.0F, 600.0F, 70000.0F});
    const bool is_small = random.one_in(3);
    for (int k = 0; k < 3; ++k) {
      const int reach = is_small ? 40 : 16 * kNumberWindow;
      oracle::WindowVertex v{random.below(reach) + (is_small ? 16 * (i + 3) : 0), random.below(reach)};
      const float w = layout.is_w ? random.real_f(0.5, 1) * size : 1.0F;
      const float z = random.one_in(5) ? -1.0F : random.real_f(-1, 1);
      c.clip.push_back(clip_of_corner(v, layout.is_w ? 0.0F : z, w));
      const double window = static_cast<double>(c.clip.back().z) / static_cast<double>(c.clip.back().w) * 0.5 + 0.5;
      v.number =
          layout.is_w ? 1 / static_cast<double>(1.0F / w) : static_cast<double>(static_cast<float>(window)) * one;
      c.vertices.push_back({v});
      c.colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
    }
  }
  return c;
}

// Depths after drawing; how: 0 flat, 1 smooth colours, 2 blended, which no vectors draw.
PlaneSamples<std::uint32_t> depths_of(const NumberCase& c, int how) {
  PipelineState state = c.state;
  VertexArrays arrays{.homogeneous_positions = c.clip};
  if (how == 1) arrays.vertex_colors = c.colors;
  if (how == 2) state.blend = {true, BlendFactor::one, BlendFactor::one, BlendEquation::add, {}};
  return drawn_surface(kNumberWindow, kNumberWindow, state, arrays, {}, {.depth_stencil = c.format}).depth();
}

// The same by the oracle.
PlaneSamples<std::uint32_t> expected_depths(const NumberCase& c, std::uint64_t& compared) {
  oracle::Picture picture = empty_picture(kNumberWindow, kNumberWindow, c.format);
  std::fill(picture.depth.begin(), picture.depth.end(), max_depth(c.format));
  oracle::Tally tally;
  oracle::draw(c.state, {.vertices = c.vertices}, picture, tally);
  compared += tally.fragments;
  return {picture.depth.begin(), picture.depth.end()};
}

TEST(NumberDepth, CodesAreThoseOfTheOracle) {
  Random random(0xF107);
  for (const DepthStencilFormat format : kNumberFormats) {
    const DepthStencilLayout& layout = layout_of(format);
    for (const Narrowing narrowing : {Narrowing::toward_zero, Narrowing::nearest_halves_up}) {
      const WindowDepth depth(format, narrowing);
      const bool is_cut = narrowing == Narrowing::toward_zero;
      for (int i = 0; i < (kSlowBuild ? 20000 : 200000); ++i) {
        const double number = std::ldexp(random.real_f(1, 2), random.between(-140, 140));
        ASSERT_EQ(depth.code_of_number(number),
                  oracle::number_code(layout.depth_bits, layout.exponent_bits, number, is_cut))
            << layout.name << ' ' << number;
      }
      EXPECT_EQ(depth.code_of_number(-3.0), 0U);
      EXPECT_EQ(depth.code_of_number(std::nan("")), 0U);
      EXPECT_EQ(depth.code_of_number(HUGE_VAL), max_depth(format));
      EXPECT_EQ(depth.code_of_number(1e300), max_depth(format));
      EXPECT_EQ(depth.code_of_number(depth.one()), max_depth(format)) << layout.name;
    }
  }
  // 1.5 of e4m12 and e8m16.
  EXPECT_EQ(WindowDepth(DepthStencilFormat::f16, Narrowing::toward_zero).code_of_number(1.5), 0x7800U);
  EXPECT_EQ(WindowDepth(DepthStencilFormat::f24s8, Narrowing::toward_zero).code_of_number(1.5), 0x7F8000U);
  EXPECT_EQ(WindowDepth(DepthStencilFormat::w16, Narrowing::toward_zero).code_of_number(58.9), 58U);
}

TEST(NumberDepth, TrianglesHaveTheOraclesCodesInVectorsAndWithout) {
  std::uint64_t compared = 0;
  for (std::uint64_t index = 0; index < (kSlowBuild ? 60U : 600U); ++index) {
    Random random(0xDE97, index);
    const NumberCase c = random_numbers(random);
    const auto expected = expected_depths(c, compared);
    for (const std::int64_t simd : simd_targets()) {
      const OnTarget on(simd);
      for (const int how : {0, 1, 2}) {
        ASSERT_EQ(depths_of(c, how), expected)
            << simd_target_name(simd) << ", case " << index << ", " << layout_of(c.format).name << ' ' << how;
      }
    }
  }
  EXPECT_GT(compared, kSlowBuild ? 20000U : 200000U);
}

// A line's depth runs from end to end, in w as 1/w; a point has its own.
TEST(NumberDepth, LinesAndPoints) {
  const std::array<glm::vec4, 2> ends{clip_of_corner({8, 200, 0}, 0.0F, 10.0F),
                                      clip_of_corner({712, 200, 0}, 0.0F, 400.0F)};
  Surface surface = Surface::make(kNumberWindow, kNumberWindow, {.depth_stencil = DepthStencilFormat::w16}).value();
  RenderTarget target = surface.target();
  PipelineState state;
  state.depth_test = {true, CompareFunction::always, true};
  ASSERT_TRUE(
      rasterize(state, kIdentity, {.type = PrimitiveType::lines, .homogeneous_positions = ends}, {}, target).ok());
  for (int x = 1; x < 44; ++x) {
    const double t = x / 44.0;
    const auto expected = static_cast<std::uint32_t>(1 / ((1 - t) / 10 + t / 400));
    EXPECT_NEAR(surface.depth()[static_cast<std::size_t>(12 * kNumberWindow + x)], expected, 1) << x;
  }
  ASSERT_TRUE(
      rasterize(state, kIdentity, {.type = PrimitiveType::points, .homogeneous_positions = ends}, {}, target).ok());
  EXPECT_EQ(surface.depth()[static_cast<std::size_t>(12 * kNumberWindow)], 9U);  // 1 / (1 / 10 as a float)
}

TEST(NumberDepth, ClearsToTheNearestCode) {
  PipelineState state;
  ClearValues values;
  const auto cleared = [&](DepthStencilFormat format, double depth) {
    Surface surface = Surface::make(1, 1, {.depth_stencil = format}).value();
    RenderTarget target = surface.target();
    values.depth = depth;
    EXPECT_TRUE(clear(state, {.depth = true}, values, target).ok());
    return surface.depth()[0];
  };
  for (const DepthStencilFormat format : kNumberFormats) {
    EXPECT_EQ(cleared(format, 1.0), max_depth(format));
    EXPECT_EQ(cleared(format, 0.0), 0U);
  }
  EXPECT_EQ(cleared(DepthStencilFormat::w16, 0.5), 32768U);
  EXPECT_EQ(cleared(DepthStencilFormat::f16, 0.5), 0xEFFFU);  // 255.96875
  state.float_depth_one = 3.0F;
  EXPECT_EQ(cleared(DepthStencilFormat::f16, 0.5), 0x7800U);
}

TEST(NumberDepth, WhatTheChipDoesNotHaveIsRefused) {
  const auto fault = [&](DepthStencilFormat format, const PipelineState& state) {
    Surface surface = Surface::make(2, 2, {.depth_stencil = format}).value();
    RenderTarget target = surface.target();
    const Status status = rasterize(state, kIdentity, {.positions = kWholeTarget}, {}, target);
    return status.ok() ? "" : status.error().message;
  };
  PipelineState stencil;
  stencil.stencil_test.enabled = true;
  EXPECT_EQ(fault(DepthStencilFormat::f16, stencil),
            "the stencil test is enabled, but the depth-stencil format f16 has no stencil bits");
  EXPECT_EQ(fault(DepthStencilFormat::d16, stencil), "");  // OpenGL: the test passes
  PipelineState depth;
  depth.depth_test.enabled = true;
  EXPECT_EQ(fault(DepthStencilFormat::w24s8, depth),
            "the W buffer w24s8 needs a perspective view, but this matrix gives every vertex the same w");
  EXPECT_EQ(fault(DepthStencilFormat::w24s8, {}), "");
  EXPECT_EQ(fault(DepthStencilFormat::f24s8, depth), "");
  for (const float one : {0.0F, -1.0F, HUGE_VALF, std::nanf("")}) {
    depth.float_depth_one = one;
    EXPECT_NE(fault(DepthStencilFormat::f24s8, depth).find("expected a finite one above 0"), std::string::npos);
  }
}

// A prepared draw finds the same W buffer, in the passes that test depth.
TEST(NumberDepth, PreparedDrawsNeedAPerspectiveViewToo) {
  Surface surface = Surface::make(2, 2, {.depth_stencil = DepthStencilFormat::w16}).value();
  RenderTarget target = surface.target();
  PreparedDraw prepared;
  PipelineState state;
  ASSERT_TRUE(prepare(state, kIdentity, {.positions = kWholeTarget}, target, prepared).ok());
  EXPECT_TRUE(rasterize(state, prepared, {.positions = kWholeTarget}, {}, target).ok());
  state.depth_test.enabled = true;
  const Status status = rasterize(state, prepared, {.positions = kWholeTarget}, {}, target);
  ASSERT_FALSE(status.ok());
  EXPECT_NE(status.error().message.find("needs a perspective view"), std::string::npos);
}

}  // namespace
}  // namespace ninebit::test

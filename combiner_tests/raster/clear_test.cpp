// clear(): masks, scissor, rounding of the values; Surface::fill, which asks none of them.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "combiner_tests/raster/fragment_support.h"
#include "src/raster/surface/color_words.h"

namespace ninebit::test {
namespace {

__extension__ using WideInt = __int128;

// The nearest code, halves up, by whole numbers: depth is a fraction over 2^shift.
std::uint32_t nearest_code(DepthStencilFormat format, double depth) {
  int exponent = 0;
  const auto fraction = static_cast<std::int64_t>(std::ldexp(std::frexp(depth, &exponent), 53));
  const int shift = 53 - exponent;
  if (shift > 100) return 0;
  const WideInt twice = WideInt{fraction} * max_depth(format) * 2 + (WideInt{1} << shift);
  return static_cast<std::uint32_t>(twice >> (shift + 1));
}

TEST(Clear, DepthGoesToTheNearestCode) {
  for (const DepthStencilFormat format : kFormats) {
    const std::uint32_t largest = max_depth(format);
    const std::uint32_t step = largest > 0xFFFF ? (kSlowBuild ? 1009 : 61) : 1;
    for (std::uint32_t code = 0; code < largest; code += step) {
      ASSERT_EQ(depth_code(format, static_cast<double>(code) / largest), code);
      // The number that lies nearest to the half between two codes, and its neighbours.
      const double half = (code + 0.5) / largest;
      for (const double depth : {half, std::nextafter(half, 0.0), std::nextafter(half, 1.0)}) {
        ASSERT_EQ(depth_code(format, depth), nearest_code(format, depth)) << code;
      }
    }
    const double nan = std::numeric_limits<double>::quiet_NaN(), infinity = std::numeric_limits<double>::infinity();
    EXPECT_EQ(depth_code(format, 1.0), largest);
    for (const double beyond : {1.0000001, 7.0, infinity}) EXPECT_EQ(depth_code(format, beyond), largest);
    for (const double below : {0.0, -0.0, -1.0, -infinity, nan, 1e-300, 5e-324})
      EXPECT_EQ(depth_code(format, below), 0U);
    EXPECT_EQ(depth_code(format, std::nextafter(1.0, 0.0)), largest);
  }
  EXPECT_EQ(depth_code(DepthStencilFormat::d24s8, 0.5), 0x800000U);
  EXPECT_EQ(depth_code(DepthStencilFormat::d16, 0.5), 0x8000U);
  EXPECT_EQ(depth_code(DepthStencilFormat::d15s1, 0.5), 0x4000U);
}

TEST(Clear, StencilKeepsItsLowBits) {
  for (const int value : {0, 1, 2, 255, 256, 257, -1, -2, std::numeric_limits<int>::min()}) {
    EXPECT_EQ(stencil_value(DepthStencilFormat::d24s8, value), value & 255);
    EXPECT_EQ(stencil_value(DepthStencilFormat::d15s1, value), value & 1);
    EXPECT_EQ(stencil_value(DepthStencilFormat::d16, value), 0);
  }
}

// Colour, depth and stencil of an undrawn surface are what it is filled or cleared with; the rest is there from the
// start.
TEST(Clear, UndrawnSurfacesAreFilled) {
  const ClearValues values{.color = {1, 2, 3, 4}, .depth = 0.25, .stencil = 5};
  for (const int size : {3, 300}) {  // in little memory and in memory of its own pages
    Surface surface = Surface::make(size, size, {.with_primitive = true, .undrawn = true}).value();
    Surface plain = Surface::make(size, size, {.with_primitive = true}).value();
    const auto samples = static_cast<std::size_t>(size) * static_cast<std::size_t>(size);
    ASSERT_EQ(surface.depth().size(), samples);
    EXPECT_EQ(surface.primitive(), plain.primitive());
    surface.fill(values);
    plain.fill(values);
    for (int c = 0; c < 4; ++c) EXPECT_EQ(surface.color(c), plain.color(c));
    EXPECT_EQ(surface.depth(), plain.depth());
    EXPECT_EQ(surface.stencil(), plain.stencil());
  }
}

// Only the samples that it was made with are left without a value.
TEST(Clear, UndrawnSamplesAreAPlane) {
  for (const std::size_t count : {std::size_t{10}, std::size_t{100000}}) {
    PlaneSamples<std::uint32_t> samples;
    samples = undrawn_samples<std::uint32_t>(count);
    ASSERT_EQ(samples.size(), count);
    std::fill(samples.begin(), samples.end(), 7U);
    samples.resize(2 * count);
    EXPECT_EQ(std::count(samples.begin(), samples.end(), 7U), static_cast<std::ptrdiff_t>(count));
    EXPECT_EQ(std::count(samples.begin(), samples.end(), 0U), static_cast<std::ptrdiff_t>(count));
  }
}

// The planes that clear() should leave, sample by sample.
oracle::Picture cleared(const PipelineState& state, ClearBuffers buffers, const ClearValues& values,
                        oracle::Picture p) {
  for (int y = 0; y < p.height; ++y) {
    for (int x = 0; x < p.width; ++x) {
      if (state.scissor) {
        const PixelRect& s = *state.scissor;
        if (x < s.x || y < s.y || x - std::int64_t{s.x} >= s.width || y - std::int64_t{s.y} >= s.height) continue;
      }
      const auto at = static_cast<std::size_t>(y * p.width + x);
      for (std::size_t i = 0; i < 4; ++i) {
        if (buffers.color && state.color_mask[i] && (i < 3 || p.has_alpha)) p.color[at][i] = values.color[i];
      }
      if (buffers.depth && state.depth_test.write) p.depth[at] = depth_code(p.format, values.depth);
      const int bits = p.format == DepthStencilFormat::d24s8 ? 8 : p.format == DepthStencilFormat::d15s1 ? 1 : 0;
      for (int bit = 1; buffers.stencil && bit < 1 << bits; bit *= 2) {
        if ((state.stencil_test.front.write_mask & bit) == 0) continue;
        p.stencil[at] = static_cast<std::uint8_t>((p.stencil[at] & ~bit) | (values.stencil & bit));
      }
    }
  }
  return p;
}

TEST(Clear, AsksMasksAndScissorAndNothingElse) {
  std::uint64_t changed = 0;
  const std::uint64_t count = 4000;
  for (std::uint64_t index = 0; index < count; ++index) {
    Random random(81, index);
    PipelineState state;
    randomize_fragment_operations(random, state);  // the tests, the back face and blending have no say
    const int width = random.between(1, 9), height = random.between(1, 9);
    const oracle::Picture start = random_picture(random, width, height, kFormats[random.below(3)]);
    constexpr int kLargest = std::numeric_limits<int>::max();
    if (random.one_in(2)) {
      state.scissor = PixelRect{random.between(-3, width + 1), random.between(-3, height + 1), random.below(width + 3),
                                random.below(height + 3)};
    } else if (random.one_in(4)) {
      state.scissor =
          random.one_in(2) ? PixelRect{2, 3, kLargest, kLargest} : PixelRect{-kLargest, kLargest, kLargest, 9};
    }
    const ClearBuffers buffers{!random.one_in(4), !random.one_in(4), !random.one_in(4)};
    const ClearValues values{.color = {random.byte(), random.byte(), random.byte(), random.byte()},
                             .depth = random.real(-0.2, 1.2),
                             .stencil = random.between(-1000, 1000)};
    PicturePlanes planes(start, random.one_in(2));
    const Status status = clear(state, buffers, values, planes.target);
    ASSERT_TRUE(status.ok()) << status.error().message;
    const oracle::Picture result = planes.picture();
    ASSERT_TRUE(same_samples(result, cleared(state, buffers, values, start))) << index;
    changed += same_samples(result, start) ? 0U : 1U;
  }
  EXPECT_GE(changed, count / 3);
}

// Rows may have padding, and planes may be missing.
TEST(Clear, StaysWithinThePlanes) {
  std::vector<std::uint32_t> depth(5 * 3, 7);
  RenderTarget target;
  target.width = 4;
  target.height = 3;
  target.depth = {depth.data(), 5};
  ASSERT_TRUE(clear({}, {}, {.color = {1, 2, 3, 4}, .depth = 0.0, .stencil = 9}, target).ok());
  for (std::size_t i = 0; i < depth.size(); ++i) EXPECT_EQ(depth[i], i % 5 == 4 ? 7U : 0U);
}

TEST(Clear, ReportsSenselessTargets) {
  RenderTarget target;
  EXPECT_FALSE(clear({}, {}, {}, target).ok());
  target.width = 4;
  target.height = 4;
  EXPECT_TRUE(clear({}, {}, {}, target).ok());
  PipelineState state;
  state.scissor = PixelRect{0, 0, -1, 5};
  EXPECT_EQ(clear(state, {}, {}, target).error().message, "the scissor is -1x5; its sides must not be negative");
}

TEST(Surfaces, StartAndFillByFormat) {
  for (const DepthStencilFormat format : kFormats) {
    Surface surface = Surface::make(3, 2, {.depth_stencil = format, .with_primitive = true}).value();
    EXPECT_EQ(surface.format(), format);
    EXPECT_EQ(surface.depth(), PlaneSamples<std::uint32_t>(6, max_depth(format)));
    EXPECT_EQ(surface.stencil().size(), format == DepthStencilFormat::d16 ? 0U : 6U);
    RenderTarget target = surface.target();
    EXPECT_EQ(target.format, format);
    EXPECT_EQ(static_cast<bool>(target.stencil), format != DepthStencilFormat::d16);
    ASSERT_EQ(target.outputs.size(), 1U);
    std::get<Plane<std::uint32_t>>(target.outputs[0].plane).at(2, 1) = 5;
    EXPECT_EQ(surface.primitive()[5], 5U);

    surface.fill({.color = {1, 2, 3, 4}, .depth = 0.5, .stencil = 0x1FF});
    for (int i = 0; i < 4; ++i) {
      EXPECT_EQ(surface.color(i), PlaneSamples<std::uint8_t>(6, static_cast<std::uint8_t>(i + 1)));
    }
    EXPECT_EQ(surface.depth(), PlaneSamples<std::uint32_t>(6, max_depth(format) / 2 + 1));
    for (const std::uint8_t value : surface.stencil()) EXPECT_EQ(value, format == DepthStencilFormat::d24s8 ? 255 : 1);
    EXPECT_EQ(surface.primitive(), PlaneSamples<std::uint32_t>(6, 0xFFFFFFFF));
  }
  EXPECT_TRUE(Surface::make(3, 2).value().target().outputs.empty());
  EXPECT_FALSE(Surface::make(0, 2).ok());
  EXPECT_FALSE(Surface::make(2, kMaxSurfaceSize + 1).ok());
}

}  // namespace
}  // namespace ninebit::test

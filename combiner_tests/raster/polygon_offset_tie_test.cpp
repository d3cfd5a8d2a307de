// Polygon offsets that lie halfway between two numbers or next to it: in set-up, in vectors, and against whole numbers.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <optional>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/raster/support.h"
#include "src/raster/draw/primitive_setup.h"
#include "src/raster/setup/clip.h"
#include "src/raster/setup/polygon_offset.h"

namespace ninebit::test {
namespace {

__extension__ using Exact = __int128;

constexpr int kTieWindow = 64;

// factor and units are factor_16 / 16 and units_16 / 16.
struct TieCase {
  oracle::WindowTriangle triangle;
  int factor_16 = 0;
  int units_16 = 0;
  DepthStencilFormat format = DepthStencilFormat::d24s8;
};

// Whether the exact sum, in parts of 1/2^bits, reaches n - 1/2: 2^bits × factor_16 × M >= area × (8 (2 n - 1) - 2^bits
// × units_16 × step), the left side being a root where M is. Numbers here are so small that squares fit.
bool reaches_half_below(const TieCase& c, const OffsetRule& rule, std::int64_t n) {
  const OffsetSlope slope = rule.slope;
  const Exact parts = Exact{1} << rule.bits();
  const auto& [p, q, r] = c.triangle;
  const std::int64_t ux = q.x_q4 - p.x_q4, uy = q.y_q4 - p.y_q4, uz = q.z24 - p.z24;
  const std::int64_t vx = r.x_q4 - p.x_q4, vy = r.y_q4 - p.y_q4, vz = r.z24 - p.z24;
  const std::int64_t area = std::abs(ux * vy - uy * vx);
  const Exact dx = 16 * std::abs(uz * vy - uy * vz), dy = 16 * std::abs(ux * vz - uz * vx);
  const std::int64_t step = std::int64_t{1} << (24 - depth_bits(c.format));
  const Exact right = Exact{area} * (8 * (2 * n - 1) - parts * c.units_16 * step);
  if (slope == OffsetSlope::larger) return parts * c.factor_16 * std::max(dx, dy) >= right;
  const Exact left_squared = parts * c.factor_16 * parts * c.factor_16 * (dx * dx + dy * dy),
              right_squared = right * right;
  const bool left_negative = c.factor_16 < 0 && left_squared != 0;
  if (left_negative != (right < 0)) return !left_negative;
  return left_negative ? left_squared <= right_squared : left_squared >= right_squared;
}

void expect_exact(const TieCase& c, const OffsetRule& rule, std::int64_t offset_q16) {
  const std::int64_t n = offset_q16 >> (kOffsetBits - rule.bits()), most = kLargestOffset << rule.bits();
  EXPECT_EQ(n << (kOffsetBits - rule.bits()), offset_q16);
  EXPECT_TRUE(n == -most || reaches_half_below(c, rule, n)) << "rounded up too far: " << n;
  EXPECT_FALSE(n != most && reaches_half_below(c, rule, n + 1)) << "rounded down too far: " << n;
}

// Whether the sum with the larger slope is exactly offset - 1/2, in whole steps.
bool is_tie(const TieCase& c, std::int64_t offset) {
  const auto& [p, q, r] = c.triangle;
  const std::int64_t ux = q.x_q4 - p.x_q4, uy = q.y_q4 - p.y_q4, uz = q.z24 - p.z24;
  const std::int64_t vx = r.x_q4 - p.x_q4, vy = r.y_q4 - p.y_q4, vz = r.z24 - p.z24;
  const std::int64_t area = std::abs(ux * vy - uy * vx);
  const std::int64_t larger = 16 * std::max(std::abs(uz * vy - uy * vz), std::abs(ux * vz - uz * vx));
  const std::int64_t step = std::int64_t{1} << (24 - depth_bits(c.format));
  return Exact{c.factor_16} * larger == Exact{area} * (8 * (2 * std::int64_t{offset} - 1) - Exact{c.units_16} * step);
}

PipelineState state_of(const TieCase& c, const OffsetRule& rule) {
  PipelineState state;
  state.profile.polygon_offset_slope.value = rule.slope;
  state.profile.polygon_offset_fraction.value = rule.fraction;
  state.polygon_offset = {
      .fill = true, .factor = static_cast<float>(c.factor_16) / 16.0F, .units = static_cast<float>(c.units_16) / 16.0F};
  return state;
}

// The triangle's offset as set-up finds it one by one (with packed vertices: in vectors); none where it is not drawn.
std::optional<std::int64_t> offset_in_setup(const TieCase& c, const OffsetRule& rule, bool packed) {
  const PipelineState state = state_of(c, rule);
  std::vector<glm::vec3> positions;
  for (const auto& v : c.triangle) {
    positions.push_back(clip_position(v, PixelRect{0, 0, kTieWindow, kTieWindow}, 4, c.format));
  }
  const VertexArrays arrays{.positions = positions};
  const SetupContext context(state, PixelRect{0, 0, kTieWindow, kTieWindow}, PixelBox{0, 0, kTieWindow, kTieWindow},
                             c.format, true);
  const PrimitiveAssembly assembly(arrays);
  const ClipPositions clip(kIdentity, arrays);
  RawVector<PackedVertex> vertices;
  if (packed) {
    vertices.resize(positions.size());
    transform_vertices(clip, context.window, vertices.data());
  }
  const TileGrid grid(kTieWindow, kTieWindow);
  PrimitiveSetup setup(context, assembly, clip, vertices);
  BinnedBlock block;
  EXPECT_TRUE(setup.set_up(0, setup.items(), grid, block));
  if (block.setup.primitives.empty()) return std::nullopt;
  const SetupPrimitive& p = block.setup.primitives[0];
  return (std::int64_t{p.offset_z24} << kOffsetBits) + p.fraction;
}

constexpr OffsetRule kRounded{OffsetSlope::larger, OffsetFraction::rounded};

// Corners on whole pixels, half pixels and elsewhere; depths and factors so that m and its product are often whole
// halves, or miss them by the least that the area allows.
TieCase near_a_tie(Random& random) {
  TieCase c;
  c.format = random.pick({DepthStencilFormat::d24s8, DepthStencilFormat::d24s8, DepthStencilFormat::d16});
  const auto place = [&] {
    const int grid = random.pick({16, 8, 16, 1});
    return std::int64_t{grid} * random.below(16 * kTieWindow / grid);
  };
  const std::int64_t x = place(), y = place(), width = place() - x, height = place() - y;
  const std::int64_t z = random.below(1 << 20), dz = random.pick({0, 1, 8, 1000, 4096, 300000});
  const auto depth = [&] { return z + dz * random.below(4) + (random.one_in(3) ? random.between(0, 2) : 0); };
  c.triangle = {
      {{x, y, depth()}, {x + width, y + (random.one_in(3) ? place() / 2 : 0), depth()}, {x, y + height, depth()}}};
  c.factor_16 = random.pick({1, 8, 16, 18, 38, -18, -8, random.between(-400, 400)});
  c.units_16 = random.pick({0, 8, -8, 16 * random.between(-40, 40), random.between(-4000, 4000)});
  return c;
}

// 2.375 m + 35 is 8088000.5 here. The quotient in doubles is a little less.
TEST(PolygonOffsetTies, GoUpWhereDoublesFallShort) {
  const TieCase c{.triangle = {{{328, 16, 5660128}, {160, 408, 14311071}, {312, 104, 12223871}}},
                  .factor_16 = 38,
                  .units_16 = 16 * 35};
  ASSERT_TRUE(is_tie(c, 8088001));
  EXPECT_EQ(offset_in_setup(c, kRounded, false), std::int64_t{8088001} << kOffsetBits);
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on(target);
    EXPECT_EQ(offset_in_setup(c, kRounded, true), std::int64_t{8088001} << kOffsetBits) << simd_target_name(target);
  }
}

TEST(PolygonOffsetTies, RandomTrianglesAreRoundedExactly) {
  const std::uint64_t count = kSlowBuild ? 3000 : 30000;
  for (const OffsetRule& rule :
       {kRounded, OffsetRule{OffsetSlope::root, OffsetFraction::rounded},
        OffsetRule{OffsetSlope::larger, OffsetFraction::kept}, OffsetRule{OffsetSlope::root, OffsetFraction::kept}}) {
    std::uint64_t drawn = 0, ties = 0;
    for (std::uint64_t index = 0; index < count; ++index) {
      Random random(0x71E5, index);
      const TieCase c = near_a_tie(random);
      const auto offset = offset_in_setup(c, rule, false);
      if (!offset) continue;
      ++drawn;
      ties += is_tie(c, (*offset + (1 << (kOffsetBits - 1))) >> kOffsetBits) ? 1U : 0U;
      expect_exact(c, rule, *offset);
      ASSERT_FALSE(HasFailure()) << "case " << index;
    }
    EXPECT_GT(drawn, count / 2);
    EXPECT_GT(ties, rule.slope == OffsetSlope::larger ? count / 30 : 0);
  }
}

TEST(PolygonOffsetTies, VectorsAgreeWithSetUpOneByOne) {
  for (std::uint64_t index = 0; index < (kSlowBuild ? 1000U : 8000U); ++index) {
    Random random(0x71E5, index);
    const TieCase c = near_a_tie(random);
    const OffsetRule rule{random.pick({OffsetSlope::larger, OffsetSlope::root}),
                          random.pick({OffsetFraction::kept, OffsetFraction::rounded})};
    const auto one_by_one = offset_in_setup(c, rule, false);
    for (const std::int64_t target : simd_targets()) {
      const OnTarget on(target);
      const auto offset = offset_in_setup(c, rule, true);
      // Vectors also drop what covers no pixel.
      if (offset) {
        ASSERT_EQ(offset, one_by_one) << simd_target_name(target) << ", case " << index;
      }
      ASSERT_TRUE(on.ran());
    }
  }
}

// Terms of any size that cancel but for one step, or exactly: doubles lose that step.
TEST(PolygonOffsetTies, HugeTermsThatCancelLeaveTheirDifference) {
  const WindowDepth depth(DepthStencilFormat::d24s8, Narrowing::toward_zero);
  // m = 16 × dx / area is 1, 3 and 1/3.
  for (const auto& [dx, area, thirds] : {std::tuple(4, 64, 3), std::tuple(12, 64, 9), std::tuple(4, 192, 1)}) {
    const DepthPlane plane{.area = area, .dx = dx, .dy = 0};
    for (const float size : {0x1p20F, 0x1p60F, 0x1p100F, 0x1.8p126F}) {
      for (const float sign : {1.0F, -1.0F}) {
        // factor × m = thirds × size exactly, as units cannot be of every size.
        const PolygonOffset cancels{
            .fill = true, .factor = 3 * sign * size, .units = -static_cast<float>(thirds) * sign * size};
        if (!std::isfinite(cancels.factor) || !std::isfinite(cancels.units)) continue;
        for (const OffsetFraction fraction : {OffsetFraction::kept, OffsetFraction::rounded}) {
          EXPECT_EQ(polygon_offset_q16(cancels, {OffsetSlope::larger, fraction}, plane, depth), 0) << size;
          EXPECT_EQ(polygon_offset_q16(cancels, {OffsetSlope::root, fraction}, plane, depth), 0) << size;
        }
        PolygonOffset more = cancels;
        more.units = std::nextafter(more.units, 0.0F);
        EXPECT_EQ(polygon_offset_q16(more, kRounded, plane, depth) >> kOffsetBits,
                  size > 0x1p40F ? static_cast<std::int64_t>(sign) * kLargestOffset
                                 : std::lround(static_cast<double>(more.units) - static_cast<double>(cancels.units)))
            << size;
      }
    }
  }
}

// Subnormal terms decide a tie like any others: 0.5 less the least float is below it.
TEST(PolygonOffsetTies, TheLeastFloatDecidesATie) {
  const WindowDepth depth(DepthStencilFormat::d24s8, Narrowing::toward_zero);
  const DepthPlane plane{.area = 16, .dx = 1, .dy = 1};  // m = 1
  const float least = std::bit_cast<float>(1U);
  const auto offset = [&](float factor, float units) {
    const PolygonOffset given{.fill = true, .factor = factor, .units = units};
    return polygon_offset_q16(given, kRounded, plane, depth) >> kOffsetBits;
  };
  EXPECT_EQ(offset(0.5F, 0.0F), 1);
  EXPECT_EQ(offset(0.5F, least), 1);
  EXPECT_EQ(offset(0.5F, -least), 0);
  EXPECT_EQ(offset(least, 0.5F), 1);
  EXPECT_EQ(offset(-least, 0.5F), 0);
  EXPECT_EQ(offset(-0.5F, 0.0F), 0);
  EXPECT_EQ(offset(-0.5F, -least), -1);
  EXPECT_EQ(offset(-0.5F, least), 0);
  EXPECT_EQ(offset(0.0F, 0.5F), 1);
  EXPECT_EQ(offset(0.0F, -0.5F), 0);
  EXPECT_EQ(offset(0.0F, -1.5F), -1);
  EXPECT_EQ(offset(-0.0F, std::nextafter(1.5F, 0.0F)), 1);
  EXPECT_EQ(offset(-0.0F, 1.5F), 2);
}

}  // namespace
}  // namespace ninebit::test

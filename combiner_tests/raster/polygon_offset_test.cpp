// Polygon offset: what NV2A's depth buffer showed, and which primitives are moved.
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "combiner_tests/hardware/csv.h"
#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

constexpr int kOffsetWindow = 64;

// "VALUE:PIXELS;VALUE:PIXELS": the values, the most frequent first.
std::vector<int> values_of(const std::string& histogram) {
  std::vector<int> values;
  std::istringstream in(histogram);
  for (std::string entry; std::getline(in, entry, ';');) values.push_back(std::stoi(entry));
  return values;
}

// Depth of every pixel of a quad over the whole target with these gradients in sixteenths of a depth step a pixel.
PlaneSamples<std::uint32_t> plane_depth(int dx_16, int dy_16, const PipelineState& base) {
  std::vector<glm::vec3> positions;
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(kOffsetWindow, 0), std::pair(kOffsetWindow, kOffsetWindow),
                             std::pair(0, kOffsetWindow)}) {
    const std::int64_t z = 1000000 + (dx_16 * x + dy_16 * y) / 16;
    positions.push_back(clip_position({16 * x, 16 * y, z}, kOffsetWindow, kOffsetWindow));
  }
  PipelineState state = base;
  state.depth_test = {true, CompareFunction::always, true};
  return drawn_surface(kOffsetWindow, kOffsetWindow, state, {.type = PrimitiveType::quads, .positions = positions})
      .depth();
}

// The slope of a row is an offset of sixteen times the gradient, which the histograms of both gradients bound.
TEST(PolygonOffset, MovesDepthAsOnTheNv2a) {
  int checked = 0;
  std::map<std::string, int> slope_16;
  const auto rows = read_hardware_table("nv2a_polygon_offset_z24");
  for (const auto& row : rows) {
    if (row.at("offset") != "slope16") continue;
    slope_16[row.at("primitive") + row.at("V1=passthrough vsh")] = values_of(row.at("delta:pixels"))[0];
  }
  for (const auto& row : rows) {
    if (row.at("primitive").rfind("Tri", 0) == 0) continue;  // small triangles: the histograms show the ground
    const int slope = slope_16.at(row.at("primitive") + row.at("V1=passthrough vsh"));
    const auto dx = values_of(row.at("absdzdx:n")), dy = values_of(row.at("absdzdy:n"));
    const auto near_slope = [&](const std::vector<int>& values) {
      for (const int v : values) {
        if (std::abs(16 * v - slope) <= 16) return true;
      }
      return false;
    };
    ASSERT_TRUE(near_slope(dx) || near_slope(dy)) << row.at("primitive");
    const bool along_x = near_slope(dx) && slope != 0;
    PipelineState state;
    state.profile = profiles::nv2a;
    state.polygon_offset.fill = true;
    if (row.at("offset").find("bias16") != std::string::npos) state.polygon_offset.units = 16;
    if (row.at("offset").find("slope16") != std::string::npos) state.polygon_offset.factor = 16;
    const int measured = values_of(row.at("delta:pixels"))[0];
    for (const int sign : {1, -1}) {
      const int g_x = along_x ? sign * slope : 0, g_y = along_x ? 0 : sign * slope;
      const auto with = plane_depth(g_x, g_y, state), without = plane_depth(g_x, g_y, {});
      for (std::size_t i = 0; i < with.size(); ++i) {
        ASSERT_EQ(with[i], without[i] + static_cast<std::uint32_t>(measured)) << row.at("primitive");
      }
    }
    ++checked;
  }
  EXPECT_GE(checked, 12);
}

TEST(PolygonOffset, SlopeIsTheLargerGradientOrTheRoot) {
  PipelineState state;
  state.polygon_offset = {.fill = true, .factor = 2};
  for (const auto& [slope, expected] :
       {std::pair(OffsetSlope::larger, 2 * 400U), std::pair(OffsetSlope::root, 2 * 500U)}) {
    state.profile.polygon_offset_slope.value = slope;
    const auto with = plane_depth(-300 * 16, 400 * 16, state), without = plane_depth(-300 * 16, 400 * 16, {});
    for (std::size_t i = 0; i < with.size(); ++i) ASSERT_EQ(with[i], without[i] + expected);
  }
}

// A quad that is not flat: one offset for all of it, from the larger of its two triangles, of equals from the first.
TEST(PolygonOffset, IsOneForAllTrianglesOfAPolygon) {
  for (const int middle :
       {kOffsetWindow, kOffsetWindow - 16, kOffsetWindow + 16}) {  // where the third corner stands in y
    const std::array<oracle::WindowVertex, 4> corners{{{0, 0, 1000},
                                                       {16 * kOffsetWindow, 0, 1000},
                                                       {16 * kOffsetWindow, 16 * middle, 1000 + 100 * middle},
                                                       {0, 16 * kOffsetWindow, 1000 + 200 * kOffsetWindow}}};
    std::vector<glm::vec3> positions;
    for (const auto& v : corners) positions.push_back(clip_position(v, kOffsetWindow, kOffsetWindow));
    PipelineState state;
    state.depth_test = {true, CompareFunction::always, true};
    std::array<PlaneSamples<std::uint32_t>, 2> depth;
    for (int moved = 0; moved < 2; ++moved) {
      state.polygon_offset = {.fill = true, .factor = static_cast<float>(moved)};
      depth[static_cast<std::size_t>(moved)] =
          drawn_surface(kOffsetWindow, kOffsetWindow, state, {.type = PrimitiveType::quads, .positions = positions})
              .depth();
    }
    // The triangles' slopes are 100 and 200; the first one's area grows with `middle`.
    const std::uint32_t expected = middle >= kOffsetWindow ? 100 : 200;
    for (std::size_t i = 0; i < depth[0].size(); ++i) {
      if (depth[0][i] == 0xFFFFFF) continue;
      ASSERT_EQ(depth[1][i], depth[0][i] + expected) << middle;
    }
  }
}

// Depths of whole steps and a quarter: the offset's fraction and theirs add up before they are cut.
TEST(PolygonOffset, KeepsItsFraction) {
  PipelineState state;
  state.polygon_offset.fill = true;
  const auto moved = [&](OffsetFraction fraction, float factor, float units) {
    state.profile.polygon_offset_fraction.value = fraction;
    state.polygon_offset.factor = factor;
    state.polygon_offset.units = units;
    return std::int64_t{plane_depth(8, 0, state)[0]} - plane_depth(8, 0, {})[0];
  };
  EXPECT_EQ(moved(OffsetFraction::kept, 0, 0.6F), 0);
  EXPECT_EQ(moved(OffsetFraction::rounded, 0, 0.6F), 1);
  EXPECT_EQ(moved(OffsetFraction::kept, 0, 0.75F), 1);
  EXPECT_EQ(moved(OffsetFraction::kept, 1, 0.25F), 1);  // m is 1/2
  EXPECT_EQ(moved(OffsetFraction::kept, 0, -0.25F), 0);
  EXPECT_EQ(moved(OffsetFraction::kept, 0, -0.3F), -1);
  EXPECT_EQ(moved(OffsetFraction::rounded, 0, -0.3F), 0);
}

TEST(PolygonOffset, RoundedIsRoundedOnceHalvesUpAndClamped) {
  PipelineState state;
  state.profile.polygon_offset_fraction.value = OffsetFraction::rounded;
  state.polygon_offset.fill = true;
  const auto offset = [&](float factor, float units) {
    state.polygon_offset.factor = factor;
    state.polygon_offset.units = units;
    return std::int64_t{plane_depth(16, 0, state)[0]} - plane_depth(16, 0, {})[0];
  };
  EXPECT_EQ(offset(0.25F, 0.25F), 1);
  EXPECT_EQ(offset(0.25F, 0.2F), 0);
  EXPECT_EQ(offset(-0.25F, -0.25F), 0);
  EXPECT_EQ(offset(-0.5F, -0.25F), -1);
  state.polygon_offset.units = 3e38F;
  EXPECT_EQ(plane_depth(16, 0, state)[0], 0xFFFFFFU);
  state.polygon_offset.units = -3e38F;
  EXPECT_EQ(plane_depth(16, 0, state)[0], 0U);
}

// r is one step of the target's format; fraction bits stay until the sum is rounded.
TEST(PolygonOffset, UnitsAreStepsOfTheFormat) {
  for (const DepthStencilFormat format : {DepthStencilFormat::d16, DepthStencilFormat::d15s1}) {
    PipelineState state;
    state.depth_test = {true, CompareFunction::always, true};
    const auto depth_with = [&](float units) {
      state.polygon_offset = {.fill = true, .units = units};
      return drawn_surface(1, 1, state, {.positions = kWholeTarget}, {}, {.depth_stencil = format}).depth()[0];
    };
    EXPECT_EQ(depth_with(7), max_depth(format) / 2 + 7);
    EXPECT_EQ(depth_with(7.25F), max_depth(format) / 2 + 7);
    EXPECT_EQ(depth_with(-0.75F), max_depth(format) / 2 - 1);  // 0.5 - 0.75 steps above the lower code
  }
}

TEST(PolygonOffset, EachModeHasItsEnableAndRealLinesAndPointsNone) {
  const std::array<glm::vec3, 3> positions{glm::vec3(-0.5, -0.5, 0), glm::vec3(0.5, -0.5, 0), glm::vec3(0, 0.5, 0)};
  for (int mode = 0; mode < 3; ++mode) {
    for (int enables = 0; enables < 8; ++enables) {
      for (const PrimitiveType type : {PrimitiveType::triangles, PrimitiveType::line_loop, PrimitiveType::points}) {
        PipelineState state;
        state.depth_test = {true, CompareFunction::always, true};
        state.front_mode = static_cast<PolygonMode>(mode);
        state.polygon_offset = {(enables & 4) != 0, (enables & 2) != 0, (enables & 1) != 0, 0, 5};
        const Surface surface =
            drawn_surface(kOffsetWindow, kOffsetWindow, state, {.type = type, .positions = positions});
        const bool moved = type == PrimitiveType::triangles && (enables & (1 << mode)) != 0;
        int drawn = 0;
        for (const std::uint32_t z : surface.depth()) {
          if (z == 0xFFFFFF) continue;
          ++drawn;
          ASSERT_EQ(z, 0x800000U + (moved ? 5 : 0)) << mode << ' ' << enables;
        }
        EXPECT_GE(drawn, 3);
      }
    }
  }
}

}  // namespace
}  // namespace ninebit::test

// Fog factors from fog coordinates, by the NV2A's functions.
#include "src/raster/fragment/fog.h"

#include <gtest/gtest.h>

#include <cmath>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/oracle/attribute_oracle.h"
#include "combiner_tests/raster/support.h"
#include "combiner_tests/support/special_floats.h"

namespace ninebit::test {
namespace {

TEST(FogFunctions, AreThoseOfTheFacts) {
  int compared = 0;
  for (int function = 0; function <= static_cast<int>(FogFunction::exp2_abs); ++function) {
    for (std::uint64_t index = 0; index < 20000; ++index) {
      Random random(0xF06, index);
      const Fog fog{.enabled = true,
                    .color = {},
                    .function = static_cast<FogFunction>(function),
                    .bias = random.real_f(0.5, 2.5),
                    .slope = random.real_f(-1, 1)};
      const float x = random.real_f(-2, 2);
      const auto [low, high] = oracle::fog_bytes(profiles::nv2a, fog, x, 0);
      const int byte = fog_byte(profiles::nv2a, fog, x);
      ASSERT_TRUE(byte == low || byte == high) << function << ' ' << fog.bias << ' ' << fog.slope << ' ' << x;
      ASSERT_LE(high - low, 1);
      compared += low == high ? 1 : 0;
    }
  }
  EXPECT_GT(compared, 138000);
  const Fog exp{.enabled = true, .color = {}, .function = FogFunction::exp, .bias = 1.5F, .slope = 1.0F};
  EXPECT_EQ(fog_byte(profiles::nv2a, exp, 1e30F), 255);
  EXPECT_EQ(fog_byte(profiles::nv2a, exp, -1e30F), 0);
  EXPECT_EQ(fog_byte(profiles::nv2a, exp, std::nanf("")), 0);
}

// The function is computed at each fragment, not at the vertices.
TEST(FogFunctions, ReachTheProgramAtEachFragment) {
  constexpr int kSize = 32;
  const std::array<float, 4> coordinates{-1.0F, 1.0F, 1.0F, -1.0F};
  PipelineState state;
  state.profile = profiles::nv2a;
  state.fog = {.enabled = true, .color = {}, .function = FogFunction::exp2, .bias = 1.5F, .slope = 0.25F};
  state.program = pass_through(Register::fog, Register::fog, profiles::nv2a);
  const Surface surface = drawn_surface(
      kSize, 1, state, {.type = PrimitiveType::quads, .positions = kWholeQuad, .fog_factors = coordinates});
  for (int x = 0; x < kSize; ++x) {
    const long double at = (2 * x + 1) / static_cast<long double>(kSize) - 1;
    const auto [low, high] = oracle::fog_bytes(state.profile, state.fog, at, 1e-6L);
    EXPECT_GE(surface.color(kAlpha)[static_cast<std::size_t>(x)], low) << x;
    EXPECT_LE(surface.color(kAlpha)[static_cast<std::size_t>(x)], high) << x;
  }
  EXPECT_GT(surface.color(kAlpha)[kSize / 2], 250);
  EXPECT_LT(surface.color(kAlpha)[0], 80);
}

// A surface with a further plane is drawn by single fragments, without one by vectors.
TEST(FogFunctions, VectorsTakeCoordinatesThatAreNotFiniteAsSingleFragmentsDo) {
  constexpr int kSize = 100, kVertices = 60;
  for (int function = 0; function <= static_cast<int>(FogFunction::exp2_abs); ++function) {
    std::ptrdiff_t changed = 0, runs = 0;
    for (std::uint64_t index = 0; index < (kSlowBuild ? 1 : 6); ++index) {
      Random random(0xF0609, 100 * static_cast<std::uint64_t>(function) + index);
      PipelineState state;
      state.profile = random.pick({profiles::nv2a, profiles::nv2a, profiles::geforce2, profiles::float_shader});
      state.fog = {.enabled = true,
                   .color = {},
                   .function = static_cast<FogFunction>(function),
                   .bias = random.real_f(0.5, 2.5),
                   .slope = index == 0 ? 1.0F : random.pick({0.0F, 1.0F, random.real_f(-1, 1)})};
      state.program = pass_through(Register::fog, Register::fog, state.profile);
      std::vector<glm::vec4> positions;
      std::vector<float> coordinates, finite;
      for (int i = 0; i < kVertices; ++i) {
        const float w = random.one_in(2) ? 1.0F : random.real_f(0.5, 3);
        positions.emplace_back(random.real_f(-1.3, 1.3) * w, random.real_f(-1.3, 1.3) * w, 0.0F, w);
        finite.push_back(random.real_f(-2, 2));
        coordinates.push_back(random.one_in(3) ? random.pick({kNan, -kNan, kInfinity, -kInfinity, 3e38F, -3e38F})
                                               : finite.back());
      }
      const auto draw = [&](bool with_primitive, std::span<const float> given) {
        return drawn_surface(kSize, kSize, state, {.homogeneous_positions = positions, .fog_factors = given}, {},
                             {.with_primitive = with_primitive})
            .color(kAlpha);
      };
      const PlaneSamples<std::uint8_t> expected = draw(true, coordinates), other = draw(true, finite);
      for (std::size_t i = 0; i < expected.size(); ++i) changed += expected[i] != other[i] ? 1 : 0;
      for (const std::int64_t on : simd_targets()) {
        const OnTarget only(on);
        ASSERT_TRUE(draw(false, coordinates) == expected) << function << ' ' << index << ' ' << simd_target_name(on);
        runs += only.ran() ? 1 : 0;
      }
    }
    EXPECT_GT(changed, kSlowBuild ? 100 : 1000) << function;
    EXPECT_GT(runs, 0) << function;
  }
}

TEST(FogFunctions, NumbersMustBeFinite) {
  Surface surface = Surface::make(1, 1).value();
  RenderTarget target = surface.target();
  PipelineState state;
  state.fog.bias = HUGE_VALF;
  const Status status = rasterize(state, kIdentity, {}, {}, target);
  ASSERT_FALSE(status.ok());
  EXPECT_EQ(status.error().message, "the fog's bias and slope are not both finite");
}

}  // namespace
}  // namespace ninebit::test

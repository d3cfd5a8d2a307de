// Fog factors from fog coordinates, by the NV2A's functions.
#include "src/raster/fragment/fog.h"

#include <gtest/gtest.h>

#include <cmath>

#include "combiner_tests/oracle/attribute_oracle.h"
#include "combiner_tests/raster/support.h"

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
  Surface surface = Surface::make(kSize, 1).value();
  RenderTarget target = surface.target();
  const std::array<glm::vec3, 4> positions{glm::vec3(-1, -1, 0), glm::vec3(1, -1, 0), glm::vec3(1, 1, 0),
                                           glm::vec3(-1, 1, 0)};
  const std::array<float, 4> coordinates{-1.0F, 1.0F, 1.0F, -1.0F};
  PipelineState state;
  state.profile = profiles::nv2a;
  state.fog = {.enabled = true, .color = {}, .function = FogFunction::exp2, .bias = 1.5F, .slope = 0.25F};
  state.program = pass_through(Register::fog, Register::fog, profiles::nv2a);
  const VertexArrays arrays{.type = PrimitiveType::quads, .positions = positions, .fog_factors = coordinates};
  ASSERT_TRUE(rasterize(state, kIdentity, arrays, {}, target).ok());
  for (int x = 0; x < kSize; ++x) {
    const long double at = (2 * x + 1) / static_cast<long double>(kSize) - 1;
    const auto [low, high] = oracle::fog_bytes(state.profile, state.fog, at, 1e-6L);
    EXPECT_GE(surface.color(kAlpha)[static_cast<std::size_t>(x)], low) << x;
    EXPECT_LE(surface.color(kAlpha)[static_cast<std::size_t>(x)], high) << x;
  }
  EXPECT_GT(surface.color(kAlpha)[kSize / 2], 250);
  EXPECT_LT(surface.color(kAlpha)[0], 80);
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

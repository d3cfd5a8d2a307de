// Fog factors from fog coordinates, by the NV2A's functions.
#include "src/raster/fragment/fog.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

// The functions as they are measured, in the widest numbers there are.
long double factor_of(const Fog& fog, long double x) {
  const long double b = fog.bias, l = fog.slope, t = b - 1.5L + l * x;
  switch (fog.function) {
    case FogFunction::factor:
      return x;
    case FogFunction::linear:
      return b - 1 + l * x;
    case FogFunction::linear_abs:
      return b - 1 + l * std::fabs(x);
    case FogFunction::exp:
      return std::min(1.0L, std::exp2(16 * t));
    case FogFunction::exp_abs:
      return std::exp2(-16 * std::fabs(t));
    case FogFunction::exp2:
    case FogFunction::exp2_abs:
      return std::exp2(-32 * t * t);
  }
  return 0;
}

// The byte, unless the factor lies within float error of the next one.
std::optional<int> byte_of(const Fog& fog, long double x) {
  const long double f = std::min(std::max(factor_of(fog, x), 0.0L), 1.0L);
  const bool is_table = fog.function >= FogFunction::exp;
  const long double scaled = is_table ? 255 * f + 0.5L : 4096 * f;
  if (std::fabs(scaled - std::round(scaled)) < 0.01L && scaled > 0.01L && scaled < 4095.99L) return std::nullopt;
  if (is_table) return static_cast<int>(scaled);
  const int n = std::min(static_cast<int>(scaled), 4095);
  return 255 * (n + 1) / 4096;
}

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
      const auto expected = byte_of(fog, x);
      if (!expected) continue;
      ASSERT_EQ(fog_byte(profiles::nv2a, fog, x), *expected)
          << function << ' ' << fog.bias << ' ' << fog.slope << ' ' << x;
      ++compared;
    }
  }
  EXPECT_GT(compared, 120000);
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
    EXPECT_NEAR(surface.color(kAlpha)[static_cast<std::size_t>(x)], byte_of(state.fog, at).value_or(0), 1) << x;
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

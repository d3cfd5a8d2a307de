// Gathering from pixel lights: patterns, and the sum itself against a naive one in doubles on every SIMD target.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>
#include <random>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/support/slow_build.h"
#include "src/shadow/reflective/gather_pattern.h"
#include "src/shadow/reflective/reflective_reference.h"

namespace {

using namespace ninebit;

TEST(GatherPattern, PoissonDiskFillsTheDiscAndKeepsItsPointsApart) {
  for (const int count : {1, 7, 400, 4096}) {
    const GatherPattern p = make_pattern({.samples = count, .pattern = SamplePattern::poisson});
    ASSERT_EQ(p.x.size(), static_cast<std::size_t>(count));
    ASSERT_EQ(p.y.size(), p.x.size());
    EXPECT_TRUE(p.weight.empty());
    double nearest = 4.0, squares = 0.0;
    for (std::size_t i = 0; i < p.x.size(); ++i) {
      ASSERT_LE(std::hypot(p.x[i], p.y[i]), 1.0F);
      squares += std::pow(std::hypot(double{p.x[i]}, double{p.y[i]}), 2);
      for (std::size_t j = 0; j < i; ++j) {
        nearest = std::min(nearest, std::hypot(double{p.x[i]} - p.x[j], double{p.y[i]} - p.y[j]));
      }
    }
    EXPECT_NEAR(p.total_weight(), squares / 2.0, 1e-6 * count);
    if (count < 400) continue;
    // Points of a hexagonal grid of that density are sqrt(2 pi / (sqrt(3) n)) apart; random ones some 1 / n.
    EXPECT_GT(nearest, 0.4 * std::sqrt(2.0 * std::numbers::pi / (std::sqrt(3.0) * count))) << count;
    EXPECT_NEAR(squares / count, 0.5, 0.03) << "not evenly spread";
  }
}

TEST(GatherPattern, PolarIsThePapersFormula) {
  const int count = 400;
  const GatherPattern p = make_pattern({.samples = count, .pattern = SamplePattern::polar});
  ASSERT_EQ(p.x.size(), 400U);
  ASSERT_EQ(p.weight.size(), 400U);
  double sum = 0.0;
  for (std::uint32_t i = 0; i < 400; ++i) {
    const double xi1 = (i + 0.5) / count;
    double xi2 = 0.0;
    for (int bit = 0; bit < 16; ++bit) xi2 += (i >> bit & 1U) != 0 ? std::pow(0.5, bit + 1) : 0.0;
    EXPECT_NEAR(p.x[i], xi1 * std::sin(2.0 * std::numbers::pi * xi2), 1e-7);
    EXPECT_NEAR(p.y[i], xi1 * std::cos(2.0 * std::numbers::pi * xi2), 1e-7);
    EXPECT_NEAR(p.weight[i], xi1 * xi1, 1e-7);
    sum += p.weight[i];
  }
  EXPECT_NEAR(p.total_weight(), sum, 1e-9);
  EXPECT_NEAR(sum / count, 1.0 / 3.0, 1e-5);
}

TEST(GatherPattern, TurnsAreUnitVectorsInAllDirections) {
  std::array<int, 8> octants{};
  for (std::uint32_t y = 0; y < 64; ++y) {
    for (std::uint32_t x = 0; x < 64; ++x) {
      const glm::vec2 turn = pixel_turn(x, y);
      ASSERT_NEAR(std::hypot(turn.x, turn.y), 1.0F, 1e-6F);
      const double angle = std::atan2(turn.y, turn.x) + std::numbers::pi;
      ++octants[static_cast<std::size_t>(std::min(7.0, angle * 4.0 / std::numbers::pi))];
    }
  }
  // 512 each, with a standard deviation of 21.
  for (const int count : octants) EXPECT_NEAR(count, 512, 110);
  EXPECT_EQ(pixel_turn(17, 5), pixel_turn(17, 5));
  EXPECT_NE(pixel_turn(17, 5), pixel_turn(5, 17));
}

PixelLights random_lights(int size, std::mt19937& random) {
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  PixelLights lights{.size = size};
  lights.values.resize(static_cast<std::size_t>(size * size) * PixelLights::kStride);
  for (std::size_t i = 0; i < lights.values.size(); i += PixelLights::kStride) {
    const glm::vec3 normal = glm::normalize(glm::vec3(unit(random), unit(random), unit(random) + 0.01F));
    for (std::size_t c = 0; c < 3; ++c) {
      lights.values[i + c] = unit(random) * 2.0F;
      lights.values[i + 3 + c] = normal[static_cast<glm::length_t>(c)];
      lights.values[i + 6 + c] = std::fabs(unit(random));
    }
  }
  return lights;
}

Receivers random_receivers(float size, std::mt19937& random) {
  std::uniform_real_distribution<float> unit(-1.0F, 1.0F);
  Receivers r;
  for (std::size_t lane = 0; lane < Receivers::kCapacity; ++lane) {
    const glm::vec3 normal = glm::normalize(glm::vec3(unit(random), unit(random), unit(random) + 0.01F));
    for (std::size_t c = 0; c < 3; ++c) {
      r.position[c][lane] = unit(random) * 2.0F;
      r.normal[c][lane] = normal[static_cast<glm::length_t>(c)];
    }
    r.s[lane] = (unit(random) * 0.75F + 0.5F) * size;
    r.t[lane] = (unit(random) * 0.75F + 0.5F) * size;
    const glm::vec2 turn = pixel_turn(static_cast<std::uint32_t>(lane), 3);
    r.cosine[lane] = turn.x;
    r.sine[lane] = turn.y;
  }
  return r;
}

// The text's loop over its samples, in doubles. A place that lies so near a texel's edge that floats may take the other
// texel makes the answer useless: empty.
std::optional<glm::dvec3> naive(const PixelLights& lights, const GatherPattern& p, double kernel, const Receivers& r,
                                std::size_t lane) {
  const glm::dvec3 x(r.position[0][lane], r.position[1][lane], r.position[2][lane]);
  const glm::dvec3 n(r.normal[0][lane], r.normal[1][lane], r.normal[2][lane]);
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < p.x.size(); ++i) {
    const double offset_x = double{r.cosine[lane]} * p.x[i] - double{r.sine[lane]} * p.y[i];
    const double offset_y = double{r.sine[lane]} * p.x[i] + double{r.cosine[lane]} * p.y[i];
    const double u = r.s[lane] + offset_x * kernel, v = r.t[lane] + offset_y * kernel;
    if (std::fabs(u - std::round(u)) < 1e-4 || std::fabs(v - std::round(v)) < 1e-4) return std::nullopt;
    if (u < 0.0 || v < 0.0 || u >= lights.size || v >= lights.size) continue;
    const std::size_t texel =
        static_cast<std::size_t>(v) * static_cast<std::size_t>(lights.size) + static_cast<std::size_t>(u);
    const float* const l = &lights.values[texel * PixelLights::kStride];
    const glm::dvec3 xp(l[0], l[1], l[2]), np(l[3], l[4], l[5]), flux(l[6], l[7], l[8]);
    const double weight = p.kind == SamplePattern::poisson ? offset_x * offset_x : double{p.weight[i]};
    sum += weight * flux * std::max(0.0, glm::dot(np, x - xp)) * std::max(0.0, glm::dot(n, xp - x)) /
           std::pow(glm::length(x - xp), 4.0);
  }
  return sum;
}

TEST(Gather, IsTheFormulaOnEverySimdTarget) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "a build with sanitizers has one SIMD target";
  constexpr int kSize = 64;
  std::mt19937 random(20);
  const PixelLights lights = random_lights(kSize, random);
  for (const SamplePattern kind : {SamplePattern::poisson, SamplePattern::polar}) {
    const GatherPattern pattern = make_pattern({.samples = 96, .pattern = kind});
    for (int round = 0; round < 4; ++round) {
      const Receivers given = random_receivers(kSize, random);
      const std::size_t count = round == 0 ? 5 : Receivers::kCapacity;
      std::optional<Receivers> first;
      int compared = 0;
      for (const std::int64_t target : test::simd_targets()) {
        const test::OnTarget on(target);
        Receivers r = given;
        gather(lights, pattern, 20.0F, count, r);
        ASSERT_TRUE(on.ran());
        for (std::size_t lane = 0; lane < count; ++lane) {
          const auto expected = naive(lights, pattern, 20.0, r, lane);
          for (std::size_t c = 0; c < 3; ++c) {
            if (first) {
              ASSERT_EQ(std::bit_cast<std::uint32_t>(r.irradiance[c][lane]),
                        std::bit_cast<std::uint32_t>(first->irradiance[c][lane]))
                  << test::simd_target_name(target);
            }
            if (!expected) continue;
            ++compared;
            const double e = (*expected)[static_cast<glm::length_t>(c)];
            ASSERT_NEAR(r.irradiance[c][lane], e, 2e-4 * e + 1e-6);
          }
        }
        if (!first) first = r;
      }
      EXPECT_GT(compared, 0);
    }
  }
}

// One light at the origin that shines along +y, and a receiver.
float received(const glm::vec3& position, const glm::vec3& normal, float s = 0.5F) {
  const PixelLights lights{.size = 1, .values = {0, 0, 0, 0, 1, 0, 0.5F, 0.25F, 0}};
  const GatherPattern pattern{.kind = SamplePattern::polar, .x = {0.0F}, .y = {0.0F}, .weight = {1.0F}};
  Receivers r;
  for (std::size_t c = 0; c < 3; ++c) {
    r.position[c][0] = position[static_cast<glm::length_t>(c)];
    r.normal[c][0] = normal[static_cast<glm::length_t>(c)];
  }
  r.s[0] = s;
  r.t[0] = 0.5F;
  r.cosine[0] = 1.0F;
  gather(lights, pattern, 10.0F, 1, r);
  EXPECT_EQ(r.irradiance[1][0], 0.5F * r.irradiance[0][0]);
  EXPECT_EQ(r.irradiance[2][0], 0.0F);
  return r.irradiance[0][0];
}

TEST(Gather, FourthPowerWithUnnormalizedDifferences) {
  EXPECT_FLOAT_EQ(received({0, 1, 0}, {0, -1, 0}), 0.5F);
  EXPECT_FLOAT_EQ(received({0, 2, 0}, {0, -1, 0}), 0.5F / 4.0F);
  EXPECT_FLOAT_EQ(received({3, 4, 0}, {-0.6F, -0.8F, 0}), 0.5F * 0.8F / 25.0F);
  EXPECT_FLOAT_EQ(received({3, 4, 0}, {-1, 0, 0}), 0.5F * 0.8F * 0.6F / 25.0F);
}

TEST(Gather, NothingFromBehindBesideOrTheSamePlace) {
  EXPECT_EQ(received({0, -1, 0}, {0, 1, 0}), 0.0F) << "behind the light";
  EXPECT_EQ(received({0, 1, 0}, {0, 1, 0}), 0.0F) << "the receiver looks away";
  EXPECT_EQ(received({1, 0, 0}, {-1, 0, 0}), 0.0F) << "in the light's own plane";
  EXPECT_EQ(received({0, 0, 0}, {0, -1, 0}), 0.0F) << "at the light";
  EXPECT_EQ(received({0, 1e-8F, 0}, {0, -1, 0}), 0.0F) << "nearer than half floats can tell";
  EXPECT_EQ(received({0, 1, 0}, {0, 0, 0}), 0.0F) << "no normal";
  for (const float outside : {-0.001F, 1.0F, 1e30F, -INFINITY, NAN}) {
    EXPECT_EQ(received({0, 1, 0}, {0, -1, 0}, outside), 0.0F) << outside;
  }
}

TEST(Gather, WholeMapIsTheSumOverAllTexels) {
  std::mt19937 random(7);
  const PixelLights lights = random_lights(8, random);
  // Each texel by itself as a sample of weight 1 at its middle.
  GatherPattern all{.kind = SamplePattern::polar, .x = {}, .y = {}};
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      all.x.push_back((static_cast<float>(x) + 0.5F) / 8.0F);
      all.y.push_back((static_cast<float>(y) + 0.5F) / 8.0F);
      all.weight.push_back(1.0F);
    }
  }
  Receivers r = random_receivers(8.0F, random);
  for (std::size_t lane = 0; lane < Receivers::kCapacity; ++lane) {
    r.s[lane] = r.t[lane] = r.sine[lane] = 0.0F;
    r.cosine[lane] = 1.0F;
  }
  gather(lights, all, 8.0F, Receivers::kCapacity, r);
  int reached = 0;
  for (std::size_t lane = 0; lane < Receivers::kCapacity; ++lane) {
    const glm::dvec3 whole =
        whole_map_irradiance(lights, {r.position[0][lane], r.position[1][lane], r.position[2][lane]},
                             {r.normal[0][lane], r.normal[1][lane], r.normal[2][lane]});
    if (whole.x > 0.0) ++reached;
    for (std::size_t c = 0; c < 3; ++c) {
      const double expected = whole[static_cast<glm::length_t>(c)];
      EXPECT_NEAR(r.irradiance[c][lane], expected, 1e-4 * expected);
    }
  }
  EXPECT_GT(reached, 40);
}

}  // namespace

// The depth cube on scenes whose answer is a formula.
#include "ninebit/shadow/depth_cube.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "combiner_tests/shadow/depth_cube_support.h"
#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/slow_build.h"

namespace {

using namespace ninebit;
using shadow_test::depth_cube_settings;
using shadow_test::draw_depth_cube;
using shadow_test::for_each_pixel;
using shadow_test::on_plane;
using shadow_test::samples_of;

constexpr std::array kAllBits{DepthCubeBits::eight, DepthCubeBits::sixteen, DepthCubeBits::real};

const std::vector<std::uint32_t>& objects(const Rendering& r) {
  return samples_of<std::uint32_t>(r.layers, "object", "object");
}

// Pixels of the floor of square_over_floor, away from the shadow's edge by more than one and a half texels of the map:
// how many there are inside and outside of the shadow, and how many of them are on the wrong side.
struct Judged {
  int inside = 0, outside = 0, false_lit = 0, false_shadowed = 0;
};
Judged judge_square(const Scene& scene, const RenderSettings& settings, const Rendering& r) {
  const float texel = 6.0F / static_cast<float>(settings.map_size) * 1.5F;
  Judged judged;
  for_each_pixel(settings, [&](int x, int y, std::size_t i) {
    if (objects(r)[i] != 1) return;
    const glm::vec3 p = on_plane(scene, settings, x, y, 0.0F);
    const float reach = std::max(std::fabs(p.x), std::fabs(p.z));
    if (std::fabs(reach - 1.5F) < texel) return;
    const bool dark = r.frame.stencil()[i] != 0;
    ++(reach < 1.5F ? judged.inside : judged.outside);
    judged.false_lit += reach < 1.5F && !dark ? 1 : 0;
    judged.false_shadowed += reach > 1.5F && dark ? 1 : 0;
  });
  return judged;
}

// The floor reaches across five faces of the map.
TEST(DepthCube, SquareOverFloorCastsTheSquareOfTheFormula) {
  const Scene scene = shadow_test::square_over_floor(6.0F);
  for (const DepthCubeBits bits : kAllBits) {
    const RenderSettings settings = depth_cube_settings(bits);
    const Rendering r = draw_depth_cube(scene, settings);
    const Judged judged = judge_square(scene, settings, r);
    EXPECT_GT(judged.inside, 1000);
    EXPECT_GT(judged.outside, 3000);
    EXPECT_EQ(judged.false_lit, 0);
    EXPECT_EQ(judged.false_shadowed, 0);
    // The square itself is what the light sees.
    for (std::size_t i = 0; i < r.frame.stencil().size(); ++i) {
      if (objects(r)[i] == 2) {
        ASSERT_EQ(r.frame.stencil()[i], 0);
      }
    }
    EXPECT_EQ(r.background + r.lit + r.shadowed, r.frame.stencil().size());
  }
}

TEST(DepthCube, WithoutBiasThereIsAcne) {
  const Scene scene = shadow_test::square_over_floor(6.0F);
  for (const DepthCubeBits bits : kAllBits) {
    RenderSettings settings = depth_cube_settings(bits);
    settings.depth_cube.bias = 0.0F;
    const Judged judged = judge_square(scene, settings, draw_depth_cube(scene, settings));
    EXPECT_GT(judged.false_shadowed, 100);
    EXPECT_EQ(judged.false_lit, 0);
  }
}

// A room of side 6 around the light, and half-way to each wall a square of side 1, which casts one of side 2. The
// camera stands behind each of the squares in turn.
TEST(DepthCube, EachFaceOfTheMapCastsItsShadow) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  constexpr std::array kAxes{glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1)};
  const glm::vec3 light(0.4F, -0.7F, 0.2F);
  for (const DepthCubeBits bits : kAllBits) {
    for (std::size_t face = 0; face < 6; ++face) {
      const glm::vec3 toward = kAxes[face / 2] * (face % 2 == 0 ? 1.0F : -1.0F);
      Scene scene = shadow_test::scene_with(light + toward * 1.7F, light + toward * 3.0F, light);
      scene.cameras[0].up = kAxes[(face / 2 + 2) % 3];
      scene.cameras[0].vertical_fov_degrees = 90.0F;
      for (const float side : {1.5F, 3.0F}) {
        const float half = side == 3.0F ? 3.0F : 0.5F;
        for (std::size_t f = 0; f < 6; ++f) {
          const glm::vec3 middle = light + kAxes[f / 2] * (f % 2 == 0 ? side : -side);
          const glm::vec3 a = kAxes[(f / 2 + 1) % 3] * half, b = kAxes[(f / 2 + 2) % 3] * half;
          shadow_test::add_quad(scene, "square", {{middle - a - b, middle + a - b, middle + a + b, middle - a + b}});
        }
      }
      RenderSettings settings = depth_cube_settings(bits);
      settings.width = settings.height = 80;
      const Rendering r = draw_depth_cube(scene, settings);
      const float texel = 6.0F / static_cast<float>(settings.map_size);
      int inside = 0, outside = 0;
      for (int y = 0; y < 80; ++y) {
        for (int x = 0; x < 80; ++x) {
          const auto on_wall = [](int pixel) { return ((static_cast<float>(pixel) + 0.5F) / 40.0F - 1.0F) * 1.3F; };
          const float reach = std::max(std::fabs(on_wall(x)), std::fabs(on_wall(y)));
          if (std::fabs(reach - 1.0F) < texel) continue;
          ++(reach < 1.0F ? inside : outside);
          ASSERT_EQ(r.frame.stencil()[static_cast<std::size_t>(y * 80 + x)] != 0, reach < 1.0F)
              << "face " << face << " at " << x << "," << y;
        }
      }
      EXPECT_GT(inside, 2000);
      EXPECT_GT(outside, 1500);
    }
  }
}

// A slope that rises from the floor, which the camera sees from below: where they are close, codes run together and the
// shadow is lost; the fewer bits, the more of it. How much a code loses depends on where its steps fall, so the light
// stands at a few heights within one step.
TEST(DepthCube, MoreBitsLoseLessOfACloseShadow) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  std::array<int, 3> lost{};
  for (int k = 0; k < 4; ++k) {
    const float height = 3.0F + 0.003F * static_cast<float>(k);
    Scene scene = shadow_test::scene_with({0.0F, -3.0F, 2.0F}, {0.0F, 0.0F, 0.0F}, {0.0F, height, 0.0F});
    shadow_test::add_quad(scene, "floor", {{{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}}});
    shadow_test::add_quad(scene, "slope", {{{-1, 0.001F, 1}, {1, 0.2F, 1}, {1, 0.2F, -1}, {-1, 0.001F, -1}}});
    std::array<PlaneSamples<std::uint8_t>, 3> stencil;
    for (std::size_t b = 0; b < 3; ++b) {
      RenderSettings settings = depth_cube_settings(kAllBits[b]);
      settings.depth_cube.bias = 0.01F;
      const Rendering r = draw_depth_cube(scene, settings);
      stencil[b] = r.frame.stencil();
      for_each_pixel(settings, [&](int x, int y, std::size_t i) {
        if (objects(r)[i] != 1) return;
        const glm::vec3 p = on_plane(scene, settings, x, y, 0.0F);
        // Where the ray from the light to p crosses the slope's plane, 0.1005 + 0.0995 x above the floor.
        const float part = (height - 0.1005F) / (height + 0.0995F * p.x);
        const bool shadowed = std::fabs(p.x * part) < 1.0F && std::fabs(p.z * part) < 1.0F;
        lost[b] += shadowed && r.frame.stencil()[i] == 0 ? 1 : 0;
      });
    }
    for (std::size_t i = 0; i < stencil[2].size(); ++i) {
      // Each pixel that a code shadows is shadowed by the floats, too.
      ASSERT_LE(stencil[0][i], stencil[2][i]) << i;
      ASSERT_LE(stencil[1][i], stencil[2][i]) << i;
    }
  }
  EXPECT_GT(lost[0], lost[1] + 100);
  EXPECT_GE(lost[1], lost[2]);
  EXPECT_GT(lost[2], 0);
}

// Both techniques show the same shadows, but within a few pixels of a shadow's or an object's edge.
TEST(DepthCube, AgreesWithTheIndexCubeByObject) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  Scene wall = shadow_test::scene_with({1.0F, 2.0F, 3.0F}, {0.0F, 0.0F, -3.0F}, {0.3F, 0.2F, 2.0F});
  const auto frame_quad = [&](float left, float bottom, float right, float top) {
    shadow_test::add_quad(wall, "wall", {{{left, bottom, 0}, {right, bottom, 0}, {right, top, 0}, {left, top, 0}}});
  };
  frame_quad(-2, -2, -0.5F, 2);
  frame_quad(0.5F, -2, 2, 2);
  frame_quad(-0.5F, -2, 0.5F, -0.5F);
  frame_quad(-0.5F, 0.5F, 0.5F, 2);
  wall.objects.assign(1, {"wall with a hole", 0, 8});
  wall.triangle_object.assign(8, 0);
  shadow_test::add_quad(wall, "back", {{{-6, -5, -3}, {6, -5, -3}, {6, 5, -3}, {-6, 5, -3}}});
  for (const Scene& scene : {shadow_test::square_over_floor(), wall}) {
    for (const DepthCubeBits bits : kAllBits) {
      RenderSettings settings = depth_cube_settings(bits);
      settings.index.scope = IndexScope::object;
      const Rendering by_index = shadow_test::render(scene, settings), by_depth = draw_depth_cube(scene, settings);
      const auto uniform = [&](int x, int y) {
        for (int dy = -3; dy <= 3; ++dy) {
          for (int dx = -3; dx <= 3; ++dx) {
            const auto i = static_cast<std::size_t>(y * settings.width + x);
            const auto j = static_cast<std::size_t>((y + dy) * settings.width + x + dx);
            if (objects(by_index)[i] != objects(by_index)[j]) return false;
            if (by_index.frame.stencil()[i] != by_index.frame.stencil()[j]) return false;
          }
        }
        return true;
      };
      int compared = 0, dark = 0;
      for (int y = 3; y < settings.height - 3; ++y) {
        for (int x = 3; x < settings.width - 3; ++x) {
          const auto i = static_cast<std::size_t>(y * settings.width + x);
          if (objects(by_index)[i] == 0 || !uniform(x, y)) continue;
          ++compared;
          dark += by_index.frame.stencil()[i];
          ASSERT_EQ(by_depth.frame.stencil()[i], by_index.frame.stencil()[i]) << x << "," << y;
        }
      }
      EXPECT_GT(compared, 7000);
      EXPECT_GT(dark, 800);
    }
  }
}

TEST(DepthCube, BadSettingsAreReported) {
  const Scene scene = shadow_test::square_over_floor();
  const auto message = [&](const Scene& of, const RenderSettings& settings) {
    const auto r = render_depth_cube(of, settings, {});
    return r.ok() ? std::string() : r.error().message;
  };
  RenderSettings settings = depth_cube_settings(DepthCubeBits::eight);
  settings.depth_cube.bias = -0.5F;
  EXPECT_EQ(message(scene, settings), "bias -0.5 is out of range; expected a finite distance of 0 or more");
  settings.depth_cube.bias = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(message(scene, settings), "bias nan is out of range; expected a finite distance of 0 or more");
  settings.depth_cube.bias.reset();
  settings.map_size = 96;
  EXPECT_NE(message(scene, settings).find("map size 96"), std::string::npos);
  settings.map_size = 64;
  Scene directional = scene;
  directional.lights[0].kind = LightKind::directional;
  EXPECT_NE(message(directional, settings).find("expected a point light"), std::string::npos);
  // A bias beyond the whole range shadows nothing.
  settings.depth_cube.bias = 1e30F;
  EXPECT_EQ(draw_depth_cube(scene, settings).shadowed, 0U);
}

}  // namespace

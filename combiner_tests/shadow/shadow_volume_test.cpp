// Shadow volumes where a formula says what is in shadow.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "combiner_tests/shadow/volume_support.h"
#include "combiner_tests/support/slow_build.h"

namespace {

using namespace ninebit;
using shadow_test::for_each_pixel;
using namespace shadow_test;

constexpr VolumeMethod kMethods[] = {VolumeMethod::depth_fail, VolumeMethod::depth_pass};

// Calls check(settings) for both methods, with two-sided stencil and without.
template <class Check>
void in_every_way(Check check) {
  for (const VolumeMethod method : kMethods) {
    for (const bool two_sided : {true, false}) {
      RenderSettings settings = volume_settings(method);
      settings.shadow_volume.two_sided = two_sided;
      check(settings);
    }
  }
}

// Compares the pixels that show the plane y = height, upon the triangles from `first` to `last`, with a formula of x
// and z; leaves out those at whose corners it says something else.
template <class Formula>
void expect_plane(const Scene& scene, RenderSettings settings, float height, std::uint32_t first, std::uint32_t last,
                  int least, Formula is_shadowed) {
  settings.layers = true;
  const Rendering r = render_volumes(scene, settings);
  int lit = 0, shadowed = 0, wrong = 0;
  for_each_pixel(settings, [&](int x, int y, std::size_t at) {
    const std::uint32_t triangle = r.frame.primitive()[at];
    if (triangle < first || triangle > last) return;
    int corners = 0;
    for (const int dx : {0, 1}) {
      for (const int dy : {0, 1}) {
        RenderSettings twice = settings;  // its pixels' centres lie a quarter of a pixel off
        twice.width *= 2;
        twice.height *= 2;
        const glm::vec3 p = on_plane(scene, twice, 2 * x + dx, 2 * y + dy, height);
        corners += is_shadowed(p.x, p.z) ? 1 : 0;
      }
    }
    if (corners != 0 && corners != 4) return;
    ++(corners == 4 ? shadowed : lit);
    if ((r.frame.stencil()[at] != 0) != (corners == 4)) ++wrong;
  });
  EXPECT_EQ(wrong, 0);
  EXPECT_GT(lit, least);
  EXPECT_GT(shadowed, least);
}

TEST(ShadowVolume, SquareOverFloorIsExact) {
  const Scene scene = square_over_floor();
  in_every_way([&](const RenderSettings& settings) {
    expect_plane(scene, settings, 0.0F, 0, 1, 300,
                 [](float x, float z) { return std::fabs(x) < 1.5F && std::fabs(z) < 1.5F; });
    const Rendering r = render_volumes(scene, settings);
    const bool has_caps = settings.shadow_volume.method == VolumeMethod::depth_fail;
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "open_objects"), 2U);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "closed_objects"), 0U);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "open_edges"), 8U);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "nonmanifold_edges"), 0U);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "silhouette_edges"), 8U);  // the diagonals' sides cancel
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "volume_triangles"), has_caps ? 4U + 4U + 16U : 16U);
  });
}

// The same square the other way up casts the same shadow, and its lit side stays lit.
TEST(ShadowVolume, WindingOfASheetDoesNotMatter) {
  const Scene scene = square_over_floor();
  Scene turned = scene;
  for (glm::uvec3& t : turned.triangles) std::swap(t.y, t.z);
  in_every_way([&](const RenderSettings& settings) {
    EXPECT_EQ(render_volumes(turned, settings).frame.stencil(), render_volumes(scene, settings).frame.stencil());
  });
}

// A low box, as a closed object: of its six sides the top alone faces the light.
TEST(ShadowVolume, BoxOverFloorIsExact) {
  Scene scene = square_over_floor();
  scene.objects.resize(1);
  for (auto* list : {&scene.triangle_object, &scene.triangle_material}) list->resize(2);
  scene.triangles.resize(2);
  add_box(scene, "box", {-1, 0.75F, -1}, {1, 1, 1});
  in_every_way([&](const RenderSettings& settings) {
    expect_plane(scene, settings, 0.0F, 0, 1, 300,
                 [](float x, float z) { return std::fabs(x) < 1.5F && std::fabs(z) < 1.5F; });
    const Rendering r = render_volumes(scene, settings);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "closed_objects"), 1U);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "open_objects"), 1U);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "open_edges"), 4U);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "silhouette_edges"), 4U + 4U);
  });
}

TEST(ShadowVolume, DirectionalLightIsExact) {
  Scene scene = square_over_floor();
  scene.lights[0].kind = LightKind::directional;
  scene.lights[0].direction = glm::normalize(glm::vec3(0.5F, -1.0F, 0.25F));
  in_every_way([&](const RenderSettings& settings) {
    expect_plane(scene, settings, 0.0F, 0, 1, 200,
                 [](float x, float z) { return std::fabs(x - 0.5F) < 1.0F && std::fabs(z - 0.25F) < 1.0F; });
    const Rendering r = render_volumes(scene, settings);
    const bool has_caps = settings.shadow_volume.method == VolumeMethod::depth_fail;
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "volume_triangles"), has_caps ? 4U + 8U : 8U);
  });
}

// The pyramid of a spot light straight down; depth-pass with the eye outside of it, and within.
TEST(ShadowVolume, SpotLightShinesThroughItsPyramid) {
  Scene scene = square_over_floor();
  scene.lights[0].kind = LightKind::spot;
  scene.lights[0].direction = {0.0F, -1.0F, 0.0F};
  const auto is_shadowed_within = [](float reach) {
    return [reach](float x, float z) {
      const float far_out = std::max(std::fabs(x), std::fabs(z));
      return far_out < 1.5F || far_out > reach;
    };
  };
  for (const float reach : {2.0F, 3.0F}) {
    scene.lights[0].spot_degrees = glm::degrees(2 * std::atan(reach / 3.0F));
    in_every_way([&](const RenderSettings& settings) {
      expect_plane(scene, settings, 0.0F, 0, 1, 200, is_shadowed_within(reach));
    });
  }
  scene.lights[0].position = {0.0F, 9.0F, 0.0F};
  scene.lights[0].spot_degrees = 150.0F;
  in_every_way([&](const RenderSettings& settings) {
    expect_plane(scene, settings, 0.0F, 0, 1, 100,
                 [](float x, float z) { return std::max(std::fabs(x), std::fabs(z)) < 1.125F; });
  });
}

// A square hole in a wall between the light and the floor: an open object whose rim has four edges more.
TEST(ShadowVolume, WallWithAHoleIsExact) {
  Scene scene = scene_with({0.5F, 6.0F, 7.0F}, {0.0F, 0.0F, 0.0F}, {0.0F, 3.0F, 0.0F});
  add_quad(scene, "floor", {{{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}}});
  std::vector<glm::vec3> positions;
  for (const float size : {0.25F, 1.0F}) {
    for (const glm::vec2 c : {glm::vec2(-1, 1), glm::vec2(1, 1), glm::vec2(1, -1), glm::vec2(-1, -1)}) {
      positions.emplace_back(c.x * size, 2.0F, c.y * size);
    }
  }
  std::vector<glm::uvec3> triangles;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t next = (i + 1) % 4;
    triangles.emplace_back(i, i + 4, next + 4);
    triangles.emplace_back(i, next + 4, next);
  }
  add_object(scene, positions, triangles);
  in_every_way([&](const RenderSettings& settings) {
    expect_plane(scene, settings, 0.0F, 0, 1, 60, [](float x, float z) {
      const float far_out = std::max(std::fabs(x), std::fabs(z));
      return far_out > 0.75F && far_out < 3.0F;
    });
    const Rendering r = render_volumes(scene, settings);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "open_edges"), 4U + 8U);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "nonmanifold_edges"), 0U);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "silhouette_edges"), 4U + 8U);
  });
}

// A ball within a ball, both closed; the shadow upon the outer one is a circle around the axis through the light.
TEST(ShadowVolume, BallInABall) {
  if (test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  Scene scene = scene_with({-2.0F, 1.0F, 3.0F}, {3.0F, -0.5F, -1.0F}, {-1.0F, 0.5F, 0.0F});
  scene.cameras[0].vertical_fov_degrees = 80.0F;
  add_ball(scene, {0.0F, 0.0F, 0.0F}, 6.0F, 24, true);
  add_ball(scene, {0.75F, 0.0F, -0.25F}, 0.75F, 24);
  const std::uint32_t walls = scene.objects[0].triangle_count;
  const glm::dvec3 light(scene.lights[0].position), middle(0.75, 0.0, -0.25), eye(scene.cameras[0].position);
  const Rays rays(scene);
  const RenderSettings size = volume_settings();
  std::vector<Seen> expected;
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      const glm::dvec3 d = rays.direction(size, x + 0.5, y + 0.5);
      const auto hit = rays.nearest(eye, d);
      ASSERT_TRUE(hit.has_value());
      const glm::dvec3 ray = glm::normalize(eye + d * hit->distance - light);
      const double along = glm::dot(middle - light, ray), off = glm::length(middle - light - along * ray);
      // The facets of the inner ball lie up to 1 % below its sphere.
      const bool is_doubtful = along > 0.0 && std::fabs(off - 0.75 * 0.99) < 0.75 * 0.02;
      expected.push_back(hit->triangle >= walls || is_doubtful ? Seen::near_a_border
                         : along > 0.0 && off < 0.75           ? Seen::shadowed
                                                               : Seen::lit);
    }
  }
  in_every_way([&](RenderSettings settings) {
    settings.layers = true;
    const Rendering r = render_volumes(scene, settings);
    int lit = 0, shadowed = 0, wrong = 0;
    for (std::size_t i = 0; i < expected.size(); ++i) {
      if (expected[i] == Seen::near_a_border || r.frame.primitive()[i] >= walls) continue;
      ++(expected[i] == Seen::shadowed ? shadowed : lit);
      if ((r.frame.stencil()[i] != 0) != (expected[i] == Seen::shadowed)) ++wrong;
    }
    EXPECT_EQ(wrong, 0);
    EXPECT_GT(lit, 3000);
    EXPECT_GT(shadowed, 500);
    EXPECT_EQ(shadow_test::fact<std::uint64_t>(r, "closed_objects"), 2U);
    EXPECT_EQ(
        shadow_test::fact<std::uint64_t>(r, "open_edges") + shadow_test::fact<std::uint64_t>(r, "nonmanifold_edges"),
        0U);
  });
}

// With the eye in the shadow depth-fail is right. Depth-pass misses the side through which the view comes in: what is
// in shadow counts 0, and what is lit -1.
TEST(ShadowVolume, EyeInsideAVolume) {
  if (test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  Scene scene = scene_with({0.25F, 0.8F, 0.25F}, {1.5F, 0.0F, 0.5F}, {0.0F, 3.0F, 0.0F});
  scene.cameras[0].vertical_fov_degrees = 70.0F;
  add_quad(scene, "floor", {{{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}}});
  add_box(scene, "box", {-1, 1.25F, -1}, {1, 1.5F, 1});
  RenderSettings settings = volume_settings();
  const Compared right = compare_with_rays(scene, settings, render_volumes(scene, settings));
  EXPECT_EQ(right.wrong, 0) << right.first_wrong;
  EXPECT_GT(right.lit, 1000);
  EXPECT_GT(right.shadowed, 1000);
  settings.shadow_volume.method = VolumeMethod::depth_pass;
  const Compared wrong = compare_with_rays(scene, settings, render_volumes(scene, settings));
  EXPECT_GT(wrong.wrong, (wrong.lit + wrong.shadowed) * 9 / 10);
}

// 255 sheets one below the other count 255; one more counts 0 in eight bits: light, where there is none. One bit of
// stencil does the same from two sheets on.
TEST(ShadowVolume, CountsWrapAround) {
  const auto sheets = [](int count) {
    Scene scene = scene_with({1.0F, 5.0F, 7.0F}, {0.0F, 0.5F, 0.0F}, {0.0F, 3.0F, 0.0F});
    add_quad(scene, "floor", {{{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}}});
    for (int i = 0; i < count; ++i) {
      const float y = 1.0F + 0.001F * static_cast<float>(i), half = (3.0F - y) * 0.5F;
      add_quad(scene, "sheet", {{{-half, y, half}, {half, y, half}, {half, y, -half}, {-half, y, -half}}});
    }
    return scene;
  };
  // The pixel that shows (0, 0, 1.25), in front of the sheets.
  const auto stencil_at = [](const Scene& scene, const RenderSettings& settings) {
    const Rendering r = render_volumes(scene, settings);
    for (int y = 0; y < settings.height; ++y) {
      for (int x = 0; x < settings.width; ++x) {
        const glm::vec3 p = on_plane(scene, settings, x, y, 0.0F);
        if (std::fabs(p.x) + std::fabs(p.z - 1.25F) < 0.1F) {
          return static_cast<int>(r.frame.stencil()[static_cast<std::size_t>(y * settings.width + x)]);
        }
      }
    }
    return -1;
  };
  in_every_way([&](RenderSettings settings) {
    EXPECT_EQ(stencil_at(sheets(1), settings), 1);
    EXPECT_EQ(stencil_at(sheets(2), settings), 2);
    EXPECT_EQ(stencil_at(sheets(255), settings), 255);
    EXPECT_EQ(stencil_at(sheets(256), settings), 0);
    settings.depth_stencil = DepthStencilFormat::d15s1;
    EXPECT_EQ(stencil_at(sheets(1), settings), 1);
    EXPECT_EQ(stencil_at(sheets(2), settings), 0);
    EXPECT_EQ(stencil_at(sheets(3), settings), 1);
  });
}

}  // namespace

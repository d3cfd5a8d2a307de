// A cube of labelled faces around a light, on walls whose every pixel is known: which face shines where, which way up,
// turned or not.
#include "ninebit/shadow/light_cookie.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "combiner_tests/shadow/cookie_support.h"
#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/scene/scene_io.h"

namespace {

using namespace ninebit;
using shadow_test::cookie_settings;
using shadow_test::render_cookie;

using Color = std::array<int, 3>;
const std::string kFaces[] = {"+X", "-X", "+Y", "-Y", "+Z", "-Z"};
const Color kGrounds[] = {{16, 0, 0}, {0, 16, 16}, {0, 16, 0}, {16, 0, 16}, {0, 0, 16}, {16, 16, 0}};
const Color kInk{41, 40, 41};

// The texel that the lit pass fetched for a point on a wall.
Color fetched_at(const Scene& scene, const RenderSettings& settings, const Rendering& r, const glm::dvec3& point) {
  const glm::ivec2 pixel = shadow_test::pixel_of(scene, settings, point);
  const auto at = static_cast<std::size_t>(pixel.y * settings.width + pixel.x);
  Color color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = shadow_test::codes_of(r, "lit_texture0", "RGB"[c])[at];
  return color;
}

// The face that shines at each of the walls +X -X +Y -Y +Z -Z, told by the ground in its middle.
std::vector<std::string> faces_at_walls(const glm::vec3& degrees) {
  std::vector<std::string> faces;
  for (int wall = 0; wall < 6; ++wall) {
    const Scene scene = shadow_test::walls_around_light(wall);
    RenderSettings settings = cookie_settings();
    settings.light_cookie.rotate_degrees = degrees;
    glm::dvec3 point(scene.lights[0].position);
    point[wall / 2] = static_cast<double>((wall % 2 == 0 ? bounds_of(scene).high : bounds_of(scene).low)[wall / 2]);
    const Color color = fetched_at(scene, settings, render_cookie(scene, settings), point);
    const auto* const found = std::find(std::begin(kGrounds), std::end(kGrounds), color);
    faces.push_back(found == std::end(kGrounds) ? "?" : kFaces[found - std::begin(kGrounds)]);
  }
  return faces;
}

using Faces = std::vector<std::string>;

TEST(LightCookie, EachWallGetsItsFace) {
  EXPECT_EQ(faces_at_walls({0, 0, 0}), (Faces{"+X", "-X", "+Y", "-Y", "+Z", "-Z"}));
}

// A quarter turn about x takes +Y to +Z, one about y takes +Z to +X, one about z takes +X to +Y.
TEST(LightCookie, QuarterTurnsMoveTheFaces) {
  EXPECT_EQ(faces_at_walls({90, 0, 0}), (Faces{"+X", "-X", "-Z", "+Z", "+Y", "-Y"}));
  EXPECT_EQ(faces_at_walls({0, 90, 0}), (Faces{"+Z", "-Z", "+Y", "-Y", "-X", "+X"}));
  EXPECT_EQ(faces_at_walls({0, 0, 90}), (Faces{"-Y", "+Y", "+X", "-X", "+Z", "-Z"}));
  // About x first: +Y goes to +Z, and from there about y to +X.
  EXPECT_EQ(faces_at_walls({90, 90, 0})[0], "+Y");
  EXPECT_EQ(faces_at_walls({-90, 0, 90}), (Faces{"-Z", "+Z", "+X", "-X", "-Y", "+Y"}));
}

// The figure's axes: T goes toward -Y on the four sides, so that what stands at t = 0 is up; S as in the table of
// ARB_texture_cube_map. The arrow lies at (1/2, 3/16), and points to t = 0; the square about (1/16, 1/16).
TEST(LightCookie, FacesStandAsInTheFigure) {
  struct Face {
    glm::dvec3 major, s, t;
  };
  const Face faces[] = {{{1, 0, 0}, {0, 0, -1}, {0, -1, 0}}, {{-1, 0, 0}, {0, 0, 1}, {0, -1, 0}},
                        {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}},   {{0, -1, 0}, {1, 0, 0}, {0, 0, -1}},
                        {{0, 0, 1}, {1, 0, 0}, {0, -1, 0}},  {{0, 0, -1}, {-1, 0, 0}, {0, -1, 0}}};
  for (int wall = 0; wall < 6; ++wall) {
    SCOPED_TRACE(kFaces[wall]);
    const Face& face = faces[wall];
    const Scene scene = shadow_test::walls_around_light(wall);
    const RenderSettings settings = cookie_settings();
    const Rendering r = render_cookie(scene, settings);
    const glm::dvec3 light(scene.lights[0].position);
    const Bounds bounds = bounds_of(scene);
    const double plane = static_cast<double>((wall % 2 == 0 ? bounds.high : bounds.low)[wall / 2]);
    const double distance = std::fabs(plane - light[wall / 2]);
    int seen = 0;
    const auto expect = [&](double s, double t, const Color& color) {
      const glm::dvec3 direction = face.major + face.s * (2.0 * s - 1.0) + face.t * (2.0 * t - 1.0);
      const glm::dvec3 point = light + direction * distance;
      const glm::ivec2 pixel = shadow_test::pixel_of(scene, settings, point);
      const bool in_view = pixel.x >= 0 && pixel.y >= 0 && pixel.x < settings.width && pixel.y < settings.height;
      const bool on_wall = glm::all(glm::lessThan(point, glm::dvec3(bounds.high) + 1e-6)) &&
                           glm::all(glm::greaterThan(point, glm::dvec3(bounds.low) - 1e-6));
      if (!in_view || !on_wall) return;
      ++seen;
      EXPECT_EQ(fetched_at(scene, settings, r, point), color) << "s " << s << ", t " << t;
    };
    expect(0.5, 3.0 / 16.0, kInk);
    expect(0.5, 13.0 / 16.0, kGrounds[wall]);
    expect(3.0 / 16.0, 0.5, kGrounds[wall]);
    expect(1.0 / 16.0, 1.0 / 16.0, kInk);
    expect(15.0 / 16.0, 1.0 / 16.0, kGrounds[wall]);
    expect(1.0 / 16.0, 15.0 / 16.0, kGrounds[wall]);
    EXPECT_GE(seen, 3);
  }
}

// Every pixel of every wall, away from where the cookie's colours meet, against trigonometry and the table.
TEST(LightCookie, EveryPixelFetchesTheTexelOfItsDirection) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const auto cookie = shadow_test::labels();
  for (const glm::vec3& degrees : {glm::vec3(0, 0, 0), glm::vec3(90, 0, 0), glm::vec3(0, 90, 0), glm::vec3(0, 0, 90),
                                   glm::vec3(180, -90, 450), glm::vec3(30, 45, 60), glm::vec3(-12.5F, 200, 77)}) {
    std::set<Color> seen;
    int checked = 0;
    for (int wall = 0; wall < 6; ++wall) {
      const Scene scene = shadow_test::walls_around_light(wall);
      RenderSettings settings = cookie_settings();
      settings.width = 120;
      settings.height = 90;
      settings.light_cookie.rotate_degrees = degrees;
      const Rendering r = render_cookie(scene, settings);
      for (const Layer& layer : r.layers) {
        if (layer.part != "object") continue;
        const auto& object = std::get<std::vector<std::uint32_t>>(layer.samples);
        for (std::size_t i = 0; i < object.size(); ++i) {
          if (object[i] == 0) continue;
          const int x = static_cast<int>(i) % settings.width, y = static_cast<int>(i) / settings.width;
          const glm::dvec3 point = shadow_test::on_wall(scene, settings, x, y, static_cast<int>(object[i]) - 1);
          const auto expected = shadow_test::even_texel(
              *cookie, shadow_test::in_light_space(point - glm::dvec3(scene.lights[0].position), glm::dvec3(degrees)));
          if (!expected) continue;
          ++checked;
          seen.insert(*expected);
          for (std::size_t c = 0; c < 3; ++c) {
            ASSERT_EQ(shadow_test::codes_of(r, "lit_texture0", "RGB"[c])[i], (*expected)[c])
                << "degrees " << degrees.x << ' ' << degrees.y << ' ' << degrees.z << ", wall " << wall << ", pixel "
                << x << ' ' << y;
          }
        }
      }
    }
    EXPECT_GT(checked, 6 * 120 * 90 / 2);
    EXPECT_EQ(seen.size(), 7U) << "six grounds and the ink";
  }
}

// Of 16 x 16 texels a face that go through all bytes.
std::shared_ptr<const Texture> all_bytes() {
  std::vector<std::vector<TextureSamples>> faces;
  for (int face = 0; face < 6; ++face) {
    std::vector<std::uint8_t> samples;
    for (int i = 0; i < 3 * 256; ++i) samples.push_back(static_cast<std::uint8_t>(i * (face + 1) / 2));
    faces.push_back({TextureSamples{16, 16, std::move(samples)}});
  }
  return std::make_shared<Texture>(*make_texture(TextureTarget::cube_map, InternalFormat::rgb8, std::move(faces)));
}

TEST(LightCookie, ColorsAreSixTimesDiffuseTimesCookiePlusAmbient) {
  const Scene scene = shadow_test::walls_around_light(4);
  RenderSettings settings = cookie_settings();
  settings.light_cookie.cookie = all_bytes();
  const Rendering r = render_cookie(scene, settings);
  int cut = 0, between = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const char channel = "RGB"[c];
    const auto& primary = shadow_test::codes_of(r, "lit_primary", channel);
    const auto& texel = shadow_test::codes_of(r, "lit_texture0", channel);
    const auto& secondary = shadow_test::codes_of(r, "lit_secondary", channel);
    const auto& output = shadow_test::codes_of(r, "lit_output", channel);
    for (std::size_t i = 0; i < primary.size(); ++i) {
      if (r.frame.depth()[i] == max_depth(r.frame.format())) continue;
      const double light = std::min(6.0 * primary[i] * texel[i] / 255.0, 255.0);
      ASSERT_EQ(secondary[i], 56);  // 0.22 of white
      ASSERT_NEAR(output[i], std::min(light + 56.0, 255.0), 1.0) << i;
      ASSERT_EQ(r.frame.color(static_cast<int>(c))[i], output[i]);
      cut += output[i] == 255 ? 1 : 0;
      between += output[i] > 56 && output[i] < 255 ? 1 : 0;
    }
  }
  EXPECT_GT(cut, 1000);
  EXPECT_GT(between, 1000);
  EXPECT_EQ(r.shadowed, 0U);
  EXPECT_EQ(r.background, 0U);
  EXPECT_TRUE(r.index_map.empty());
}

// The index cube's shadows, to the pixel, and ambient light in them.
TEST(LightCookie, ShadowsAreThoseOfIndexCube) {
  const Scene scene = shadow_test::square_over_floor();
  for (const bool facing : {false, true}) {
    RenderSettings settings = cookie_settings();
    settings.light_cookie.shadows = true;
    settings.light_facing = facing;
    const Rendering r = render_cookie(scene, settings);
    const Rendering index = shadow_test::render(scene, settings);
    ASSERT_EQ(r.frame.stencil(), index.frame.stencil());
    ASSERT_EQ(r.shadowed, index.shadowed);
    ASSERT_GT(r.shadowed, 300U);
    ASSERT_GT(r.lit, 5000U);
    for (std::size_t f = 0; f < 6; ++f) ASSERT_EQ(r.index_map[f].samples, index.index_map[f].samples);
    for (std::size_t i = 0; i < r.frame.stencil().size(); ++i) {
      if (r.frame.stencil()[i] == 0) continue;
      for (int c = 0; c < 3; ++c) ASSERT_EQ(r.frame.color(c)[i], 56);
    }
  }
}

// Flat light on each polygon, and the ink of index-cube's cartoon.
TEST(LightCookie, ACartoonIsFlatAndItsShadowsAreInk) {
  const Scene scene = shadow_test::square_over_floor();
  RenderSettings settings = cookie_settings();
  settings.light_cookie.shadows = true;
  settings.cartoon = true;
  const Rendering r = render_cookie(scene, settings);
  const Rendering index = shadow_test::render(scene, settings);
  ASSERT_EQ(r.frame.stencil(), index.frame.stencil());
  std::set<int> lights;
  const auto& primary = shadow_test::codes_of(r, "lit_primary", 'R');
  for (std::size_t i = 0; i < primary.size(); ++i) {
    if (r.frame.stencil()[i] != 0) {
      for (int c = 0; c < 3; ++c) ASSERT_EQ(r.frame.color(c)[i], index.frame.color(c)[i]);
    } else if (r.frame.depth()[i] != max_depth(r.frame.format())) {
      lights.insert(primary[i]);
    }
  }
  EXPECT_GE(lights.size(), 2U);
  EXPECT_LE(lights.size(), scene.triangles.size());
}

TEST(LightCookie, AWatchedPixelShowsItsPasses) {
  const Scene scene = shadow_test::square_over_floor();
  RenderSettings settings = cookie_settings();
  settings.layers = false;
  settings.pixels = {glm::ivec2(60, 20)};
  const auto names = [&] {
    Faces found;
    const Rendering drawn = render_cookie(scene, settings);
    for (const ProbedPass& pass : drawn.probed[0]) found.push_back(pass.name);
    return found;
  };
  EXPECT_EQ(names(), (Faces{"depth", "lit", "shadow"}));
  settings.light_cookie.shadows = true;
  EXPECT_EQ(names(), (Faces{"depth", "comparison", "lit", "shadow"}));
  const Rendering r = render_cookie(scene, settings);
  const ProbedFragment* const lit = deciding_fragment(r.probed[0][2]);
  ASSERT_NE(lit, nullptr);
  ASSERT_EQ(lit->fate, FragmentFate::written);
  EXPECT_TRUE(r.probed[0][2].program.has_value());
  const std::size_t at = 20U * static_cast<std::size_t>(settings.width) + 60U;
  for (int c = 0; c < 3; ++c) EXPECT_EQ(lit->color[static_cast<std::size_t>(c)], r.frame.color(c)[at]);
}

TEST(LightRotation, QuarterTurnsAreExactAndOthersTrigonometry) {
  EXPECT_EQ(light_rotation({0, 0, 0}), glm::mat3(1.0F));
  EXPECT_EQ(light_rotation({360, -720, 1080}), glm::mat3(1.0F));
  EXPECT_EQ(light_rotation({0, 0, 90}) * glm::vec3(1, 2, 3), glm::vec3(-2, 1, 3));
  EXPECT_EQ(light_rotation({90, 0, 0}) * glm::vec3(1, 2, 3), glm::vec3(1, -3, 2));
  EXPECT_EQ(light_rotation({0, -90, 0}) * glm::vec3(1, 2, 3), glm::vec3(-3, 2, 1));
  for (int i = -1000; i <= 1000; ++i) {
    const float angle = static_cast<float>(i) * 0.73F;
    const glm::vec3 degrees(angle, 2.0F * angle + 5.0F, -angle);
    const glm::mat3 m = light_rotation(degrees);
    for (int axis = 0; axis < 3; ++axis) {
      glm::dvec3 v(0.0);
      v[axis] = 1.0;
      const glm::dvec3 expected = shadow_test::in_light_space(v, glm::dvec3(degrees));
      // The inverse's column is the rotation's row.
      for (int k = 0; k < 3; ++k) ASSERT_NEAR(m[k][axis], expected[k], 1e-7) << angle;
    }
  }
}

std::string fault_of(const Scene& scene, const RenderSettings& settings) {
  const auto result = render_light_cookie(scene, settings, {});
  return result ? std::string() : result.error().message;
}

TEST(LightCookie, ReportsWhatCannotBeDrawn) {
  const Scene scene = shadow_test::square_over_floor();
  const auto expect = [](const std::string& message, const char* part) {
    EXPECT_NE(message.find(part), std::string::npos) << "'" << part << "' is missing in: '" << message << "'";
  };
  RenderSettings s = cookie_settings();
  s.light_cookie.cookie.reset();
  expect(fault_of(scene, s), "no cookie");

  Texture texture = *shadow_test::labels();
  texture.target = TextureTarget::texture_2d;
  for (std::size_t f = 1; f < 6; ++f) texture.faces[f].clear();
  s.light_cookie.cookie = std::make_shared<Texture>(texture);
  expect(fault_of(scene, s), "2D texture");
  texture = *shadow_test::labels();
  texture.faces[4].clear();
  s.light_cookie.cookie = std::make_shared<Texture>(texture);
  expect(fault_of(scene, s), "incomplete");
  texture = *shadow_test::labels();
  texture.faces[2][0].width = 48;
  s.light_cookie.cookie = std::make_shared<Texture>(texture);
  expect(fault_of(scene, s), "48");

  s = cookie_settings();
  s.light_cookie.shadows = true;
  s.map_size = 3;
  expect(fault_of(scene, s), "power of two");
  Scene spot = scene;
  spot.lights[0].kind = LightKind::spot;
  expect(fault_of(spot, cookie_settings()), "expected a point light");
}

}  // namespace

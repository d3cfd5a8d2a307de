// Reflective shadow maps: the map, the gathering against integrals, and the technique's pictures.
#include "ninebit/shadow/reflective.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <random>
#include <string>

#include "combiner_tests/shadow/support.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/shadow_map.h"
#include "src/shadow/reflective/reflective_reference.h"

namespace {

using namespace ninebit;
using shadow_test::fact;
using shadow_test::for_each_pixel;
using shadow_test::samples_of;

RenderSettings reflective_settings(SamplePattern pattern = SamplePattern::polar) {
  RenderSettings settings;
  settings.width = 96;
  settings.height = 72;
  settings.map_size = 128;
  settings.reflective = {.samples = 64, .kernel = 36.0F, .pattern = pattern};
  return settings;
}

Scene shipped(const char* name, const LightKinds& kinds) {
  auto scene = read_scene(std::filesystem::path(NINEBIT_SOURCE_DIR) / "scenes" / name);
  EXPECT_TRUE(scene.ok());
  SceneSetup setup;
  setup.light_kinds = kinds;
  auto complete = complete_scene(std::move(*scene), setup, 4.0F / 3.0F);
  EXPECT_TRUE(complete.ok());
  return std::move(*complete);
}

Scene cornell_box() {
  return shipped("cornell_box.gltf", {.point = false, .spot = true});
}

Rendering rendered(const Scene& scene, const RenderSettings& settings) {
  return shadow_test::render_by("reflective", scene, settings);
}

const std::vector<float>& indirect(const Rendering& rendering, const char* channel) {
  return samples_of<float>(rendering.layers, "indirect", channel);
}

const Image8& picture(const Rendering& rendering, const std::string& file) {
  for (const NamedPicture& p : rendering.pictures) {
    if (p.file == file) return p.image;
  }
  throw std::runtime_error("no picture " + file);
}

// A level square of side 2 at y = 0, its left half red, its right half green, in parallel light from straight above.
Scene lit_square() {
  Scene scene = shadow_test::scene_with({0, 3, 5}, {0, 0, 0}, {0, 5, 0});
  scene.lights[0].kind = LightKind::directional;
  scene.lights[0].direction = {0, -1, 0};
  scene.materials = {{"red", {0.8F, 0, 0}}, {"green", {0, 0.8F, 0}}};
  shadow_test::add_quad(scene, "left", {{{-1, 0, 1}, {0, 0, 1}, {0, 0, -1}, {-1, 0, -1}}});
  shadow_test::add_quad(scene, "right", {{{0, 0, 1}, {1, 0, 1}, {1, 0, -1}, {0, 0, -1}}});
  scene.triangle_material = {0, 0, 1, 1};
  return scene;
}

TEST(ReflectiveMap, HoldsPositionNormalFluxAndDepth) {
  Scene scene = lit_square();
  scene.lights[0].color = {1.0F, 0.5F, 0.25F};
  const auto map = draw_reflective_map(scene, reflective_settings());
  ASSERT_TRUE(map.ok());
  ASSERT_EQ(map->size, 128);
  // The beam is 1.01 times as wide as the diagonal.
  const double texel = 2.0 * std::sqrt(8.0) * 0.505 / 128.0;
  std::size_t red = 0, green = 0;
  for (std::size_t i = 0; i < map->depth.size(); ++i) {
    if (map->depth[i] == 0xFFFFFF) {
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_EQ(map->position[c][i].bits | map->normal[c][i].bits | map->flux[c][i].bits, 0);
      }
      continue;
    }
    const float x = float_of(map->position[0][i]);
    ASSERT_EQ(float_of(map->position[1][i]), 0.0F);
    EXPECT_EQ(float_of(map->normal[0][i]), 0.0F);
    EXPECT_EQ(float_of(map->normal[1][i]), 1.0F);
    EXPECT_EQ(float_of(map->normal[2][i]), 0.0F);
    const bool left = x < 0.0F;
    (left ? red : green) += 1;
    const float from_half = 0x1p-11F;
    EXPECT_NEAR(float_of(map->flux[0][i]), left ? 0.8F * 0.3F : 0.0F, from_half * 0.25F);
    EXPECT_NEAR(float_of(map->flux[1][i]), left ? 0.0F : 0.8F * 0.3F * 0.5F, from_half * 0.25F);
    EXPECT_EQ(float_of(map->flux[2][i]), 0.0F);
  }
  EXPECT_NEAR(static_cast<double>(red), 2.0 / (texel * texel), 3.0 / texel);
  EXPECT_NEAR(static_cast<double>(green), 2.0 / (texel * texel), 3.0 / texel);
}

// How far a stored position may lie from the one that the depth gives, at a texel's centre:
// - each coordinate is rounded to a half, by at most 2^-11 of it (2^-25 among the smallest), and its interpolation in
//   floats is taken to be exact to 2^-20;
// - corners are moved by less than 1/16 texel in x and y, so that what is drawn at the centre lies by less than that
//   beside it, at the same depth;
// - depth codes are rounded at the corners and at the fragment, half a code each, and corners are transformed in
// floats:
//   each of the sums for z and w rounds three times by at most 2^-24 of the sum of its terms' sizes, and the division
//   and the viewport round by 2^-24 each.
class PositionBound {
 public:
  explicit PositionBound(const ReflectiveMap& map)
      : size_(map.size), clip_(map.clip_from_world), world_(glm::inverse(clip_)) {}

  double operator()(int x, int y, double code, const glm::dvec3& stored) const {
    const glm::dvec3 at = place(x + 0.5, y + 0.5, code);
    double rounding = 0.0;
    for (glm::length_t c = 0; c < 3; ++c) {
      rounding += std::pow(std::fabs(stored[c]) * (0x1p-11 + 0x1p-20) + 0x1p-25, 2);
    }
    const double snapping = glm::length(place(x + 0.5 + 0.0625, y + 0.5, code) - at) +
                            glm::length(place(x + 0.5, y + 0.5 + 0.0625, code) - at);
    const auto terms = [&](int row) {
      return std::fabs(clip_[0][row] * at.x) + std::fabs(clip_[1][row] * at.y) + std::fabs(clip_[2][row] * at.z) +
             std::fabs(clip_[3][row]);
    };
    const double w = clip_[0][3] * at.x + clip_[1][3] * at.y + clip_[2][3] * at.z + clip_[3][3];
    const double ndc = 3.0 * 0x1p-24 * (terms(2) + terms(3)) / w + 2.0 * 0x1p-24;
    const double codes = 1.0 + ndc * 0x1p23;
    const double depth = std::max(glm::length(place(x + 0.5, y + 0.5, code + codes) - at),
                                  glm::length(place(x + 0.5, y + 0.5, code - codes) - at));
    return std::sqrt(rounding) + snapping + depth;
  }

 private:
  [[nodiscard]] glm::dvec3 place(double x, double y, double code) const {
    const glm::dvec4 p =
        world_ * glm::dvec4(2.0 * x / size_ - 1.0, 2.0 * y / size_ - 1.0, 2.0 * code / 0xFFFFFF - 1.0, 1.0);
    return glm::dvec3(p) / p.w;
  }
  double size_;
  glm::dmat4 clip_, world_;
};

void expect_positions_agree(const Scene& scene, double largest_bound) {
  const auto map = draw_reflective_map(scene, reflective_settings());
  ASSERT_TRUE(map.ok());
  const std::vector<glm::dvec3> rebuilt = positions_from_depth(*map);
  const PositionBound bound(*map);
  double largest_share = 0.0;
  int compared = 0;
  for (std::size_t i = 0; i < rebuilt.size(); ++i) {
    if (map->depth[i] == 0xFFFFFF) {
      ASSERT_EQ(rebuilt[i], glm::dvec3(0.0));
      continue;
    }
    const glm::dvec3 stored(float_of(map->position[0][i]), float_of(map->position[1][i]),
                            float_of(map->position[2][i]));
    const double allowed =
        bound(static_cast<int>(i) % map->size, static_cast<int>(i) / map->size, map->depth[i], stored);
    const double difference = glm::length(rebuilt[i] - stored);
    ASSERT_LE(difference, allowed) << "texel " << i % 128 << ", " << i / 128;
    ASSERT_LE(allowed, largest_bound);
    largest_share = std::max(largest_share, difference / allowed);
    ++compared;
  }
  EXPECT_GT(compared, 5000);
  EXPECT_GT(largest_share, 0.1) << "the bound would hold for anything";
}

TEST(ReflectiveMap, PositionsFromDepthAgreeWithStoredOnes) {
  expect_positions_agree(cornell_box(), 0.03);
  expect_positions_agree(shipped("index_room.gltf", {.point = false, .directional = true}), 0.05);
}

TEST(ReflectiveMap, SaysWhatItCannotHold) {
  const auto fault = [](const Scene& scene, int map_size) {
    const Status checked = check_reflective_map(scene, map_size);
    return checked ? std::string() : checked.error().message;
  };
  Scene scene = lit_square();
  EXPECT_EQ(fault(scene, 8192), "");
  EXPECT_NE(fault(scene, 16384).find("at most 8192"), std::string::npos);
  EXPECT_NE(fault(scene, 100).find("power of two"), std::string::npos);
  scene.positions[0].x = -65504.0F;
  EXPECT_EQ(fault(scene, 64), "");
  scene.positions[0].x = -65536.0F;
  EXPECT_NE(fault(scene, 64).find("65504"), std::string::npos);
}

// Points at height 1 over the square that look down at it.
VisibleSurface points_over_square(const std::vector<float>& xs) {
  VisibleSurface s{.width = static_cast<int>(xs.size()), .height = 1};
  for (auto* planes : {&s.position, &s.normal, &s.color}) {
    for (auto& plane : *planes) plane.assign(xs.size(), 0.0F);
  }
  s.position[0] = xs;
  s.position[1].assign(xs.size(), 1.0F);
  s.normal[1].assign(xs.size(), -1.0F);
  return s;
}

// The form factor of the rectangle from (0, 0) to (a, b), at distance 1 from a point over its corner that looks at it.
double corner_form_factor(double a, double b) {
  const double p = std::sqrt(1.0 + a * a), q = std::sqrt(1.0 + b * b);
  return (a / p * std::atan(b / p) + b / q * std::atan(a / q)) / (2.0 * std::numbers::pi);
}

// Of the rectangle from x0 to x1, z from -1 to 1, seen from the point over x.
double form_factor(double x, double x0, double x1) {
  const double closed = 2.0 * (corner_form_factor(x1 - x, 1.0) - corner_form_factor(x0 - x, 1.0));
  double sum = 0.0;
  constexpr int kSteps = 200;
  for (int i = 0; i < kSteps; ++i) {
    for (int j = 0; j < kSteps; ++j) {
      const double dx = x0 + (i + 0.5) * (x1 - x0) / kSteps - x, dz = -1.0 + (j + 0.5) * 2.0 / kSteps;
      sum += 1.0 / std::pow(dx * dx + dz * dz + 1.0, 2.0);
    }
  }
  const double numeric = sum * (x1 - x0) * 2.0 / (kSteps * kSteps) / std::numbers::pi;
  EXPECT_NEAR(closed, numeric, 1e-4);
  return closed;
}

struct SquareLight {
  RenderSettings settings = reflective_settings();
  Scene scene = lit_square();
  ReflectiveMap map;
  PixelLights lights;
  SquareLight() {
    settings.map_size = 256;
    map = draw_reflective_map(scene, settings).value();
    lights = pixel_lights(map, scene.lights[0], SamplePattern::polar);
  }
};

// A diffuse surface that the direct light shows with 0.78 × colour lights others with that times the form factor.
TEST(IndirectLight, WholeMapIsTheIntegralOverTheSquare) {
  const SquareLight square;
  for (const double x : {-1.5, -0.5, 0.0, 0.25, 0.9}) {
    const glm::dvec3 whole = whole_map_irradiance(square.lights, {x, 1, 0}, {0, -1, 0});
    const double red = 0.8 * 0.78 * form_factor(x, -1.0, 0.0), green = 0.8 * 0.78 * form_factor(x, 0.0, 1.0);
    // The square's edges lie between texels: 1 of 179 in each direction.
    EXPECT_NEAR(whole.x, red, 0.015 * red);
    EXPECT_NEAR(whole.y, green, 0.015 * green);
    EXPECT_EQ(whole.z, 0.0);
    const glm::dvec3 mirrored = whole_map_irradiance(square.lights, {-x, 1, 0}, {0, -1, 0});
    EXPECT_NEAR(whole.x, mirrored.y, 0.01 * whole.x);
    EXPECT_EQ(whole.x > whole.y, x < 0.0) << "the nearer half gives more: " << x;
  }
  EXPECT_EQ(whole_map_irradiance(square.lights, {0, 1, 0}, {0, 1, 0}), glm::dvec3(0.0));
  EXPECT_EQ(whole_map_irradiance(square.lights, {0, -1, 0}, {0, 1, 0}), glm::dvec3(0.0));
}

// The same at any distance and under any angle of a spot light: its beam carries what falls on the square.
TEST(IndirectLight, WholeMapOfASpotLight) {
  Scene scene = lit_square();
  scene.lights[0].kind = LightKind::spot;
  scene.lights[0].position = {1.5F, 2.0F, 0.5F};
  scene.lights[0].direction = glm::normalize(glm::vec3(0.3F, 0, 0) - scene.lights[0].position);
  RenderSettings settings = reflective_settings();
  settings.map_size = 512;
  const auto map = draw_reflective_map(scene, settings);
  ASSERT_TRUE(map.ok());
  const PixelLights lights = pixel_lights(*map, scene.lights[0], SamplePattern::polar);
  const glm::dvec3 from(scene.lights[0].position);
  for (const double at : {-0.5, 0.5}) {
    double expected = 0.0;
    constexpr int kSteps = 200;
    for (int i = 0; i < kSteps; ++i) {
      for (int j = 0; j < kSteps; ++j) {
        const glm::dvec3 p(-1.0 + (i + 0.5) / kSteps, 0.0, -1.0 + (j + 0.5) * 2.0 / kSteps);
        const glm::dvec3 to_light = from - p, to_point = glm::dvec3(at, 1, 0) - p;
        const double cosine = to_light.y / glm::length(to_light);
        expected += 0.8 * 0.78 * cosine / std::pow(glm::dot(to_point, to_point), 2.0);
      }
    }
    expected *= 2.0 / (kSteps * kSteps) / std::numbers::pi;
    EXPECT_NEAR(whole_map_irradiance(lights, {at, 1, 0}, {0, -1, 0}).x, expected, 0.015 * expected);
  }
}

// A point behind a spot light has no place in its map, though the projection would mirror it there.
TEST(IndirectLight, NothingBehindASpotLight) {
  Scene scene = lit_square();
  scene.lights[0].kind = LightKind::spot;
  scene.lights[0].position = {0, 2, 0};
  const RenderSettings settings = reflective_settings();
  const ReflectiveMap map = draw_reflective_map(scene, settings).value();
  const PixelLights lights = pixel_lights(map, scene.lights[0], SamplePattern::polar);
  VisibleSurface surface = points_over_square({0.0F, 0.0F});
  surface.position[1] = {1.5F, 2.5F};
  IndirectLight light(map, lights, surface, make_pattern(settings.reflective), 60.0F);
  ASSERT_TRUE(light.compute({true, true}, 1, 0.0F, [](double) { return true; }).ok());
  EXPECT_GT(light.irradiance()[0][0], 0.0F);
  EXPECT_EQ(light.irradiance()[0][1], 0.0F);
}

// What a pattern comes to on average: the sum over all texels, each with a factor of its distance from the pixel's
// place in the map, in kernel radii.
template <class Factor>
glm::dvec3 weighted_map(const SquareLight& square, const glm::dvec3& point, double kernel, const Factor& factor) {
  const glm::dvec4 clip = glm::dmat4(square.map.clip_from_world) * glm::dvec4(point, 1.0);
  const glm::dvec2 place = (glm::dvec2(clip) * 0.5 + 0.5) * 256.0;
  glm::dvec3 sum(0.0);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const glm::dvec2 offset = (glm::dvec2(x + 0.5, y + 0.5) - place) / kernel;
      if (glm::length(offset) > 1.0) continue;
      PixelLights one{.size = 1};
      const auto begin = square.lights.values.begin() + (y * 256 + x) * static_cast<int>(PixelLights::kStride);
      one.values.assign(begin, begin + static_cast<int>(PixelLights::kStride));
      sum += whole_map_irradiance(one, point, {0, -1, 0}) * factor(offset);
    }
  }
  return sum;
}

glm::dvec3 gathered(const SquareLight& square, GatherPattern pattern, float kernel, const VisibleSurface& surface) {
  IndirectLight light(square.map, square.lights, surface, std::move(pattern), kernel);
  const std::vector<bool> drawn(surface.position[0].size(), true);
  EXPECT_TRUE(light.compute(drawn, 1, 0.0F, [](double) { return true; }).ok());
  glm::dvec3 mean(0.0);
  for (std::size_t c = 0; c < 3; ++c) {
    for (const float e : light.irradiance()[c]) mean[static_cast<glm::length_t>(c)] += e;
  }
  return mean / static_cast<double>(drawn.size());
}

// With the weight ξ1 the paper's pattern is the sum over all texels of the kernel; the published ξ1² counts each light
// 1.5 times its distance in kernel radii: those near by too little, those at the rim by a half too much.
TEST(IndirectLight, PolarPatternConvergesAndThePublishedWeightDoesNot) {
  const SquareLight square;
  const GatherPattern published = make_pattern({.samples = 4096, .pattern = SamplePattern::polar});
  GatherPattern even = published;
  for (float& w : even.weight) w = std::sqrt(w);
  for (const float x : {-0.5F, 0.25F}) {
    const VisibleSurface point = points_over_square({x});
    const glm::dvec3 at(x, 1, 0);
    for (const float kernel : {60.0F, 400.0F}) {
      const glm::dvec3 sum = weighted_map(square, at, kernel, [](const glm::dvec2&) { return 1.0; });
      if (kernel == 400.0F) {
        EXPECT_NEAR(sum.x, whole_map_irradiance(square.lights, at, {0, -1, 0}).x, 1e-9);
      }
      EXPECT_NEAR(gathered(square, even, kernel, point).x, sum.x, 0.03 * sum.x) << x << ' ' << kernel;
      const glm::dvec3 biased =
          weighted_map(square, at, kernel, [](const glm::dvec2& offset) { return 1.5 * glm::length(offset); });
      EXPECT_NEAR(gathered(square, published, kernel, point).x, biased.x, 0.03 * biased.x) << x << ' ' << kernel;
      EXPECT_GT(std::fabs(biased.x - sum.x), 0.05 * sum.x);
    }
  }
}

// The text's weight is the square of the turned offset's x, whatever the turn: a light counts by how far it lies beside
// the pixel along the map's s axis. Nothing is divided by the number of samples.
TEST(IndirectLight, PoissonPatternOnAverage) {
  const SquareLight square;
  const float kernel = 80.0F;
  const VisibleSurface points = points_over_square(std::vector<float>(256, 0.25F));
  const GatherPattern pattern = make_pattern({.samples = 400, .pattern = SamplePattern::poisson});
  const glm::dvec3 found = gathered(square, pattern, kernel, points);
  const double samples_a_texel = 400.0 / (std::numbers::pi * kernel * kernel);
  const glm::dvec3 expected =
      weighted_map(square, {0.25, 1, 0}, kernel, [](const glm::dvec2& offset) { return offset.x * offset.x; }) *
      samples_a_texel;
  EXPECT_NEAR(found.x, expected.x, 0.03 * expected.x);
  EXPECT_NEAR(found.y, expected.y, 0.03 * expected.y);
}

TEST(Reflective, IsDirectLightPlusIndirect) {
  const Scene scene = cornell_box();
  RenderSettings settings = reflective_settings(SamplePattern::poisson);
  settings.layers = true;
  const Rendering r = rendered(scene, settings);
  const auto direct = render_shadow_map(scene, settings, {});
  ASSERT_TRUE(direct.ok());
  EXPECT_EQ(r.frame.stencil(), direct->frame.stencil());
  EXPECT_EQ(r.shadowed, direct->shadowed);
  EXPECT_GT(r.shadowed, 500U);
  EXPECT_GT(r.lit, 500U);
  const Image8 &off = picture(r, "direct.png"), &difference = picture(r, "difference.png"),
               &light = picture(r, "indirect.png");
  int brighter = 0;
  for_each_pixel(settings, [&](int x, int y, std::size_t i) {
    const auto p = static_cast<std::size_t>((settings.height - 1 - y) * settings.width + x) * 3;
    for (int c = 0; c < 3; ++c) {
      const std::size_t at = p + static_cast<std::size_t>(c);
      const std::string channel(1, "RGB"[c]);
      ASSERT_EQ(off.pixels[at], direct->frame.color(c)[i]);
      ASSERT_EQ(r.frame.color(c)[i], off.pixels[at] + difference.pixels[at]);
      const float e = indirect(r, channel.c_str())[i];
      ASSERT_TRUE(e >= 0.0F && e <= 1.0F);
      ASSERT_EQ(light.pixels[at], static_cast<int>(e * 255.0F + 0.5F));
      const float surface = samples_of<float>(r.layers, "surface_color", channel)[i];
      ASSERT_EQ(difference.pixels[at], std::min(255 - off.pixels[at], static_cast<int>(surface * e * 255.0F + 0.5F)));
      if (difference.pixels[at] > 0) ++brighter;
    }
  });
  EXPECT_GT(brighter, 3000);
  EXPECT_GT(fact<std::uint64_t>(r, "pixel_lights"), 10000U);
  EXPECT_EQ(fact<std::uint64_t>(r, "gathered_pixels"), r.lit + r.shadowed);
  EXPECT_EQ(fact<std::uint64_t>(r, "interpolated_pixels"), 0U);
  for (const char* part : {"rsm_position", "rsm_normal"}) {
    EXPECT_EQ(samples_of<Half>(r.maps, part, "Z").size(), 128U * 128U);
  }
  EXPECT_EQ(samples_of<Half>(r.maps, "rsm_flux", "R").size(), 128U * 128U);
  EXPECT_EQ(samples_of<std::uint32_t>(r.maps, "rsm_depth", "depth").size(), 128U * 128U);
}

// The red wall is on the left: light from there is redder than light from the green one.
TEST(Reflective, WallsBleedTheirColours) {
  for (const SamplePattern pattern : {SamplePattern::poisson, SamplePattern::polar}) {
    RenderSettings settings = reflective_settings(pattern);
    settings.layers = true;
    const Rendering r = rendered(cornell_box(), settings);
    const auto& x = samples_of<float>(r.layers, "surface_position", "X");
    const auto& up = samples_of<float>(r.layers, "surface_normal", "Y");
    std::array<double, 2> red{}, green{};
    for (std::size_t i = 0; i < x.size(); ++i) {
      if (up[i] < 0.9F || std::fabs(x[i]) < 2.0F) continue;  // the floor beside the walls
      const std::size_t side = x[i] < 0.0F ? 0 : 1;
      red[side] += indirect(r, "R")[i];
      green[side] += indirect(r, "G")[i];
    }
    EXPECT_GT(red[0] / green[0], 1.5 * red[1] / green[1]);
    EXPECT_GT(green[1], green[0]);
  }
}

TEST(Reflective, LowResolutionGatheringIsCloseToTheFullOne) {
  const Scene scene = cornell_box();
  RenderSettings settings = reflective_settings();
  settings.width = 240;
  settings.height = 180;
  settings.layers = true;
  const Rendering full = rendered(scene, settings);
  for (const int scale : {2, 4, 16}) {
    settings.reflective.gather_scale = scale;
    const Rendering low = rendered(scene, settings);
    const auto count = fact<std::uint64_t>(low, "gathered_pixels");
    EXPECT_EQ(count + fact<std::uint64_t>(low, "interpolated_pixels"), low.lit + low.shadowed);
    if (scale < 16) {  // those are too far apart here to share light
      EXPECT_LT(count, (low.lit + low.shadowed) * 6 / 10) << scale;
    }
    double difference = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < indirect(full, "R").size(); ++i) {
      difference += std::fabs(indirect(low, "R")[i] - indirect(full, "R")[i]);
      sum += indirect(full, "R")[i];
      const int x = static_cast<int>(i) % settings.width, y = static_cast<int>(i) / settings.width;
      if (x % scale == scale / 2 && y % scale == scale / 2) {
        ASSERT_EQ(indirect(low, "R")[i], indirect(full, "R")[i]) << x << ", " << y << ": one of the low resolution's";
      }
    }
    EXPECT_LT(difference, 0.06 * sum) << scale;
    EXPECT_EQ(difference > 0.0, fact<std::uint64_t>(low, "interpolated_pixels") > 0) << scale;
  }
}

// On the floor, away from everything, a pixel between four of the low resolution's is their bilinear mean.
TEST(Reflective, InterpolationIsBilinear) {
  RenderSettings settings = reflective_settings();
  settings.width = 240;
  settings.height = 180;
  settings.layers = true;
  settings.reflective.gather_scale = 4;
  const Rendering r = rendered(cornell_box(), settings);
  const auto& red = indirect(r, "R");
  const auto plane = [&](const char* part, const char* axis) -> const std::vector<float>& {
    return samples_of<float>(r.layers, part, axis);
  };
  const auto &x = plane("surface_position", "X"), &z = plane("surface_position", "Z");
  const auto &height = plane("surface_position", "Y"), &up = plane("surface_normal", "Y");
  int compared = 0;
  for (int row = 2; row + 4 < settings.height; row += 4) {
    for (int column = 2; column + 4 < settings.width; column += 4) {
      const auto at = [&](int dx, int dy) {
        return static_cast<std::size_t>((row + dy) * settings.width + column + dx);
      };
      const std::array<std::size_t, 4> corner{at(0, 0), at(4, 0), at(0, 4), at(4, 4)};
      // All within half a unit of each other: below a sixteenth of the box's diagonal of 10.4.
      const bool floor = std::all_of(corner.begin(), corner.end(), [&](std::size_t i) {
        return up[i] > 0.99F && height[i] == 0.0F && std::hypot(x[i] - x[corner[0]], z[i] - z[corner[0]]) < 0.5F;
      });
      if (!floor) continue;
      for (int dy = 0; dy < 4; ++dy) {
        for (int dx = 0; dx < 4; ++dx) {
          if (up[at(dx, dy)] < 0.99F || height[at(dx, dy)] != 0.0F) continue;  // a box stands there
          const double low = red[corner[0]] * (1.0 - dx * 0.25) + red[corner[1]] * (dx * 0.25);
          const double high = red[corner[2]] * (1.0 - dx * 0.25) + red[corner[3]] * (dx * 0.25);
          const double expected = low * (1.0 - dy * 0.25) + high * (dy * 0.25);
          ASSERT_NEAR(red[at(dx, dy)], expected, 1e-5 * expected + 1e-7) << column + dx << ", " << row + dy;
          ++compared;
        }
      }
    }
  }
  EXPECT_GT(compared, 500);
}

TEST(Reflective, EvidenceComparesWithTheWholeMap) {
  RenderSettings settings = reflective_settings();
  settings.evidence = true;
  settings.reflective.samples = 1024;
  settings.reflective.kernel = 182.0F;
  const Rendering r = rendered(cornell_box(), settings);
  EXPECT_GT(fact<std::uint64_t>(r, "indirect_reference_pixels"), 120U);
  const double mean = fact<double>(r, "indirect_reference_mean"), error = fact<double>(r, "indirect_mean_error");
  EXPECT_GT(mean, 0.01);
  EXPECT_LT(error, mean) << "the published weight is biased, but not by everything";
  EXPECT_GT(error, 0.0);
  EXPECT_GE(fact<double>(r, "indirect_max_error"), error);
  EXPECT_LT(fact<double>(r, "position_max_difference"), 0.03);
}

// The cost of the published weight on a whole picture, where the kernel covers the whole map.
TEST(Reflective, BiasOfThePublishedWeight) {
  const Scene scene = cornell_box();
  RenderSettings settings = reflective_settings();
  settings.layers = true;
  const Rendering r = rendered(scene, settings);
  VisibleSurface surface{.width = settings.width, .height = settings.height};
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string axis(1, "XYZ"[c]);
    surface.position[c] = samples_of<float>(r.layers, "surface_position", axis);
    surface.normal[c] = samples_of<float>(r.layers, "surface_normal", axis);
  }
  const ReflectiveMap map = draw_reflective_map(scene, settings).value();
  std::vector<bool> drawn;  // inside the beam: beside it the kernel does not reach the whole map
  for (std::size_t i = 0; i < r.frame.depth().size(); ++i) {
    const glm::vec4 clip = map.clip_from_world * glm::vec4(surface.position_at(i), 1.0F);
    drawn.push_back(r.frame.depth()[i] != 0xFFFFFF && std::max(std::fabs(clip.x), std::fabs(clip.y)) < clip.w);
  }
  const PixelLights lights = pixel_lights(map, scene.lights[0], SamplePattern::polar);
  const auto go_on = [](double) { return true; };
  GatherPattern pattern = make_pattern({.samples = 4096, .pattern = SamplePattern::polar});
  std::array<double, 2> share{};
  for (double& s : share) {
    IndirectLight light(map, lights, surface, pattern, 182.0F);
    ASSERT_TRUE(light.compute(drawn, 1, 0.0F, go_on).ok());
    const auto error = indirect_error(lights, surface, drawn, light, go_on);
    ASSERT_TRUE(error.ok());
    s = error->mean / error->reference_mean;
    for (float& w : pattern.weight) w = std::sqrt(w);  // ξ1 in the second round
  }
  RecordProperty("published_weight_error", std::to_string(share[0]));
  RecordProperty("even_weight_error", std::to_string(share[1]));
  EXPECT_LT(share[1], 0.05);
  EXPECT_GT(share[0], 5.0 * share[1]);
}

TEST(Reflective, SettingsOutOfRange) {
  const Scene scene = lit_square();
  const auto fault = [&](const ReflectiveSettings& reflective) {
    RenderSettings settings = reflective_settings();
    settings.reflective = reflective;
    const auto result = render_reflective(scene, settings, {});
    return result ? std::string() : result.error().message;
  };
  EXPECT_EQ(fault({.samples = 1, .kernel = 1.0F}), "");
  EXPECT_NE(fault({.samples = 0}).find("1 to 4096"), std::string::npos);
  EXPECT_NE(fault({.samples = 4097}).find("1 to 4096"), std::string::npos);
  EXPECT_NE(fault({.kernel = 0.5F}).find("kernel radius 0.5"), std::string::npos);
  EXPECT_NE(fault({.kernel = NAN}).find("kernel radius"), std::string::npos);
  EXPECT_NE(fault({.gather_scale = 0}).find("1 to 16"), std::string::npos);
  EXPECT_NE(fault({.gather_scale = 17}).find("1 to 16"), std::string::npos);
  Scene point = scene;
  point.lights[0].kind = LightKind::point;
  const auto result = render_reflective(point, reflective_settings(), {});
  ASSERT_FALSE(result.ok());
  EXPECT_NE(result.error().message.find("spot or directional"), std::string::npos);
}

}  // namespace

// Textures, vertex colours and alpha masks of a scene's materials.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "combiner_tests/shadow/cookie_support.h"
#include "combiner_tests/shadow/shadow_map_support.h"
#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/slow_build.h"

namespace {

using namespace ninebit;
using shadow_test::for_each_pixel;
using shadow_test::render_by;

using TexelBytes = std::vector<std::uint8_t>;  // planes of red, green, blue, alpha

std::shared_ptr<const Texture> texture_of(int width, int height, const TexelBytes& planes) {
  const auto made =
      make_texture(TextureTarget::texture_2d, InternalFormat::rgba8, {{TextureSamples{width, height, planes}}});
  EXPECT_TRUE(made) << (made ? "" : made.error().message);
  return made ? std::make_shared<const Texture>(*made) : nullptr;
}

std::shared_ptr<const Texture> plain_texture(const ColorBytes& color) {
  return texture_of(1, 1, {color[0], color[1], color[2], color[3]});
}

// Gives all triangles this texture, read at the nearest texel.
void dress(Scene& scene, std::shared_ptr<const Texture> texture) {
  scene.textures = {{.name = "test", .texture = std::move(texture)}};
  for (Material& material : scene.materials) {
    material.base_texture = 0;
    material.sampler = kNearestSampler;
  }
  scene.texture_coordinates.resize(scene.positions.size(), glm::vec2(0.5F));
}

// The rule of the general combiner on a GeForce 2: fractions are dropped.
int product(int primary, int texel) {
  return primary * texel / 255;
}

// A quad of 2 x 2 that fills a view of 64 x 64 pixels: texel (x, y) is at pixel (x, 63 - y).
TEST(Textured, EachPixelIsShadingTimesItsTexel) {
  constexpr int kSize = 64;
  Scene scene = shadow_test::scene_with({0, 0, 1}, {0, 0, 0}, {0, 0, 2});
  scene.cameras[0].vertical_fov_degrees = 90.0F;
  shadow_test::add_quad(scene, "quad", {{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}});
  scene.texture_coordinates = {{0, 1}, {1, 1}, {1, 0}, {0, 0}};
  RenderSettings settings = shadow_test::small_settings();
  settings.width = settings.height = kSize;
  settings.index.scope = IndexScope::object;
  const Rendering plain = shadow_test::render(scene, settings);
  ASSERT_EQ(plain.lit, kSize * kSize);
  TexelBytes texels;
  for (std::uint32_t i = 0; i < 4 * kSize * kSize; ++i)
    texels.push_back(static_cast<std::uint8_t>((i * 2654435761U) >> 24U));
  dress(scene, texture_of(kSize, kSize, texels));
  const Rendering drawn = shadow_test::render(scene, settings);
  for (int c = 0; c < 3; ++c) {
    for (int y = 0; y < kSize; ++y) {
      for (int x = 0; x < kSize; ++x) {
        const auto pixel = static_cast<std::size_t>(y * kSize + x);
        const int texel = texels[static_cast<std::size_t>((c * kSize + kSize - 1 - y) * kSize + x)];
        ASSERT_EQ(drawn.frame.color(c)[pixel], product(plain.frame.color(c)[pixel], texel))
            << c << " " << x << " " << y;
      }
    }
  }
}

class TexturedTechnique : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, TexturedTechnique,
                         testing::Values("index-cube", "depth-cube", "shadow-map", "shadow-volume"),
                         [](const auto& test) {
                           std::string name = test.param;
                           return name.replace(name.find('-'), 1, "_");
                         });

Scene scene_for(const std::string& technique) {
  Scene scene = shadow_test::square_over_floor();
  if (technique == "shadow-map") scene.lights[0] = shadow_test::spot_light({0, 3, 0}, {0, 0, 0}, 120.0F);
  return scene;
}

// In light and in shadow, with and without layers and evidence.
TEST_P(TexturedTechnique, MultipliesLightAndShadow) {
  Scene scene = scene_for(GetParam());
  RenderSettings settings = shadow_test::small_settings();
  settings.layers = settings.evidence = true;
  const Rendering plain = render_by(GetParam(), scene, settings);
  ASSERT_GT(plain.shadowed, 100U);
  constexpr ColorBytes kColor{200, 100, 50, 255};
  dress(scene, plain_texture(kColor));
  scene.materials.push_back({.name = "bare", .base_color = glm::vec3(1.0F)});
  scene.triangle_material.back() = 1;  // half of the square has no texture
  const Rendering numbered = render_by(GetParam(), scene, settings);
  EXPECT_EQ(numbered.frame.stencil(), plain.frame.stencil());
  EXPECT_EQ(numbered.frame.depth(), plain.frame.depth());
  const auto& polygon = shadow_test::samples_of<std::uint32_t>(plain.layers, "polygon", "polygon");
  EXPECT_EQ(shadow_test::samples_of<std::uint32_t>(numbered.layers, "polygon", "polygon"), polygon);
  ASSERT_TRUE(numbered.evidence && plain.evidence);
  EXPECT_EQ(numbered.evidence->fetched, plain.evidence->fetched);
  std::size_t bare = 0;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const bool textured = polygon[i] != 0 && polygon[i] != scene.triangles.size();
    bare += polygon[i] == scene.triangles.size() ? 1U : 0U;
    for (int c = 0; c < 3; ++c) {
      const int before = plain.frame.color(c)[i];
      ASSERT_EQ(numbered.frame.color(c)[i], textured ? product(before, kColor[static_cast<std::size_t>(c)]) : before);
    }
  }
  EXPECT_GT(bare, 10U);
  settings.layers = settings.evidence = false;
  const Rendering fast = render_by(GetParam(), scene, settings);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(fast.frame.color(c), numbered.frame.color(c));
  EXPECT_EQ(fast.frame.stencil(), numbered.frame.stencil());
}

// A texture that is not loaded, and white colours of vertices, change no bit.
TEST_P(TexturedTechnique, WithoutLoadedTexturesNothingChanges) {
  Scene scene = scene_for(GetParam());
  const RenderSettings settings = shadow_test::small_settings();
  const Rendering plain = render_by(GetParam(), scene, settings);
  dress(scene, nullptr);
  scene.materials[0].alpha_mode = AlphaMode::mask;
  scene.colors.assign(scene.positions.size(), glm::vec4(1.0F));
  const Rendering same = render_by(GetParam(), scene, settings);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(same.frame.color(c), plain.frame.color(c));
  EXPECT_EQ(same.frame.stencil(), plain.frame.stencil());
}

// The final combiner multiplies what light and ambient light gave, and rounds to nearest.
TEST(Textured, LightCookieMultipliesTheSumOfItsLight) {
  Scene scene = shadow_test::walls_around_light(1);
  RenderSettings settings = shadow_test::cookie_settings();
  const Rendering plain = shadow_test::render_cookie(scene, settings);
  constexpr ColorBytes kColor{200, 100, 50, 255};
  dress(scene, plain_texture(kColor));
  const Rendering textured = shadow_test::render_cookie(scene, settings);
  std::size_t colored = 0;
  for (int c = 0; c < 3; ++c) {
    for (std::size_t i = 0; i < plain.frame.stencil().size(); ++i) {
      const int before = plain.frame.color(c)[i], texel = kColor[static_cast<std::size_t>(c)];
      if (plain.frame.depth()[i] == max_depth(plain.frame.format())) continue;
      ASSERT_EQ(textured.frame.color(c)[i], (before * texel * 2 + 255) / 510);
      colored += before > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(colored, 100U);
}

TEST(Textured, VertexColoursMultiplyTheBaseColour) {
  Scene scene = shadow_test::square_over_floor();
  const RenderSettings settings = shadow_test::small_settings();
  scene.colors.assign(scene.positions.size(), glm::vec4(0.5F, 0.25F, 1.0F, 0.0F));
  const Rendering colored = shadow_test::render(scene, settings);
  scene.colors.clear();
  scene.materials[0].base_color = {0.5F, 0.25F, 1.0F};
  const Rendering based = shadow_test::render(scene, settings);
  for (int c = 0; c < 3; ++c) EXPECT_EQ(colored.frame.color(c), based.frame.color(c));
}

// The square over the floor, and its right half alone.
struct Halves {
  Scene masked, half;
};
Halves halves_for(const std::string& technique) {
  Scene masked = scene_for(technique);
  // Left half transparent; both parts white.
  const auto texture = texture_of(2, 1, {255, 255, 255, 255, 255, 255, 100, 200});
  masked.materials.push_back({.name = "leaf", .base_color = glm::vec3(1.0F)});
  masked.triangle_material[2] = masked.triangle_material[3] = 1;
  masked.textures = {{.name = "leaf", .texture = texture}};
  masked.texture_coordinates.assign(masked.positions.size(), glm::vec2(0.0F));
  for (std::size_t v = 4; v < 8; ++v) masked.texture_coordinates[v].x = (masked.positions[v].x + 1.0F) / 2.0F;
  masked.materials[1].base_texture = 0;
  masked.materials[1].sampler = kNearestSampler;
  masked.materials[1].alpha_mode = AlphaMode::mask;
  Scene half = scene_for(technique);
  for (std::size_t v = 4; v < 8; ++v) half.positions[v].x = std::max(half.positions[v].x, 0.0F);
  return {std::move(masked), std::move(half)};
}

// Pixels with another shadow or another surface. Colours differ, because shading is computed at the vertices.
std::size_t differing_pixels(const Rendering& a, const Rendering& b) {
  constexpr std::int64_t kRounding = 2000;  // of 2^24: other triangles, other vertices to snap
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.frame.stencil().size(); ++i) {
    const std::int64_t gap = std::int64_t{a.frame.depth()[i]} - std::int64_t{b.frame.depth()[i]};
    count += a.frame.stencil()[i] == b.frame.stencil()[i] && std::abs(gap) <= kRounding ? 0U : 1U;
  }
  return count;
}

class MaskedTechnique : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, MaskedTechnique, testing::Values("index-cube", "shadow-map"), [](const auto& test) {
  std::string name = test.param;
  return name.replace(name.find('-'), 1, "_");
});

// Holes are holes, from the camera and from the light: as if only the other half were there. Along the edge, positions
// are snapped to 1/16 pixel and texture coordinates are not.
TEST_P(MaskedTechnique, HolesLetLightThrough) {
  const Halves scenes = halves_for(GetParam());
  RenderSettings settings = shadow_test::small_settings();
  settings.index.scope = IndexScope::object;
  settings.layers = false;
  const Rendering half = render_by(GetParam(), scenes.half, settings);
  const Rendering masked = render_by(GetParam(), scenes.masked, settings);
  Scene whole = scenes.masked;
  whole.materials[1].alpha_mode = AlphaMode::opaque;
  const Rendering opaque = render_by(GetParam(), whole, settings);
  const std::size_t pixels = masked.frame.stencil().size();
  EXPECT_LT(differing_pixels(masked, half), pixels / 200);
  EXPECT_GT(differing_pixels(masked, opaque), pixels / 50);
  settings.layers = true;
  EXPECT_EQ(render_by(GetParam(), scenes.masked, settings).frame.stencil(), masked.frame.stencil());
}

TEST(Masked, CutoffAndBaseAlphaDecide) {
  Halves scenes = halves_for("index-cube");
  RenderSettings settings = shadow_test::small_settings();
  Material& leaf = scenes.masked.materials[1];
  const auto drawn = [&](float alpha, float cutoff) {
    leaf.alpha = alpha;
    leaf.alpha_cutoff = cutoff;
    const Rendering r = shadow_test::render(scenes.masked, settings);
    return r.shadowed;
  };
  const std::uint64_t none = drawn(1.0F, 2.0F), right = drawn(1.0F, 0.5F), both = drawn(1.0F, 0.0F);
  EXPECT_LT(none, right);
  EXPECT_LT(right, both);
  EXPECT_EQ(drawn(1.0F, 100.0F / 255.0F), both) << "equal to the cutoff is drawn";
  EXPECT_EQ(drawn(1.0F, 101.0F / 255.0F), right);
  EXPECT_EQ(drawn(0.5F, 0.5F), none) << "200 × 0.5 is below the cutoff";
}

TEST(Textured, RefusesTexturesThatCannotBeDrawn) {
  Scene scene = shadow_test::square_over_floor();
  dress(scene, texture_of(2, 2, TexelBytes(16, 255)));
  scene.materials[0].sampler.min_filter = MinFilter::linear_mipmap_linear;  // the texture has one level
  const auto refused = find_technique("index-cube")->render(scene, shadow_test::small_settings(), {});
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("'test'"), std::string::npos);
}

// A way to draw, and the passes that may decide a pixel's shadow.
struct Decided {
  const char* technique;
  std::vector<std::string> passes;
  RenderSettings settings = shadow_test::small_settings();
};

std::vector<Decided> ways_to_decide() {
  std::vector<Decided> all{
      {"index-cube", {"comparison"}},
      {"index-cube", {"comparison", "averted"}},
      {"depth-cube", {"comparison +X", "comparison -X", "comparison -Y", "comparison +Z", "comparison -Z"}},
      {"depth-cube",
       {"high byte +X", "high byte -X", "high byte -Y", "high byte +Z", "high byte -Z", "low byte +X", "low byte -X",
        "low byte -Y", "low byte +Z", "low byte -Z"}},
      {"depth-cube", {"comparison"}},
      {"shadow-map", {"comparison"}},
      {"shadow-map", {"coordinates"}},
      {"shadow-volume", {"volumes", "lit"}},
      {"shadow-volume", {"volume fronts", "volume backs", "lit"}},
      {"reflective", {"comparison"}},
      {"light-cookie", {"comparison"}},
      {"light-cookie", {"lit"}}};
  for (Decided& way : all) {
    way.settings.width = 36;
    way.settings.height = 27;
    way.settings.map_size = 32;
    way.settings.reflective.samples = 1;
    way.settings.light_cookie.cookie = shadow_test::labels();
    way.settings.light_cookie.shadows = true;
  }
  all[1].settings.light_facing = true;
  all[3].settings.depth_cube.bits = DepthCubeBits::sixteen;
  all[4].settings.depth_cube.bits = DepthCubeBits::real;
  all[6].settings.shadow_map.encoding = DepthEncoding::rgba8_fract;
  all[8].settings.shadow_volume = {.method = VolumeMethod::depth_pass, .two_sided = false};
  all[11].settings.light_cookie.shadows = false;
  return all;
}

// What each pixel of a rendering shows, on a line for each of its passes and fragments.
std::string probed_text(const std::vector<ProbedPass>& passes) {
  std::string text;
  for (const ProbedPass& pass : passes) {
    text += pass.name + (pass.program ? " program " : " ") + std::to_string(pass.stencil) + '\n';
    for (const ProbedFragment& f : pass.fragments) {
      text += std::to_string(f.primitive) + ' ' + std::to_string(f.depth) + ' ' + std::to_string(f.stored_depth) + ' ' +
              std::to_string(f.stored_stencil) + ' ' + testing::PrintToString(f.registers.value) + ' ' +
              testing::PrintToString(f.color) + ' ' + std::to_string(static_cast<int>(f.fate)) + '\n';
    }
  }
  return text;
}

// Many pixels of one rendering show what each shows in a rendering of its own: of groups of surfaces those that drew
// there, and of the faces of a cube map the pixel's.
TEST(ProbedPasses, TogetherAreThoseOfEachAlone) {
  for (const Decided& way : ways_to_decide()) {
    SCOPED_TRACE(way.technique + (" " + testing::PrintToString(way.passes)));
    const bool needs_spot = !find_technique(way.technique)->lights.point;
    Scene scene = halves_for(way.technique).masked;
    if (needs_spot) scene.lights[0] = shadow_test::spot_light({0, 3, 0}, {0, 0, 0}, 120.0F);
    RenderSettings settings = way.settings;
    for (int y = 2; y < settings.height; y += 6) {
      for (int x = 2; x < settings.width; x += 6) settings.pixels.emplace_back(x, y);
    }
    settings.pixels.push_back(settings.pixels[7]);
    const Rendering together = render_by(way.technique, scene, settings);
    ASSERT_EQ(together.probed.size(), settings.pixels.size());
    EXPECT_EQ(deciding_pass(together, settings.pixels.size()), nullptr);
    std::set<std::string> texts;
    for (std::size_t i = 0; i < settings.pixels.size(); ++i) {
      RenderSettings one = way.settings;
      one.pixels = {settings.pixels[i]};
      const Rendering alone = render_by(way.technique, scene, one);
      const std::string text = probed_text(alone.probed[0]);
      ASSERT_EQ(probed_text(together.probed[i]), text) << i;
      const ProbedPass* const decided = deciding_pass(alone);
      const ProbedPass* const same = deciding_pass(together, i);
      ASSERT_EQ(decided == nullptr, same == nullptr) << i;
      if (decided != nullptr) {
        ASSERT_EQ(decided->name, same->name) << i;
      }
      texts.insert(text);
    }
    EXPECT_GT(texts.size(), 8U);
  }
}

// With and without textures the same pass decides, and what it did to the pixel is what the stencil says.
TEST(DecidingPass, IsThatOfTheShadow) {
  for (const Decided& way : ways_to_decide()) {
    SCOPED_TRACE(way.technique + (" " + testing::PrintToString(way.passes)));
    Scene scene = shadow_test::scene_with({4, 5, 7}, {0, 0.5F, 0}, {-3, 4, 1});
    shadow_test::add_box(scene, "box", {-1, 0.5F, -1}, {1, 2, 1});
    shadow_test::add_quad(scene, "floor", {{{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}}});
    const bool needs_spot = !find_technique(way.technique)->lights.point;
    if (needs_spot) scene.lights[0] = shadow_test::spot_light({-3, 4, 1}, {0, 0, 0}, 100.0F);
    Scene textured = scene;
    dress(textured, plain_texture({200, 100, 50, 255}));
    std::set<std::string> seen;
    int lit = 0, shadowed = 0;
    constexpr int kStep = test::kSlowBuild ? 6 : 3;
    for (int y = 1; y < way.settings.height; y += kStep) {
      for (int x = 1; x < way.settings.width; x += kStep) {
        SCOPED_TRACE(std::to_string(x) + "," + std::to_string(y));
        RenderSettings settings = way.settings;
        settings.pixels = {glm::ivec2(x, y)};
        const Rendering plain = render_by(way.technique, scene, settings);
        const Rendering drawn = render_by(way.technique, textured, settings);
        const auto at = static_cast<std::size_t>(y * settings.width + x);
        const ProbedPass* const pass = deciding_pass(plain);
        const ProbedPass* const same = deciding_pass(drawn);
        if (plain.frame.depth()[at] == max_depth(plain.frame.format())) {
          ASSERT_EQ(pass, nullptr);
          ASSERT_EQ(same, nullptr);
          continue;
        }
        ASSERT_NE(pass, nullptr);
        ASSERT_NE(same, nullptr);
        ASSERT_EQ(pass->name, same->name);
        ASSERT_TRUE(std::count(way.passes.begin(), way.passes.end(), pass->name) == 1) << pass->name;
        seen.insert(pass->name);
        const bool in_shadow = plain.frame.stencil()[at] != 0;
        ++(in_shadow ? shadowed : lit);
        ASSERT_FALSE(in_shadow && pass->name == "lit");
        if (!same->program || pass->name == "lit") continue;
        const ProbedFragment* const fragment = deciding_fragment(*same);
        ASSERT_NE(fragment, nullptr);
        ASSERT_EQ(fragment->fate, in_shadow ? FragmentFate::written : FragmentFate::alpha_failed);
      }
    }
    EXPECT_GT(lit, test::kSlowBuild ? 1 : 5);
    EXPECT_TRUE(shadowed > (test::kSlowBuild ? 0 : 3) || way.passes.front() == "lit");
    EXPECT_TRUE(seen.size() == 2 || way.passes.size() != 2);
  }
}

// Two squares in one plane. Where they overlap, the depth test LESS leaves the first; the passes after it draw both,
// those of colour the one without texture first.
TEST(Layers, NameThePolygonThatTheDepthTestLeft) {
  Scene scene = shadow_test::scene_with({0, 5, 0.01F}, {0, 0, 0}, {0.3F, 6, 0.2F});
  shadow_test::add_quad(scene, "left", {{{-2, 0, 1}, {1, 0, 1}, {1, 0, -1}, {-2, 0, -1}}});
  shadow_test::add_quad(scene, "right", {{{-1, 0, 1}, {2, 0, 1}, {2, 0, -1}, {-1, 0, -1}}});
  Scene textured = scene;
  dress(textured, plain_texture({200, 100, 50, 255}));
  textured.materials.push_back({.name = "bare", .base_color = glm::vec3(1.0F)});
  textured.triangle_material = {0, 0, 1, 1};
  Scene turned = scene;  // the second square's other side, which the light does not compare
  for (std::size_t t = 2; t < 4; ++t) std::swap(turned.triangles[t].y, turned.triangles[t].z);
  for (const Scene* drawn : {&scene, &textured, &turned}) {
    for (const bool light_facing : {false, true}) {
      RenderSettings settings = shadow_test::small_settings();
      settings.layers = true;
      settings.light_facing = light_facing;
      const Rendering r = shadow_test::render(*drawn, settings);
      const auto layers = shadow_test::comparison_layers(r);
      int overlapped = 0;
      for_each_pixel(settings, [&](int x, int y, std::size_t at) {
        if (layers.polygon[at] == 0) return;
        const bool is_left = shadow_test::on_plane(scene, settings, x, y, 0.0F).x < 1.0F;
        ASSERT_EQ(layers.object[at], is_left ? 1U : 2U) << x << ' ' << y;
        const bool compared = !light_facing || drawn != &turned || is_left;
        ASSERT_EQ(layers.own(r.codes, at), compared ? layers.polygon[at] : 0U) << x << ' ' << y;
        overlapped += is_left && shadow_test::on_plane(scene, settings, x, y, 0.0F).x > -1.0F ? 1 : 0;
      });
      EXPECT_GT(overlapped, 1000);
    }
  }
}

}  // namespace

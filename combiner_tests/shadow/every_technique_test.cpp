// What holds for every technique, also with the settings that take another way through it: the same answer for any
// number of threads, the same picture without layers, and an end after each pass.
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <optional>
#include <stdexcept>
#include <string>

#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/index_room.h"
#include "combiner_tests/support/slow_build.h"

namespace {

using namespace ninebit;
using ninebit::test::with_threads;

struct Way {
  const char *technique, *name;
  void (*choose)(RenderSettings&);
};

const Way kWays[] = {
    {"index-cube", "shaded", [](RenderSettings&) {}},
    {"index-cube", "cartoon", [](RenderSettings& s) { s.cartoon = true; }},
    {"depth-cube", "8 bits", [](RenderSettings& s) { s.depth_cube.bits = DepthCubeBits::eight; }},
    {"depth-cube", "16 bits", [](RenderSettings& s) { s.depth_cube.bits = DepthCubeBits::sixteen; }},
    {"depth-cube", "floats", [](RenderSettings& s) { s.depth_cube.bits = DepthCubeBits::real; }},
    {"shadow-map", "24 bits", [](RenderSettings& s) { s.shadow_map.encoding = DepthEncoding::d24; }},
    {"shadow-map", "16 bits", [](RenderSettings& s) { s.shadow_map.encoding = DepthEncoding::d16; }},
    {"shadow-map", "packed", [](RenderSettings& s) { s.shadow_map.encoding = DepthEncoding::rgba8_256over255; }},
    {"shadow-volume", "shaded", [](RenderSettings&) {}},
    {"reflective", "poisson", [](RenderSettings& s) { s.reflective.pattern = SamplePattern::poisson; }},
    {"reflective", "polar", [](RenderSettings& s) { s.reflective.gather_scale = 3; }},
    {"light-cookie", "plain", [](RenderSettings&) {}},
    {"light-cookie", "shadows",
     [](RenderSettings& s) {
       s.light_cookie.shadows = true;
       s.light_cookie.rotate_degrees = {20, 30, 40};
     }},
};

class EveryTechnique : public testing::TestWithParam<Way> {
 protected:
  EveryTechnique() {
    settings_.width = 120;
    settings_.height = 90;
    settings_.map_size = 128;
    settings_.layers = true;
    settings_.light_cookie = {.cookie = ninebit::test::noisy_cookie(), .shadows = false};
    settings_.reflective = {.samples = 40, .kernel = 36.0F, .pattern = SamplePattern::polar};
    GetParam().choose(settings_);
  }

  [[nodiscard]] Rendering render() const { return shadow_test::render_by(technique_.name, scene_, settings_); }

  const Technique& technique_ = *find_technique(GetParam().technique);
  const Scene scene_ = ninebit::test::index_room(technique_.lights);
  RenderSettings settings_{};
};

INSTANTIATE_TEST_SUITE_P(Ways, EveryTechnique, testing::ValuesIn(kWays), [](const auto& way) {
  std::string name = std::string(way.param.technique) + '_' + way.param.name;
  for (char& c : name) c = c == '-' || c == ' ' ? '_' : c;
  return name;
});

void expect_same_frame(const Rendering& r, const Rendering& other) {
  for (int c = 0; c < 4; ++c) EXPECT_EQ(r.frame.color(c), other.frame.color(c));
  EXPECT_EQ(r.frame.stencil(), other.frame.stencil());
  EXPECT_EQ(r.frame.depth(), other.frame.depth());
  EXPECT_EQ(r.shadowed, other.shadowed);
}

void expect_same_layers(const std::deque<Layer>& layers, const std::deque<Layer>& others) {
  ASSERT_EQ(layers.size(), others.size());
  for (std::size_t i = 0; i < layers.size(); ++i) {
    EXPECT_EQ(layers[i].samples, others[i].samples) << layers[i].part << '.' << layers[i].channel;
  }
}

TEST_P(EveryTechnique, GivesTheSameBitsForAnyNumberOfThreads) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  std::optional<Rendering> first;
  for (const int threads : {1, 2, 7}) {
    SCOPED_TRACE(std::to_string(threads) + " threads");
    with_threads(threads, [&] {
      const Rendering r = render();
      if (!first) {
        first = r;
        EXPECT_GT(r.lit, 500U);
        EXPECT_EQ(r.shadowed == 0, std::string(GetParam().name) == "plain");
        return;
      }
      expect_same_frame(r, *first);
      expect_same_layers(r.layers, first->layers);
      expect_same_layers(r.maps, first->maps);
      for (std::size_t f = 0; f < r.index_map.size(); ++f) {
        EXPECT_EQ(r.index_map[f].samples, first->index_map[f].samples) << f;
      }
      for (std::size_t i = 0; i < r.facts.size(); ++i) {
        EXPECT_EQ(r.facts[i].value, first->facts[i].value) << r.facts[i].name;
      }
    });
  }
}

// Layers are drawn pass by pass, a picture alone in one go.
TEST_P(EveryTechnique, DrawsTheSameWithoutLayers) {
  const Rendering with = render();
  EXPECT_FALSE(with.layers.empty());
  settings_.layers = false;
  const Rendering without = render();
  EXPECT_TRUE(without.layers.empty());
  EXPECT_EQ(without.maps.size(), with.maps.size());
  expect_same_frame(without, with);
}

// A box from above: its sides stand edge-on to the light's ray through the middle, but turn away from it as seen from
// above. An offset by which the shadow map alone would light everything.
TEST_P(EveryTechnique, WithLightFacingWhatTurnsAwayIsInShadow) {
  if (GetParam().name == std::string("plain")) GTEST_SKIP() << "a cookie without shadows";
  Scene scene = shadow_test::scene_with({3.0F, 2.0F, 6.0F}, {0.0F, 0.0F, 0.0F}, {0.0F, 6.0F, 0.0F});
  shadow_test::add_box(scene, "box", {-1, -1, -1}, {1, 1, 1});
  settings_.light_facing = settings_.evidence = true;
  settings_.shadow_map.polygon_offset = OffsetArguments{0.0F, 15'000'000.0F};
  scene.lights[0].direction = {0.0F, -1.0F, 0.0F};
  scene.lights[0].spot_degrees = 60.0F;
  for (const LightKind kind : {LightKind::point, LightKind::spot, LightKind::directional}) {
    if (!technique_.lights.has(kind)) continue;
    SCOPED_TRACE(static_cast<int>(kind));
    scene.lights[0].kind = kind;
    const auto r = technique_.render(scene, settings_, {});
    ASSERT_TRUE(r.ok()) << r.error().text();
    const auto& polygon = shadow_test::samples_of<std::uint32_t>(r->layers, "polygon", "polygon");
    std::size_t lit = 0, averted = 0;
    const bool by_index = !r->index_map.empty();  // then the halves of the top may shadow each other at their joint
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      if (polygon[i] == 0) continue;
      const glm::uvec3 t = scene.triangles[polygon[i] - 1];
      const bool top = std::min({scene.positions[t.x].y, scene.positions[t.y].y, scene.positions[t.z].y}) == 1.0F;
      const bool dark = r->frame.stencil()[i] != 0;
      ASSERT_TRUE(dark != top || (by_index && top)) << i;
      lit += dark ? 0U : 1U;
      averted += top ? 0U : 1U;
    }
    EXPECT_GT(lit, 100U);
    EXPECT_GT(averted, 200U);
  }
}

TEST_P(EveryTechnique, StopsAfterAnyPass) {
  constexpr int kStep = ninebit::test::kSanitized ? 3 : 1;
  settings_.evidence = technique_.name == "reflective";  // passes of its own
  int passes = 0;
  double last = 0.0;
  const auto count = [&](std::string_view, double done) {
    EXPECT_GE(done, last);
    last = done;
    return ++passes > 0;
  };
  ASSERT_TRUE(technique_.render(scene_, settings_, count).ok());
  EXPECT_GT(passes, 2);
  EXPECT_LE(last, 1.0);
  for (int allowed = 0; allowed < passes; allowed += kStep) {
    int asked = 0;
    const auto stopped =
        technique_.render(scene_, settings_, [&](std::string_view, double) { return asked++ < allowed; });
    ASSERT_FALSE(stopped.ok()) << allowed;
    EXPECT_EQ(stopped.error().fault, Fault::cancelled);
    EXPECT_EQ(asked, allowed + 1);
  }
}

}  // namespace

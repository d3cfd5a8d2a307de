// A watched pixel: what the passes drew there is what the frame shows.
#include <gtest/gtest.h>

#include "combiner_tests/shadow/support.h"
#include "ninebit/combiner/evaluate.h"

namespace {

using namespace ninebit;
using shadow_test::render;

std::vector<std::string> names_of(const Rendering& r) {
  std::vector<std::string> names;
  for (const ProbedPass& pass : r.probed[0]) names.push_back(pass.name);
  return names;
}

RenderSettings tiny_settings() {
  RenderSettings settings = shadow_test::small_settings();
  settings.width = 60;
  settings.height = 45;
  settings.map_size = 64;
  return settings;
}

TEST(ProbedPasses, AgreeWithTheFrame) {
  const Scene scene = shadow_test::square_over_floor();
  const RenderSettings settings = tiny_settings();
  const Rendering whole = render(scene, settings);
  const auto layers = shadow_test::comparison_layers(whole);
  int lit = 0, shadowed = 0, background = 0;
  for (int y = 1; y < settings.height; y += 4) {
    for (int x = 2; x < settings.width; x += 4) {
      RenderSettings watched = settings;
      watched.pixels = {glm::ivec2(x, y)};
      const Rendering r = render(scene, watched);
      ASSERT_EQ(r.frame.stencil(), whole.frame.stencil());
      ASSERT_EQ(r.frame.color(kRed), whole.frame.color(kRed));
      ASSERT_EQ(names_of(r), (std::vector<std::string>{"depth", "comparison", "lit", "shadow"}));
      const auto at = static_cast<std::size_t>(y * settings.width + x);
      const ProbedPass& comparison = r.probed[0][1];
      const ProbedFragment* decided = deciding_fragment(comparison);
      if (layers.polygon[at] == 0) {
        ASSERT_EQ(decided, nullptr);
        ++background;
        continue;
      }
      ASSERT_NE(decided, nullptr);
      ASSERT_EQ(decided->primitive + 1, layers.polygon[at]);
      ASSERT_TRUE(decided->depth_passes);
      for (std::size_t c = 0; c < 3; ++c) {
        ASSERT_EQ(decided->registers[Register::primary][c], layers.primary[c][at]);
        ASSERT_EQ(decided->registers[Register::texture0][c], layers.texture0[c][at]);
      }
      ASSERT_EQ(evaluate(*comparison.program, decided->registers)[kAlpha], layers.output_alpha[at]);
      const bool shadow = whole.frame.stencil()[at] == 1;
      ASSERT_EQ(decided->fate, shadow ? FragmentFate::written : FragmentFate::alpha_failed);
      const ProbedFragment* colored = deciding_fragment(r.probed[0][shadow ? 3 : 2]);
      ASSERT_NE(colored, nullptr);
      ASSERT_EQ(colored->fate, FragmentFate::written);
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(colored->color[static_cast<std::size_t>(c)], whole.frame.color(c)[at]);
      }
      ++(shadow ? shadowed : lit);
    }
  }
  EXPECT_GT(lit, 30);
  EXPECT_GT(shadowed, 5);
  EXPECT_GT(background, 5);
}

// With light_facing, the comparison draws a share of the triangles, which keep the scene's numbers.
TEST(ProbedPasses, NameTheScenesTriangles) {
  Scene scene = shadow_test::scene_with({4.0F, 5.0F, 7.0F}, {0.0F, 0.5F, 0.0F}, {-3.0F, 4.0F, 1.0F});
  shadow_test::add_box(scene, "box", {-1.0F, 0.5F, -1.0F}, {1.0F, 2.0F, 1.0F});
  shadow_test::add_quad(scene, "floor", {{{-4, 0, 4}, {4, 0, 4}, {4, 0, -4}, {-4, 0, -4}}});
  RenderSettings settings = tiny_settings();
  settings.light_facing = true;
  const Rendering whole = render(scene, settings);
  const auto layers = shadow_test::comparison_layers(whole);
  int compared = 0, averted = 0;
  for (int y = 0; y < settings.height; y += 3) {
    for (int x = 0; x < settings.width; x += 3) {
      RenderSettings watched = settings;
      watched.pixels = {glm::ivec2(x, y)};
      const Rendering r = render(scene, watched);
      ASSERT_EQ(names_of(r), (std::vector<std::string>{"depth", "comparison", "averted", "lit", "shadow"}));
      const std::uint32_t polygon = layers.polygon[static_cast<std::size_t>(y * settings.width + x)];
      for (std::size_t pass = 1; pass <= 2; ++pass) {
        const ProbedFragment* decided = deciding_fragment(r.probed[0][pass]);
        if (decided == nullptr) continue;
        ASSERT_EQ(decided->primitive + 1, polygon);
        ++(pass == 1 ? compared : averted);
      }
    }
  }
  EXPECT_GT(compared, 50);
  EXPECT_GT(averted, 10);
}

TEST(ProbedPasses, NoPixelNoPasses) {
  EXPECT_TRUE(render(shadow_test::square_over_floor(), tiny_settings()).probed.empty());
}

TEST(ProbedPasses, APixelOutsideIsAFault) {
  RenderSettings settings = tiny_settings();
  settings.pixels = {glm::ivec2(60, 0)};
  const auto r = find_technique("index-cube")->render(shadow_test::square_over_floor(), settings, {});
  ASSERT_FALSE(r.ok());
  EXPECT_NE(r.error().message.find("(60, 0)"), std::string::npos);
}

// The fragment that was written outranks later ones in the same pixel that only pass the depth test.
TEST(DecidingFragment, WrittenOutranksPassing) {
  const auto fragment = [](std::uint32_t number, FragmentFate fate, bool depth_passes) {
    ProbedFragment f;
    f.primitive = number;
    f.fate = fate;
    f.depth_passes = depth_passes;
    return f;
  };
  ProbedPass pass;
  EXPECT_EQ(deciding_fragment(pass), nullptr);
  pass.fragments = {fragment(0, FragmentFate::depth_failed, false)};
  EXPECT_EQ(deciding_fragment(pass), nullptr);
  pass.fragments.push_back(fragment(1, FragmentFate::alpha_failed, true));
  pass.fragments.push_back(fragment(2, FragmentFate::stencil_failed, true));
  pass.fragments.push_back(fragment(3, FragmentFate::alpha_failed, false));
  EXPECT_EQ(deciding_fragment(pass)->primitive, 2U);
  pass.fragments.push_back(fragment(4, FragmentFate::written, true));
  pass.fragments.push_back(fragment(5, FragmentFate::alpha_failed, true));
  EXPECT_EQ(deciding_fragment(pass)->primitive, 4U);
  pass.fragments.push_back(fragment(6, FragmentFate::written, true));
  EXPECT_EQ(deciding_fragment(pass)->primitive, 6U);
}

}  // namespace

// Effects by what belongs to the pixel: samples, stipple, point sprites, colour keys.
#include <gtest/gtest.h>

#include <string>

#include "ninebit/effect/effect_files.h"
#include "ninebit/effect/effect_json.h"
#include "ninebit/effect/effect_renderer.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

Effect effect_of_text(const std::string& body) {
  const std::string text = R"({"ninebit": "effect", "version": 1, )" + body + "}";
  auto parsed = parse_effect({text, "e.json"});
  EXPECT_TRUE(parsed) << parsed.faults()[0].text();
  Effect effect = parsed ? *parsed : Effect{};
  effect.folder = NINEBIT_SOURCE_DIR "/scenes/effects";
  return effect;
}

EffectRenderer drawn(const Effect& effect) {
  auto renderer = EffectRenderer::make(effect, profiles::nv2a, file_readers());
  EXPECT_TRUE(renderer) << renderer.error().text();
  const Status done = renderer->draw();
  EXPECT_TRUE(done) << done.error().text();
  return std::move(*renderer);
}

std::string fault_of(const Effect& effect, const HardwareProfile& profile) {
  auto renderer = EffectRenderer::make(effect, profile, file_readers());
  if (!renderer) return renderer.error().text();
  const Status done = renderer->draw();
  return done ? "no fault" : done.error().text();
}

const std::string kTorus = R"("scene": {"mesh": "torus:16", "camera": [0, -1.8, 2.2]}, )";
const std::string kTwice = R"("targets": {"m": {"size": 32, "samples": "square_offset_4"}},
  "textures": {"t": {"source": "target:m", "filter": "nearest"}},
  "passes": [{"target": "m", "clear": {"color": [0.2, 0.4, 0.6, 1]}, "primary": "normal"},
             {"target": "m", "clear": {"depth": 1}, "primary": "lambert", "cull": "back"},
             {"draw": "rectangle", "program": "programs/texture0.rc1",
              "units": [{"texture": "t", "coordinates": "screen"}]}])";

// The centre's sample is what a target of one sample has; a texture of the target has a texel for each.
TEST(EffectPixel, TargetsHaveSeveralSamples) {
  const EffectRenderer several = drawn(effect_of_text(kTorus + R"("size": 64, )" + kTwice));
  Effect one = effect_of_text(kTorus + R"("size": 32, )" + kTwice);
  one.targets[0].samples = SampleMode::center_1;
  const EffectRenderer single = drawn(one);
  const Surface& samples = several.target("m")[0];
  const Surface& centres = single.target("m")[0];
  int same_as_centre = 0;
  for (std::size_t y = 0; y < 64; ++y) {
    for (std::size_t x = 0; x < 64; ++x) {
      bool is_same = true;
      for (int c = 0; c < 3; ++c) {
        const std::uint8_t found = several.picture().color(c)[64 * y + x];
        const std::uint8_t centre = centres.color(c)[32 * (y / 2) + x / 2];
        EXPECT_EQ(found, samples.color(c)[64 * y + x]);
        is_same = is_same && found == centre;
        const bool is_centre = x % 2 == 1 && y % 2 == 0;
        EXPECT_TRUE(found == centre || !is_centre) << x << ", " << y;
      }
      same_as_centre += is_same ? 1 : 0;
    }
  }
  EXPECT_GT(same_as_centre, 64 * 64 / 2);
  EXPECT_LT(same_as_centre, 64 * 64 - 300) << "the other samples lie elsewhere";
}

TEST(EffectPixel, SamplesNeedAChipThatHasThem) {
  EXPECT_NE(fault_of(effect_of_text(kTorus + R"("size": 64, )" + kTwice), profiles::geforce2)
                .find("profile geforce2 has no surfaces with several samples for each pixel"),
            std::string::npos);
}

// The pattern's last row is the picture's lowest.
TEST(EffectPixel, StippleIsAsItIsSeen) {
  const EffectRenderer one = drawn(
      effect_of_text(R"("size": 8, "passes": [{"clear": {"color": [0, 0, 0, 1]}, "polygon_stipple": "1000,0110"}])"));
  for (std::size_t y = 0; y < 8; ++y) {
    for (std::size_t x = 0; x < 8; ++x) {
      const char* const row = y % 2 == 0 ? "0110" : "1000";
      EXPECT_EQ(one.picture().color(kRed)[8 * y + x], row[x % 4] == '1' ? 255 : 0) << x << ", " << y;
    }
  }
}

// The rectangle's lower left corner is the middle of a point of 8 pixels, whose upper right quarter is seen.
TEST(EffectPixel, PointSpritesRunAcrossPoints) {
  const Effect effect = effect_of_text(
      R"("size": 16, "textures": {"t": {"source": "gradient", "filter": "nearest"}},
         "passes": [{"polygon_mode": "point", "point_size": 8, "program": "programs/texture0.rc1",
                     "units": [{"texture": "t", "coordinates": "point-sprite"}]}])");
  const EffectRenderer one = drawn(effect);
  for (std::size_t y = 0; y < 4; ++y) {
    for (std::size_t x = 0; x < 5; ++x) {
      const std::size_t s = 256 * (2 * x + 9) / 16;
      EXPECT_EQ(one.picture().color(kRed)[16 * y + x], x < 4 ? s : 0) << x << ", " << y;
    }
  }
  EXPECT_NE(fault_of(effect, profiles::geforce2).find("has no point sprites"), std::string::npos);
}

// Each in one sentence, with the pass that asks for it.
TEST(EffectPixel, WhatTheChipDoesNotHaveIsRefused) {
  const auto says = [](const std::string& body) { return fault_of(effect_of_text(body), profiles::nv2a); };
  EXPECT_EQ(says(R"("size": 4, "depth_stencil": "f16", "passes": [{"name": "p", "stencil": {"pass": "replace"}}])"),
            "pass 'p': the stencil test is enabled, but the depth-stencil format f16 has no stencil bits");
  EXPECT_NE(says(R"("size": 4, "depth_stencil": "w24s8", "passes": [{"name": "p", "depth": {"function": "less"}}])")
                .find("pass 'p': the W buffer w24s8 needs a perspective view"),
            std::string::npos);
  EXPECT_NE(
      says(R"("size": 4, "textures": {"t": {"source": "normalize-cube:16", "filter": "nearest", "border_texels": true}},
                     "passes": [{"name": "p", "program": "programs/texture0.rc1", "units": [{"texture": "t"}]}])")
          .find("pass 'p': texture unit 0: border texels need a 2D image"),
      std::string::npos);
  EXPECT_NE(says(R"("size": 4, "textures": {"t": {"source": "checker:16", "color_key": "rgba:FFFFFFFF"}},
                     "passes": [{"name": "p", "program": "programs/texture0.rc1", "units": [{"texture": "t"}]}])")
                .find("pass 'p': texture unit 0: a colour key needs the nearest texel"),
            std::string::npos);
}

// Half of a checkerboard's texels are the key.
TEST(EffectPixel, ColorKeysKill) {
  const std::string text =
      R"("size": 8, "textures": {"t": {"source": "checker:8", "filter": "nearest", "color_key": "kill:FFFFFFFF"}},
    "passes": [{"clear": {"color": [0, 0, 1, 1]}, "program": "programs/texture0.rc1",
                "units": [{"texture": "t"}]}])";
  const EffectRenderer one = drawn(effect_of_text(text));
  int killed = 0;
  for (std::size_t i = 0; i < 64; ++i) {
    killed += one.picture().color(kBlue)[i] == 255 ? 1 : 0;
    EXPECT_NE(one.picture().color(kRed)[i], 255);
  }
  EXPECT_EQ(killed, 32);
  Effect stages = effect_of_text(text);
  stages.passes[0].state.texture_shader.enabled = true;
  stages.passes[0].state.texture_shader.stage[0].operation = TextureOperation::texture_2d;
  EXPECT_TRUE(drawn(stages).picture().color(kBlue) == one.picture().color(kBlue));
  stages.passes[0].state.texture_shader.stage[0].operation = TextureOperation::cull_fragment;
  EXPECT_NE(fault_of(stages, profiles::nv2a).find("a killing colour key needs a texture-shader stage that reads"),
            std::string::npos);
}

}  // namespace
}  // namespace ninebit::test

#include <gtest/gtest.h>
#include <ninebit/effect/effect_files.h>
#include <ninebit/effect/effect_json.h>

TEST(Examples, EffectFiles) {
  using namespace ninebit;
  const Parsed<Effect> effect = read_effect("scenes/effects/sepia.json");
  ASSERT_TRUE(effect);
  Result<EffectRenderer> renderer = EffectRenderer::make(*effect, profiles::geforce2, file_readers());
  ASSERT_TRUE(renderer.ok()) << renderer.error().text();
  ASSERT_TRUE(renderer->draw().ok());
  const Surface& picture = renderer->picture();
  EXPECT_GT(picture.color(kRed)[0], picture.color(kBlue)[0]);  // brown
}

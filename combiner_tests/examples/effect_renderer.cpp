#include <gtest/gtest.h>
#include <ninebit/effect/effect_renderer.h>

TEST(Examples, EffectRenderer) {
  using namespace ninebit;
  Effect effect{.width = 64, .height = 64};
  EffectPass& pass = effect.passes.emplace_back();
  pass.geometry = EffectGeometry::rectangle;
  pass.primary.constant = {1.0F, 0.5F, 0.0F, 1.0F};
  Result<EffectRenderer> renderer = EffectRenderer::make(effect, profiles::geforce2, {});  // it reads no files
  ASSERT_TRUE(renderer.ok());
  ASSERT_TRUE(renderer->draw().ok());
  EXPECT_EQ(renderer->picture().color(kGreen)[0], 128);
}

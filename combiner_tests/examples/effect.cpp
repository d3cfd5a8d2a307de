#include <gtest/gtest.h>
#include <ninebit/effect/effect.h>

TEST(Examples, Effect) {
  using namespace ninebit;
  Effect effect;
  effect.textures.push_back(*parse_texture_source("checker:64"));
  effect.textures[0].name = "board";
  EffectPass& pass = effect.passes.emplace_back();
  pass.geometry = EffectGeometry::rectangle;
  pass.units[0] = {.texture = "board", .coordinates = *parse_coordinate_source("uv")};
  pass.primary = *parse_color_source("constant:1,0.5,0");
  EXPECT_TRUE(check_effect(effect).empty());

  pass.units[0].texture = "bord";
  EXPECT_EQ(check_effect(effect)[0].part, EffectPart::pass);
}

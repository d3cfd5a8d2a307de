#include <gtest/gtest.h>
#include <ninebit/raster/texture_stages.h>

#include <vector>

TEST(Examples, TextureStages) {
  using namespace ninebit;
  const TextureSamples image{2, 1, std::vector<std::uint8_t>{40, 200}};
  const Result<Texture> texture = make_texture(TextureTarget::texture_2d, InternalFormat::luminance8, {{image}});
  ASSERT_TRUE(texture.ok());
  StageUnits units;
  units.texture[0] = &*texture;
  units.sampler[0] = kNearestSampler;
  TextureShaderState state;
  state.enabled = true;
  state.stage[0].operation = TextureOperation::texture_2d;
  const auto stages = TextureStages::make(profiles::nv2a, state, units);
  ASSERT_TRUE(stages.ok());
  StageInputs inputs;
  inputs.at[0] = {1.5F, 0.0F, 0.0F, 2.0F};  // s / q = 0.75
  EXPECT_EQ(stages->evaluate(inputs).stage[0].codes, (Rgba9{200, 200, 200, 255}));
}

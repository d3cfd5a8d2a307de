#include <gtest/gtest.h>
#include <ninebit/numerics/hardware_profile.h>
#include <ninebit/raster/sampler.h>

#include <vector>

TEST(Examples, Sampler) {
  using namespace ninebit;
  const TextureSamples image{2, 1, std::vector<std::uint8_t>{0, 200}};
  const Result<Texture> texture = make_texture(TextureTarget::texture_2d, InternalFormat::luminance8, {{image}});
  ASSERT_TRUE(texture.ok());
  const Sampler linear{.min_filter = MinFilter::linear, .mag_filter = MagFilter::linear};
  const auto sampler = TextureSampler::make(profiles::geforce2, *texture, linear);
  ASSERT_TRUE(sampler.has_value());
  const float s = 0.5F, t = 0.5F;
  const TextureCoordinates middle{.value = {&s, &t, nullptr}};
  EXPECT_EQ(sampler->texel(middle, 0).value[0], 100);
}

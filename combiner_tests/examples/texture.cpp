#include <gtest/gtest.h>
#include <ninebit/raster/texture.h>

#include <vector>

TEST(Examples, Texture) {
  using namespace ninebit;
  const TextureSamples image{2, 2, std::vector<std::uint8_t>{0, 100, 100, 200}};
  const Result<Texture> small = make_texture(TextureTarget::texture_2d, InternalFormat::luminance8, {{image}});
  ASSERT_TRUE(small.ok());
  EXPECT_FALSE(is_complete(*small, true));
  const Result<Texture> texture = with_mipmaps(*small);
  EXPECT_TRUE(is_complete(*texture, true));
  EXPECT_EQ(texture->faces[0].size(), 2U);
  EXPECT_EQ(cube_coordinate(0, -2, 1).face, CubeFace::negative_y);
}

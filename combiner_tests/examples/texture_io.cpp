#include <gtest/gtest.h>
#include <ninebit/image/texture_io.h>
#include <ninebit/numerics/hardware_profile.h>

#include <filesystem>

TEST(Examples, TextureIo) {
  using namespace ninebit;
  const std::filesystem::path file = "scenes/effects/textures/photograph.png";
  const Result<Texture> texture = read_texture(profiles::geforce2, file, {.mipmaps = true});
  ASSERT_TRUE(texture.ok()) << texture.error().text();
  EXPECT_EQ(texture->format, InternalFormat::rgb8);
  EXPECT_TRUE(is_complete(*texture, true));
  EXPECT_EQ(read_texture(profiles::geforce2, "missing.png").error().file, "missing.png");
}

#include <gtest/gtest.h>
#include <ninebit/effect/generated_textures.h>

TEST(Examples, GeneratedTextures) {
  using namespace ninebit;
  const Result<Texture> normals = normalization_cube_map(32);
  ASSERT_TRUE(normals.ok());
  EXPECT_EQ(normals->face_count(), 6U);
  EXPECT_EQ(range_compressed(-1.0), 0);
  EXPECT_EQ(range_compressed(1.0), 255);
  EXPECT_FALSE(checkerboard(100).ok());  // not a power of two
}

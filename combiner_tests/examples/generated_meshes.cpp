#include <gtest/gtest.h>
#include <ninebit/effect/generated_meshes.h>

TEST(Examples, GeneratedMeshes) {
  using namespace ninebit;
  ASSERT_TRUE(is_generated_mesh("cube"));
  const Result<Scene> cube = generated_mesh("cube");
  EXPECT_EQ(cube->triangles.size(), 12U);
  const Result<Scene> torus = generated_mesh("torus:48");
  EXPECT_EQ(bounds_of(*torus).high.x, 1.0F);
  EXPECT_FALSE(generated_mesh("torus:5000").ok());
}

#include <gtest/gtest.h>
#include <ninebit/scene/scene.h>

TEST(Examples, Scene) {
  using namespace ninebit;
  Scene scene;
  scene.positions = {{0, 0, 0}, {4, 0, 0}, {0, 3, 0}};
  scene.normals.assign(3, {0, 0, 1});
  scene.triangles = {{0, 1, 2}};
  scene.triangle_object = {0};
  scene.triangle_material = {0};
  scene.objects = {{.name = "triangle", .first_triangle = 0, .triangle_count = 1}};
  scene.materials.resize(1);
  EXPECT_TRUE(validate(scene).ok());
  EXPECT_EQ(bounds_of(scene).diagonal(), 5.0F);
  EXPECT_EQ(distance_to_nearest_triangle(scene, {1, 1, 2}), 2.0F);
}

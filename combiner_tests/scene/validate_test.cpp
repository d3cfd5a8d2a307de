// Every promise of Scene, broken one at a time.
#include <functional>

#include "combiner_tests/scene/scene_test_support.h"
#include "combiner_tests/support/special_floats.h"

namespace ninebit::scene_tests {
namespace {

using ninebit::test::kInfinity;
using ninebit::test::kNan;

Scene two_boxes() {
  Scene scene = box({0, 0, 0}, {1, 1, 1});
  add_box(scene, {3, 0, 0}, {4, 1, 1}, "second");
  scene.cameras = {{{9, 9, 9}, {0, 0, 0}, {0, 1, 0}, 50.0F}};
  scene.lights = {{"lamp", {0, 9, 0}, {1, 1, 1}},
                  {.name = "spot", .kind = LightKind::spot},
                  {.name = "sun", .kind = LightKind::directional}};
  return scene;
}

struct Broken {
  const char* name;
  std::function<void(Scene&)> breaks;
  const char* says;
};

class BrokenScene : public ::testing::TestWithParam<Broken> {};

TEST(Validate, AWholeScene) {
  EXPECT_TRUE(validate(two_boxes()));
  // Fields that a kind of light does not use may have any value.
  Scene unused = two_boxes();
  unused.lights[0].direction = {kNan, 0, 0};
  unused.lights[0].spot_degrees = unused.lights[2].spot_degrees = -1.0F;
  EXPECT_TRUE(validate(unused));
  Scene bare = two_boxes();
  bare.cameras.clear();
  bare.lights.clear();
  EXPECT_TRUE(validate(bare));
  // A file whose geometry gives no normal.
  bare.normals.assign(bare.normals.size(), glm::vec3(0));
  EXPECT_TRUE(validate(bare));
}

TEST_P(BrokenScene, Reports) {
  Scene scene = two_boxes();
  GetParam().breaks(scene);
  const Status status = validate(scene);
  ASSERT_FALSE(status);
  EXPECT_NE(status.error().message.find(GetParam().says), std::string::npos) << status.error().message;
  EXPECT_EQ(status.error().fault, Fault::invalid_input);
}

INSTANTIATE_TEST_SUITE_P(
    Scene, BrokenScene,
    ::testing::Values(
        Broken{"NoTriangles", [](Scene& s) { s.triangles.clear(); }, "no triangles"},
        Broken{"FewNormals", [](Scene& s) { s.normals.pop_back(); }, "15 normals for 16 positions"},
        Broken{"ManyNormals", [](Scene& s) { s.normals.emplace_back(0); }, "17 normals for 16 positions"},
        Broken{"FewTriangleObjects", [](Scene& s) { s.triangle_object.pop_back(); }, "objects for 23"},
        Broken{"FewTriangleMaterials", [](Scene& s) { s.triangle_material.pop_back(); }, "materials for 23"},
        Broken{"FirstVertexIndex", [](Scene& s) { s.triangles[5].x = 16; }, "triangle 5 uses vertex 16;"},
        Broken{"LastVertexIndex", [](Scene& s) { s.triangles[23].z = 0xFFFFFFFFU; }, "uses vertex 4294967295"},
        Broken{"ObjectIndex", [](Scene& s) { s.triangle_object[3] = 2; }, "triangle 3 belongs to object 2"},
        Broken{"MaterialIndex", [](Scene& s) { s.triangle_material[7] = 1; }, "triangle 7 has material 1"},
        Broken{"NoObjects", [](Scene& s) { s.objects.clear(); }, "belongs to object 0"},
        Broken{"NoMaterials", [](Scene& s) { s.materials.clear(); }, "has material 0"},
        Broken{"ObjectStartsLate", [](Scene& s) { s.objects[0].first_triangle = 1; }, "object 0 (\"box\")"},
        Broken{"ObjectsOverlap", [](Scene& s) { s.objects[1].first_triangle = 11; }, "object 1 (\"second\")"},
        Broken{"ObjectsOutOfOrder", [](Scene& s) { std::swap(s.objects[0], s.objects[1]); }, "object 0 (\"second\")"},
        Broken{"ObjectTooLong", [](Scene& s) { s.objects[1].triangle_count = 13; }, "object 1 (\"second\")"},
        Broken{"ObjectFarTooLong", [](Scene& s) { s.objects[1].triangle_count = 0xFFFFFFFFU; }, "object 1"},
        Broken{"ObjectTooShort", [](Scene& s) { s.objects[1].triangle_count = 11; }, "cover 23 of 24"},
        Broken{"ForeignTriangle", [](Scene& s) { s.triangle_object[4] = 1; }, "triangle 4 is among those of object 0"},
        Broken{"PositionNan", [](Scene& s) { s.positions[9].y = kNan; }, "position of vertex 9"},
        Broken{"PositionInfinite", [](Scene& s) { s.positions[0].z = -kInfinity; }, "position of vertex 0"},
        Broken{"NormalNan", [](Scene& s) { s.normals[15].x = kNan; }, "normal of vertex 15"},
        Broken{"BaseColor", [](Scene& s) { s.materials[0].base_color.z = kInfinity; }, "material \"plain\""},
        Broken{"CameraPosition", [](Scene& s) { s.cameras[0].position.x = kNan; }, "camera 0"},
        Broken{"CameraTarget", [](Scene& s) { s.cameras[0].look_at.x = kInfinity; }, "camera 0"},
        Broken{"CameraUp", [](Scene& s) { s.cameras[0].up.y = kNan; }, "camera 0"},
        Broken{"CameraFovNan", [](Scene& s) { s.cameras[0].vertical_fov_degrees = kNan; }, "field of view of camera 0"},
        Broken{"CameraFovZero", [](Scene& s) { s.cameras[0].vertical_fov_degrees = 0.0F; }, "is 0 degrees"},
        Broken{"CameraFovWide", [](Scene& s) { s.cameras[0].vertical_fov_degrees = 180.0F; }, "is 180 degrees"},
        Broken{"CameraAtTarget", [](Scene& s) { s.cameras[0].look_at = s.cameras[0].position; }, "camera 0 looks"},
        Broken{"CameraUpAlong", [](Scene& s) { s.cameras[0].up = {-2, -2, -2}; }, "camera 0 looks along"},
        Broken{"CameraWithoutUp", [](Scene& s) { s.cameras[0].up = {0, 0, 0}; }, "camera 0 looks along"},
        Broken{"SecondCamera", [](Scene& s) { s.cameras.push_back({{0, kNan, 0}}); }, "camera 1"},
        Broken{"LightPosition", [](Scene& s) { s.lights[0].position.y = kInfinity; }, "light \"lamp\""},
        Broken{"LightColor", [](Scene& s) { s.lights[0].color.y = kNan; }, "light \"lamp\""},
        Broken{"SpotDirectionNan", [](Scene& s) { s.lights[1].direction.z = kNan; }, "\"spot\" has no valid direction"},
        Broken{"SpotDirectionLong", [](Scene& s) { s.lights[1].direction *= 1.01F; },
               "\"spot\" has no valid direction"},
        Broken{"SpotAngleZero", [](Scene& s) { s.lights[1].spot_degrees = 0.0F; }, "\"spot\" is 0 degrees"},
        Broken{"SpotAngleStraight", [](Scene& s) { s.lights[1].spot_degrees = 180.0F; }, "\"spot\" is 180 degrees"},
        Broken{"SpotAngleNan", [](Scene& s) { s.lights[1].spot_degrees = kNan; }, "opening angle of light \"spot\""},
        Broken{"SunWithoutDirection", [](Scene& s) { s.lights[2].direction = {0, 0, 0}; },
               "\"sun\" has no valid direction"}),
    [](const auto& param) { return std::string(param.param.name); });

TEST(Validate, CompleteSceneRefusesBrokenGeometry) {
  Scene scene = two_boxes();
  scene.triangles[0].x = 1000000;
  const Result<Scene> result = complete_scene(scene, {}, 1.0F);
  ASSERT_FALSE(result);
  EXPECT_NE(result.error().message.find("vertex 1000000"), std::string::npos) << result.error().message;
  scene = two_boxes();
  scene.lights[0].color.x = kNan;
  EXPECT_FALSE(complete_scene(scene, {}, 1.0F));
}

}  // namespace
}  // namespace ninebit::scene_tests

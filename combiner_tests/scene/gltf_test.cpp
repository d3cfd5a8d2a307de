// The node hierarchy of glTF: transforms, mirrors, instances, cameras and lights.
#include <numbers>

#include "combiner_tests/scene/gltf_text.h"
#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

TEST_F(SceneFiles, GltfNestedTransforms) {
  // Parent: a quarter turn about z, then +10 in x. Child: scaled by (2, 3, 1), then +1 in y.
  const Result<Scene> scene = read("t.gltf", triangle_gltf(R"(
      {"name": "up", "children": [1], "translation": [10, 0, 0], "rotation": [0, 0, 0.70710678, 0.70710678]},
      {"name": "leaf", "mesh": 0, "translation": [0, 1, 0], "scale": [2, 3, 1]})",
                                                           "0"));
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  ASSERT_EQ(scene->objects.size(), 1U);
  EXPECT_EQ(scene->objects[0].name, "leaf");
  const glm::uvec3 t = scene->triangles[0];
  expect_near(scene->positions[t.x], {9, 0, 0});
  expect_near(scene->positions[t.y], {9, 2, 0});
  expect_near(scene->positions[t.z], {6, 0, 0});
  expect_near(front_of(*scene, 0), {0, 0, 1});
  EXPECT_EQ(scene->materials[scene->triangle_material[0]].name, "paint");
  EXPECT_EQ(scene->materials[scene->triangle_material[0]].base_color, glm::vec3(0.25F, 0.5F, 0.75F));
}

TEST_F(SceneFiles, GltfMirroredNodeKeepsItsFront) {
  const Result<Scene> scene =
      read("m.gltf", triangle_gltf(R"({"mesh": 0}, {"mesh": 0, "scale": [-1, 1, 1]}, {"mesh": 0, "scale": [1, 1, -2]},
                                 {"mesh": 0, "scale": [-1, -1, 1]})",
                                   "0, 1, 2, 3"));
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  ASSERT_EQ(scene->triangles.size(), 4U);
  // A mirror in x leaves the side that faces +z in front; one in z turns it to -z. Normals go with the fronts.
  const float expected[4] = {1, 1, -1, 1};
  for (std::size_t i = 0; i < 4; ++i) {
    expect_near(front_of(*scene, i), {0, 0, expected[i]});
    for (glm::length_t k = 0; k < 3; ++k) expect_near(scene->normals[scene->triangles[i][k]], {0, 0, expected[i]});
  }
}

TEST_F(SceneFiles, GltfNormalsFollowTheInverseTranspose) {
  // Turned by 45 degrees about y and then flattened to half in x: a normal (1, 0, 1) becomes (2, 0, 1), not (1/2, 0,
  // 1).
  const Result<Scene> scene = read("i.gltf", triangle_gltf(R"({"children": [1], "scale": [0.5, 1, 1]},
      {"mesh": 0, "rotation": [0, 0.38268343, 0, 0.92387953]})",
                                                           "0"));
  ASSERT_TRUE(scene) << scene.error().text();
  expect_near(scene->normals[scene->triangles[0].x], glm::normalize(glm::vec3(2, 0, 1)));
  expect_near(front_of(*scene, 0), glm::normalize(glm::vec3(2, 0, 1)));
}

TEST_F(SceneFiles, GltfNodeWithoutExtentKeepsItsTriangles) {
  const Result<Scene> scene = read("z.gltf", triangle_gltf(R"({"mesh": 0, "scale": [0, 0, 0]})", "0"));
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  EXPECT_EQ(scene->triangles.size(), 1U);
}

TEST_F(SceneFiles, GltfCamerasAndLightsInWorldSpace) {
  const std::string more = R"(, "cameras": [
      {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "zfar": 9, "znear": 0.1}},
      {"type": "perspective", "perspective": {"yfov": 0.9, "aspectRatio": 2.5, "znear": 0.1}}],
    "extensionsUsed": ["KHR_lights_punctual"], "extensions": {"KHR_lights_punctual": {"lights": [
      {"type": "directional"}, {"type": "point", "name": "bulb", "color": [0.2, 0.4, 0.1], "intensity": 900},
      {"type": "spot", "spot": {}}]}})";
  const Result<Scene> scene = read("v.gltf", triangle_gltf(R"({"mesh": 0},
      {"children": [2, 3, 4, 5, 6, 7], "translation": [0, 0, 7], "rotation": [0, 0.70710678, 0, 0.70710678]},
      {"camera": 0}, {"camera": 1, "translation": [1, 2, 0]},
      {"extensions": {"KHR_lights_punctual": {"light": 0}}},
      {"name": "a", "translation": [3, 1, 0], "extensions": {"KHR_lights_punctual": {"light": 1}}},
      {"extensions": {"KHR_lights_punctual": {"light": 2}}},
      {"name": "b", "translation": [0, 1, 4], "extensions": {"KHR_lights_punctual": {"light": 1}}})",
                                                           "0, 1", more));
  ASSERT_TRUE(scene) << scene.error().text();
  // A quarter turn about y takes (x, y, z) to (z, y, -x).
  ASSERT_EQ(scene->cameras.size(), 1U) << "only perspective cameras count";
  const Camera& camera = scene->cameras[0];
  expect_near(camera.position, {0, 2, 6});
  expect_near(glm::normalize(camera.look_at - camera.position), {-1, 0, 0});
  expect_near(camera.up, {0, 1, 0});
  EXPECT_FLOAT_EQ(camera.vertical_fov_degrees, static_cast<float>(0.9 * 180.0 / std::numbers::pi));
  ASSERT_EQ(scene->lights.size(), 4U) << "one for each node";
  using enum LightKind;
  constexpr std::array kKinds{directional, point, spot, point};
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(scene->lights[i].kind, kKinds[i]) << i;
  expect_near(scene->lights[1].position, {0, 1, 4});
  expect_near(scene->lights[3].position, {4, 1, 7});
  EXPECT_EQ(scene->lights[1].name, "bulb");
  expect_near(scene->lights[1].color, {0.5F, 1, 0.25F});
  // They shine along -z of their node, which looks along -x.
  expect_near(scene->lights[0].direction, {-1, 0, 0});
  expect_near(scene->lights[2].direction, {-1, 0, 0});
  EXPECT_FLOAT_EQ(scene->lights[2].spot_degrees, 90.0F) << "the extension's default is pi/4 to each side";
}

// One lamp below a turned, unevenly scaled, mirrored parent, with this spot.
std::string spot_gltf(const std::string& spot, const std::string& scale) {
  return triangle_gltf(
      R"({"mesh": 0}, {"children": [2], "scale": [)" + scale + R"(]},
      {"rotation": [0.38268343, 0, 0, 0.92387953], "extensions": {"KHR_lights_punctual": {"light": 0}}})",
      "0, 1", R"(, "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot": )" + spot + "}]}}");
}

TEST_F(SceneFiles, GltfSpotLightsHaveDirectionAndAngle) {
  // 45 degrees about x take -z to (0, 1, -1); the parent stretches y by 3 and mirrors z.
  const Result<Scene> scene =
      read("s.gltf", spot_gltf(R"({"innerConeAngle": 0.1, "outerConeAngle": 0.3})", "5, 3, -1"));
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  ASSERT_EQ(scene->lights.size(), 1U);
  EXPECT_EQ(scene->lights[0].kind, LightKind::spot);
  expect_near(scene->lights[0].direction, glm::normalize(glm::vec3(0, 3, 1)));
  EXPECT_FLOAT_EQ(scene->lights[0].spot_degrees, static_cast<float>(0.6 * 180.0 / std::numbers::pi));
  const Result<Scene> widest = read("w.gltf", spot_gltf(R"({"outerConeAngle": 1.5707963})", "1, 1, 1"));
  ASSERT_TRUE(widest) << widest.error().text();
  expect_contract(*widest);
  EXPECT_GT(widest->lights[0].spot_degrees, 170.0F);
}

TEST_F(SceneFiles, GltfSpotLightsThatShineNowhereAreRefused) {
  for (const char* angle : {"0", "-0.5", "1.6"}) {
    const Result<Scene> scene =
        read("a.gltf", spot_gltf(std::string(R"({"outerConeAngle": )") + angle + "}", "1, 1, 1"));
    ASSERT_FALSE(scene) << angle;
    EXPECT_NE(scene.error().message.find("outerConeAngle"), std::string::npos) << scene.error().message;
  }
  const Result<Scene> flat = read("f.gltf", spot_gltf("{}", "1, 0, 0"));
  ASSERT_FALSE(flat);
  EXPECT_NE(flat.error().message.find("no direction"), std::string::npos) << flat.error().message;
}

TEST_F(SceneFiles, GltfPrimitivesOfOneNodeAreOneObject) {
  std::string text = triangle_gltf(R"({"name": "both", "mesh": 0})", "0");
  const std::string primitive = R"({"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2,)";
  const std::size_t at = text.find(primitive);
  ASSERT_NE(at, std::string::npos);
  text.insert(at, primitive + R"( "mode": 5}, )");
  const Result<Scene> scene = read("p.gltf", text);
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  EXPECT_EQ(scene->triangles.size(), 2U);
  ASSERT_EQ(scene->objects.size(), 1U);
  EXPECT_EQ(scene->positions.size(), 3U) << "the same corners within one object are shared";
  EXPECT_NE(scene->triangle_material[0], scene->triangle_material[1]);
}

TEST_F(SceneFiles, GltfPicturesSkinsAndAnimationsDoNotMatter) {
  const std::string more = R"(, "images": [{"uri": "gone.png"}], "textures": [{"source": 0}], "samplers": [7],
    "skins": [{"joints": [99]}], "animations": [{"channels": [{"sampler": 5}], "samplers": 4}])";
  const Result<Scene> scene =
      read("p.gltf", triangle_gltf(R"({"mesh": 0, "skin": 0, "name": "\"\u00e9\ud83d\ude00\n"})", "0", more));
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->triangles.size(), 1U);
  EXPECT_EQ(scene->objects[0].name, "\"\xC3\xA9\xF0\x9F\x98\x80\n");
}

TEST_F(SceneFiles, GlbFromTheSameParts) {
  const std::string data = triangle_bytes();
  std::string json = triangle_gltf(R"({"mesh": 0})", "0");
  const std::size_t uri = json.find(R"(, "uri")");
  json.erase(uri, json.find("\"}]", uri) + 1 - uri);
  json.resize((json.size() + 3) / 4 * 4, ' ');
  std::string binary = data;
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string file = "glTF";
  put(file, 2, 4);
  put(file, static_cast<std::uint32_t>(28 + json.size() + binary.size()), 4);
  put(file, static_cast<std::uint32_t>(json.size()), 4);
  file += "JSON" + json;
  put(file, static_cast<std::uint32_t>(binary.size()), 4);
  file += std::string("BIN\0", 4) + binary;
  const Result<Scene> scene = read("g.glb", file);
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->triangles.size(), 1U);
  // Cut at any place, it is refused, and never by a crash.
  for (std::size_t size = 0; size < file.size(); size += 3) {
    const Result<Scene> cut = read("cut.glb", std::string_view(file).substr(0, size));
    ASSERT_FALSE(cut) << size;
  }
}

}  // namespace
}  // namespace ninebit::scene_tests

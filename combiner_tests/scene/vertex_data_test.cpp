// Texture coordinates and colours of vertices.
#include <limits>

#include "combiner_tests/scene/gltf_text.h"
#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

// A triangle with texture coordinates as bytes and colours as shorts, and one without either, which shares its corners.
std::string painted_gltf() {
  std::string colors;
  for (const unsigned value : {65535U, 0U, 0U, 0U, 65535U, 13107U, 0U, 0U, 65535U}) put(colors, value, 2);
  return vertex_data_gltf(R"({"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 3, "COLOR_0": 4}, "indices": 2},
    {"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2})",
                          R"(,
    {"bufferView": 4, "componentType": 5123, "normalized": true, "count": 3, "type": "VEC3"})",
                          colors);
}

TEST_F(SceneFiles, GltfKeepsTextureCoordinatesAndColors) {
  const Result<Scene> scene = read("p.gltf", painted_gltf());
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  ASSERT_EQ(scene->texture_coordinates.size(), 6U) << "corners with other data are other vertices";
  ASSERT_EQ(scene->colors.size(), 6U);
  const glm::uvec3 painted = scene->triangles[0], plain = scene->triangles[1];
  EXPECT_EQ(scene->texture_coordinates[painted.x], glm::vec2(0.0F, 0.0F));
  EXPECT_EQ(scene->texture_coordinates[painted.y], glm::vec2(1.0F, 0.2F));
  EXPECT_EQ(scene->texture_coordinates[painted.z], glm::vec2(0.0F, 1.0F));
  EXPECT_EQ(scene->colors[painted.x], glm::vec4(1, 0, 0, 1));
  EXPECT_EQ(scene->colors[painted.y], glm::vec4(0, 1, 0.2F, 1));
  for (glm::length_t i = 0; i < 3; ++i) {
    EXPECT_EQ(scene->positions[plain[i]], scene->positions[painted[i]]);
    EXPECT_EQ(scene->texture_coordinates[plain[i]], glm::vec2(0.0F));
    EXPECT_EQ(scene->colors[plain[i]], glm::vec4(1.0F));
  }
}

TEST_F(SceneFiles, FilesWithoutThemHaveNone) {
  const Result<Scene> scene = read("n.gltf", triangle_gltf(R"({"mesh": 0})", "0"));
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_TRUE(scene->texture_coordinates.empty());
  EXPECT_TRUE(scene->colors.empty());
}

TEST_F(SceneFiles, ObjCountsTextureCoordinatesFromTheBottom) {
  const Result<Scene> scene = read("t.obj",
                                   "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0.25\nvt 0 1 0\nvt nan 7\n"
                                   "f 1 2 3\nf 1/1 2/2 3/3\nf 1/-1 2/2 3/3\n");
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  ASSERT_EQ(scene->texture_coordinates.size(), scene->positions.size());
  const glm::uvec3 bare = scene->triangles[0], mapped = scene->triangles[1], odd = scene->triangles[2];
  EXPECT_EQ(scene->texture_coordinates[bare.x], glm::vec2(0.0F));
  EXPECT_EQ(scene->texture_coordinates[mapped.x], glm::vec2(0.0F, 1.0F));
  EXPECT_EQ(scene->texture_coordinates[mapped.y], glm::vec2(1.0F, 0.75F));
  EXPECT_EQ(scene->texture_coordinates[mapped.z], glm::vec2(0.0F, 0.0F));
  EXPECT_EQ(scene->texture_coordinates[odd.x], glm::vec2(0.0F)) << "not finite";
  EXPECT_EQ(odd.y, mapped.y);
}

TEST_F(SceneFiles, PlyHasSecondaryColoursAndFogFactors) {
  const std::string vertices =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "property uchar secondary_red\nproperty uchar secondary_green\nproperty uchar secondary_blue\n";
  const std::string faces = "element face 2\nproperty list uchar int vertex_indices\nend_header\n";
  // The last vertex lies at the place of the first.
  const Result<Scene> read_one = read("s.ply", vertices + "property float fog_factor\n" + faces +
                                                   "0 0 0 255 51 0 0.25\n3 0 0 0 0 255 1\n0 5 0 0 0 0 1\n"
                                                   "0 0 0 255 51 0 0.75\n3 0 1 2\n3 3 1 2\n");
  ASSERT_TRUE(read_one) << read_one.error().text();
  expect_contract(*read_one);
  EXPECT_EQ(read_one->positions.size(), 4U) << "corners with other factors are other vertices";
  EXPECT_EQ(read_one->fog_factors, (std::vector<float>{0.25F, 1.0F, 1.0F, 0.75F}));
  ASSERT_EQ(read_one->secondary_colors.size(), 4U);
  EXPECT_EQ(read_one->secondary_colors[0], glm::vec4(1, 0.2F, 0, 1));
  EXPECT_TRUE(read_one->colors.empty());
  const Result<Scene> with_floor = complete_scene(*read_one, {}, 1.0F);
  ASSERT_TRUE(with_floor) << with_floor.error().text();
  EXPECT_EQ(with_floor->fog_factors.back(), 1.0F);
  EXPECT_EQ(with_floor->secondary_colors.back(), glm::vec4(0, 0, 0, 1));
  EXPECT_TRUE(validate(*with_floor));

  // Without fog, both corners are one vertex. An alpha is read.
  const Result<Scene> without = read("a.ply", vertices + "property uchar secondary_alpha\n" + faces +
                                                  "0 0 0 255 51 0 51\n3 0 0 0 0 255 0\n0 5 0 0 0 0 0\n"
                                                  "0 0 0 255 51 0 51\n3 0 1 2\n3 3 1 2\n");
  ASSERT_TRUE(without) << without.error().text();
  EXPECT_TRUE(without->fog_factors.empty());
  ASSERT_EQ(without->secondary_colors.size(), 3U);
  EXPECT_EQ(without->secondary_colors[0], glm::vec4(1, 0.2F, 0, 0.2F));
}

// Bytes are scaled as those of colours are; what is no colour or factor is a fault, not another value.
TEST_F(SceneFiles, PlySecondaryColoursAndFogFactorsAreExact) {
  const std::string start =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const auto triangle = [&](const std::string& properties, const std::string& values) {
    return start + properties + "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0 " + values +
           "\n3 0 0 " + values + "\n0 5 0 " + values + "\n3 0 1 2\n";
  };
  const Result<Scene> bytes = read("b.ply", triangle("property uchar fog_factor\n", "51"));
  ASSERT_TRUE(bytes) << bytes.error().text();
  EXPECT_EQ(bytes->fog_factors, std::vector<float>(3, 0.2F));
  const auto refused = [&](const std::string& properties, const std::string& values, const std::string& why) {
    const Result<Scene> scene = read("r.ply", triangle(properties, values));
    ASSERT_FALSE(scene) << why;
    EXPECT_NE(scene.error().text().find(why), std::string::npos) << scene.error().text();
  };
  const std::string fog = "property float fog_factor\n", red = "property float secondary_red\n",
                    green = "property float secondary_green\n", blue = "property float secondary_blue\n";
  refused(fog, "7", "r.ply:11: vertex 0 has fog_factor 7; expected a number from 0 to 1");
  refused(fog, "-0.5", "vertex 0 has fog_factor -0.5");
  refused(fog, "nan", "vertex 0 has fog_factor nan");
  refused(red + green + blue, "0 nan 0", "vertex 0 has secondary_green nan");
  refused(red + green + blue, "0 0 2", "vertex 0 has secondary_blue 2");
  refused(red + green, "0 0", "declares a part of a secondary colour; expected secondary_blue, too");
  refused("property float secondary_alpha\n", "0", "expected secondary_red and secondary_green and secondary_blue");
}

TEST_F(SceneFiles, AFloorHasThemToo) {
  const Result<Scene> read_one = read("f.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n");
  ASSERT_TRUE(read_one);
  const Result<Scene> scene = complete_scene(*read_one, {}, 1.0F);
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->objects.back().name, "floor");
  EXPECT_EQ(scene->texture_coordinates.size(), scene->positions.size());
  EXPECT_TRUE(validate(*scene));
}

TEST(Validate, DataForSomeVerticesIsAFault) {
  Scene scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.normals.assign(3, {0, 0, 1});
  scene.triangles = {{0, 1, 2}};
  scene.triangle_object = {0};
  scene.triangle_material = {0};
  scene.objects = {{"o", 0, 1}};
  scene.materials = {{"m", glm::vec3(1.0F)}};
  EXPECT_TRUE(validate(scene));
  scene.texture_coordinates.assign(2, glm::vec2(0.0F));
  EXPECT_FALSE(validate(scene));
  scene.texture_coordinates.assign(3, glm::vec2(std::numeric_limits<float>::quiet_NaN()));
  EXPECT_FALSE(validate(scene));
  scene.texture_coordinates.clear();
  scene.colors.assign(4, glm::vec4(1.0F));
  EXPECT_FALSE(validate(scene));
  scene.colors.clear();
  scene.secondary_colors.assign(3, glm::vec4(std::numeric_limits<float>::infinity()));
  EXPECT_FALSE(validate(scene));
  scene.secondary_colors.clear();
  scene.fog_factors.assign(2, 1.0F);
  EXPECT_FALSE(validate(scene));
  scene.fog_factors.assign(3, std::numeric_limits<float>::quiet_NaN());
  EXPECT_FALSE(validate(scene));
}

}  // namespace
}  // namespace ninebit::scene_tests

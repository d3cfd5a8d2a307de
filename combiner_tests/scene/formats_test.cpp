// Each format: real files with known numbers, and small ones whose every value is known.
#include <set>
#include <tuple>

#include "combiner_tests/scene/gltf_text.h"
#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

struct RealFile {
  const char* path;
  std::size_t triangles;
  std::size_t objects;
};

class RealFiles : public ::testing::TestWithParam<RealFile> {};

TEST_P(RealFiles, ReadsEveryTriangle) {
  ASSERT_TRUE(std::filesystem::exists(GetParam().path)) << "install glmark2-data and assimp-testmodels";
  const Result<Scene> scene = read_scene(GetParam().path);
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->triangles.size(), GetParam().triangles);
  EXPECT_EQ(scene->objects.size(), GetParam().objects);
  EXPECT_EQ(scene->name, std::filesystem::path(GetParam().path).filename().string());
  expect_contract(*scene);
}

// The scene that comes back from a child process is the one that is read here.
TEST_P(RealFiles, AreTheSameInAChildProcess) {
  const Result<Scene> here = read_scene(GetParam().path);
  const Result<Scene> there = read_scene(GetParam().path, {.isolated = true});
  ASSERT_TRUE(here && there) << (here ? there : here).error().text();
  EXPECT_EQ(here->positions, there->positions);
  EXPECT_EQ(here->normals, there->normals);
  EXPECT_EQ(here->triangles, there->triangles);
  EXPECT_EQ(here->triangle_object, there->triangle_object);
  EXPECT_EQ(here->triangle_material, there->triangle_material);
  EXPECT_EQ(here->materials.size(), there->materials.size());
  EXPECT_EQ(here->lights.size(), there->lights.size());
  ASSERT_EQ(here->cameras.size(), there->cameras.size());
  for (std::size_t i = 0; i < here->cameras.size(); ++i) {
    EXPECT_EQ(here->cameras[i].position, there->cameras[i].position);
    EXPECT_EQ(here->cameras[i].look_at, there->cameras[i].look_at);
  }
}

#define ASSIMP_MODELS "/usr/share/assimp/models/"
#define GLMARK_MODELS "/usr/share/glmark2/models/"
INSTANTIATE_TEST_SUITE_P(
    Packages, RealFiles,
    ::testing::Values(
        RealFile{GLMARK_MODELS "bunny.obj", 69666, 1}, RealFile{GLMARK_MODELS "horse.3ds", 7172, 1},
        RealFile{GLMARK_MODELS "asteroid-high.3ds", 48000, 1}, RealFile{GLMARK_MODELS "cube.3ds", 12, 1},
        RealFile{ASSIMP_MODELS "3DS/RotatingCube.3DS", 12, 1}, RealFile{ASSIMP_MODELS "3DS/test1.3ds", 108, 9},
        RealFile{ASSIMP_MODELS "OBJ/spider.obj", 1368, 19}, RealFile{ASSIMP_MODELS "OBJ/box.obj", 12, 1},
        RealFile{ASSIMP_MODELS "OBJ/concave_polygon.obj", 64, 1}, RealFile{ASSIMP_MODELS "OBJ/testmixed.obj", 12, 1},
        RealFile{ASSIMP_MODELS "OFF/Wuson.off", 3732, 1}, RealFile{ASSIMP_MODELS "PLY/Wuson.ply", 3732, 1},
        RealFile{ASSIMP_MODELS "PLY/cube_binary.ply", 12, 1},
        RealFile{ASSIMP_MODELS "glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb", 121496, 67},
        RealFile{ASSIMP_MODELS "glTF2/BoxTextured-glTF/BoxTextured.gltf", 12, 1},
        RealFile{ASSIMP_MODELS "glTF2/BoxTextured-glTF-Embedded/BoxTextured.gltf", 12, 1},
        RealFile{ASSIMP_MODELS "glTF2/BoxBadNormals-glTF-Binary/BoxBadNormals.glb", 12, 1},
        RealFile{ASSIMP_MODELS "STL/Spider_ascii.stl", 1368, 1},
        RealFile{ASSIMP_MODELS "STL/Spider_binary.stl", 1368, 1}, RealFile{ASSIMP_MODELS "Collada/duck.dae", 4212, 1},
        RealFile{ASSIMP_MODELS "Collada/COLLADA.dae", 6722, 2}, RealFile{ASSIMP_MODELS "FBX/spider.fbx", 1368, 19},
        RealFile{ASSIMP_MODELS "FBX/box.fbx", 12, 1},
        RealFile{ASSIMP_MODELS "glTF/BoxTextured-glTF/BoxTextured.gltf", 12, 1},
        RealFile{ASSIMP_MODELS "glTF/CesiumMilkTruck/CesiumMilkTruck.gltf", 3624, 3}),
    [](const auto& instance) {
      std::string name = std::to_string(instance.index) + std::filesystem::path(instance.param.path).stem().string();
      std::erase_if(name, [](char c) { return std::isalnum(static_cast<unsigned char>(c)) == 0; });
      return name;
    });

TEST_F(SceneFiles, BunnyKeepsTheFilesOrderAndSharing) {
  const std::filesystem::path file = GLMARK_MODELS "bunny.obj";
  const Result<Scene> scene = read_scene(file);
  ASSERT_TRUE(scene);
  std::vector<glm::vec3> vertices;
  std::set<std::tuple<float, float, float>> used;
  std::ifstream stream(file);
  std::string word;
  std::size_t face = 0;
  while (stream >> word) {
    if (word == "v") {
      glm::vec3 v;
      stream >> v.x >> v.y >> v.z;
      vertices.push_back(v);
    } else if (word == "f") {
      for (glm::length_t k = 0; k < 3; ++k) {
        std::string corner;
        stream >> corner;
        const glm::vec3 expected = vertices.at(std::stoul(corner) - 1);
        ASSERT_LT(face, scene->triangles.size());
        const glm::vec3 actual = scene->positions[scene->triangles[face][k]];
        ASSERT_LT(glm::distance(actual, expected), 1e-6F) << "face " << face;
        used.emplace(actual.x, actual.y, actual.z);
      }
      ++face;
    }
  }
  EXPECT_EQ(face, 69666U);
  EXPECT_EQ(scene->positions.size(), used.size()) << "the file has no normals: one vertex a position";
}

constexpr std::string_view kSquareObj =
    "# a comment\r\nv 0 0 0\r\nv 2 0 0 # another\r\nv 2 +2.0 0\r\nv 0 2e0 0\r\nf 1 2 3 \\\r\n 4\r\nf -4 -3 -2 # the "
    "last\r\n";

TEST_F(SceneFiles, ObjPolygonsAndRelativeIndices) {
  const Result<Scene> scene = read("square.OBJ", kSquareObj);
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  ASSERT_EQ(scene->triangles.size(), 3U);
  EXPECT_EQ(scene->positions.size(), 4U);
  for (std::size_t i = 0; i < 3; ++i) expect_near(front_of(*scene, i), {0, 0, 1});
  for (const glm::vec3& normal : scene->normals) expect_near(normal, {0, 0, 1});
}

TEST_F(SceneFiles, ObjNormalsOfTheFileAreKept) {
  const Result<Scene> scene = read("n.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 3 4\nvn 0 0 0\nf 1//1 2//1 3//2\n");
  ASSERT_TRUE(scene) << scene.error().text();
  const glm::uvec3 t = scene->triangles[0];
  expect_near(scene->normals[t.x], {0, 0.6F, 0.8F});
  expect_near(scene->normals[t.z], {0, 0, 1});  // none in the file: computed
}

TEST_F(SceneFiles, MissingNormalsAreWeightedByArea) {
  // Two triangles share an edge; areas 1/2 facing +z and 1 facing +x.
  const Result<Scene> scene = read("a.obj", "v 0 0 0\nv 0 1 0\nv -1 0 0\nv 0 0 -2\nf 1 2 3\nf 1 4 2\n");
  ASSERT_TRUE(scene) << scene.error().text();
  ASSERT_EQ(scene->positions.size(), 4U);
  const glm::vec3 expected = glm::normalize(front_of(*scene, 0) * 0.5F + front_of(*scene, 1) * 1.0F);
  expect_near(scene->normals[scene->triangles[0].x], expected);
}

TEST_F(SceneFiles, DegenerateTrianglesAreKept) {
  const Result<Scene> scene = read("d.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 1 2\nf 1 2 3\nf 3 3 3\n");
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  EXPECT_EQ(scene->triangles.size(), 3U);
  EXPECT_EQ(scene->triangles[0].x, scene->triangles[0].y);
}

TEST_F(SceneFiles, LinesAndPointsAreLeftOut) {
  const Result<Scene> scene = read("l.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2\np 3\nf 1 2 3\n");
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->triangles.size(), 1U);
  EXPECT_EQ(scene->positions.size(), 3U);
}

TEST_F(SceneFiles, OffWithCommentsAndPolygons) {
  const Result<Scene> scene = read(
      "s.off",
      "# one\nOFF # two\n4 2 0\n\n0 0 0\n# three\n1 0 0 # four\n1 1 0\n0 1 0\n#\n4 0 1 2 3 0.5 0.5 0.5\n3 0 2 1\n");
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  ASSERT_EQ(scene->triangles.size(), 3U);
  expect_near(front_of(*scene, 0), {0, 0, 1});
  expect_near(front_of(*scene, 2), {0, 0, -1});
}

TEST_F(SceneFiles, PlyTextAndBothBinaryOrders) {
  const std::string rest =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n";
  const Result<Scene> text = read("t.ply", "ply\nformat ascii 1.0\n" + rest + "0 0 0\n3 0 0\n0 5 0\n3 0 1 2\n");
  std::string little = "ply\nformat binary_little_endian 1.0\n" + rest;
  std::string big = "ply\nformat binary_big_endian 1.0\n" + rest;
  const auto append = [&](std::uint32_t value, int bytes) {
    put(little, value, bytes);
    for (int i = bytes; i-- > 0;) big.push_back(static_cast<char>((value >> (8 * i)) & 255U));
  };
  for (const float value : {0.F, 0.F, 0.F, 3.F, 0.F, 0.F, 0.F, 5.F, 0.F})
    append(std::bit_cast<std::uint32_t>(value), 4);
  append(3, 1);
  for (const std::uint32_t index : {0U, 1U, 2U}) append(index, 4);
  const Result<Scene> small_end = read("l.ply", little);
  const Result<Scene> big_end = read("b.ply", big);
  for (const Result<Scene>* scene : {&text, &small_end, &big_end}) {
    ASSERT_TRUE(*scene) << scene->error().text();
    ASSERT_EQ((*scene)->triangles.size(), 1U);
    EXPECT_EQ(bounds_of(**scene).high, glm::vec3(3, 5, 0));
  }
}

TEST_F(SceneFiles, ThreeDsCameraAndLight) {
  std::string camera;
  for (const float value : {10.F, 0.F, 2.F, 0.F, 0.F, 2.F, 0.F, 2400.F / 60.F}) put(camera, value);
  std::string light;
  for (const float value : {1.F, 2.F, 3.F}) put(light, value);
  std::string color;
  for (const float value : {0.5F, 0.25F, 0.F}) put(color, value);
  const std::string spot = chunk_3ds(0x4600, light + chunk_3ds(0x4610, std::string(20, '\0')));
  const auto object = [](const char* name, const std::string& body) {
    return chunk_3ds(0x4000, std::string(name) + '\0' + body);
  };
  const Result<Scene> scene =
      read("v.3ds", triangle_3ds(2, object("cam", chunk_3ds(0x4700, camera)) + object("spot", spot) +
                                        object("lamp", chunk_3ds(0x4600, light + chunk_3ds(0x0010, color)))));
  ASSERT_TRUE(scene) << scene.error().text();
  // The format has z up; Assimp turns it to y up, (x, y, z) to (x, z, -y), and so must the rest be.
  expect_near(bounds_of(*scene).low, {0, 0, -1});
  ASSERT_EQ(scene->cameras.size(), 1U);
  expect_near(scene->cameras[0].position, {10, 2, 0});
  expect_near(scene->cameras[0].look_at, {0, 2, 0});
  expect_near(scene->cameras[0].up, {0, 1, 0});
  // 60 degrees across a 4:3 screen: tan(v / 2) = tan(30) * 3 / 4.
  EXPECT_NEAR(scene->cameras[0].vertical_fov_degrees, 46.8265F, 1e-3F);
  ASSERT_EQ(scene->lights.size(), 1U);
  EXPECT_EQ(scene->lights[0].name, "lamp");
  expect_near(scene->lights[0].position, {1, 3, -2});
  expect_near(scene->lights[0].color, {1, 0.5F, 0});
}

}  // namespace
}  // namespace ninebit::scene_tests

// Files that once crashed the reader, kept it busy without end or were refused although they are right.
#include <chrono>

#include "combiner_tests/scene/gltf_text.h"
#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

const std::filesystem::path kHostile = NINEBIT_SOURCE_DIR "/combiner_tests/scene/hostile";

struct Hostile {
  const char* file;
  std::size_t triangles;  // 0: it is refused
  const char* says = "";
};

TEST(Hostile, EachIsReadOrRefusedInOneLine) {
  const std::vector<Hostile> all{
      {"abs.gltf", 0, "'/etc/passwd' is an absolute path"},
      {"rel.gltf", 0, "leaves the folder"},
      {"b64.gltf", 0, "declares 36 bytes and has 35"},
      {"lit.gltf", 0, "'f%' cannot be opened"},
      {"sp.gltf", 1},
      {"c.obj", 1},
      {"m.obj", 1},
      {"n.obj", 1},
      {"d10.off", 9},
      {"d12.off", 11},
      {"disc1100.off", 1098},
      {"long.off", 1},
      {"loop.ply", 1},
      {"library1/a.obj", 10},
      {"library2/a.obj", 12},
      {"library3/a.obj", 12},
      {"library4/a.obj", 13},
      // Assimp gives its reason, or crashes in its child process, as it does under a sanitizer.
      {"chunks1.3ds", 0},
      {"chunks2.3ds", 0},
      {"chunks3.3ds", 0},
      {"chunks4.3ds", 0},
      {"chunks5.3ds", 0},
      {"chunks6.3ds", 0},
  };
  for (const Hostile& one : all) {
    const Result<Scene> scene = read_scene(kHostile / one.file, {.isolated = true});  // Assimp leaks on some of them
    ASSERT_EQ(scene.ok(), one.triangles > 0) << one.file << (scene ? "" : ": " + scene.error().message);
    if (scene) {
      EXPECT_EQ(scene->triangles.size(), one.triangles) << one.file;
      expect_contract(*scene);
    } else {
      EXPECT_NE(scene.error().message.find(one.says), std::string::npos) << one.file << scene.error().message;
      EXPECT_EQ(scene.error().message.find("root:"), std::string::npos) << one.file << " quotes another file";
    }
  }
}

TEST(Hostile, MaterialsComeFromTheNamedLibrary) {
  for (const char* file : {"m.obj", "n.obj"}) {
    const Result<Scene> scene = read_scene(kHostile / file);
    ASSERT_TRUE(scene) << file;
    EXPECT_EQ(scene->materials[scene->triangle_material[0]].base_color, glm::vec3(1, 0, 0)) << file;
    EXPECT_TRUE(scene->notes.empty()) << file;
  }
}

// Results are no larger than their inputs allow: each of these took minutes, or gigabytes, or both.
class Amounts : public SceneFiles {
 protected:
  void expect_quick(const std::string& name, const std::string& content, std::size_t triangles,
                    const std::string& says = "") const {
    const auto start = std::chrono::steady_clock::now();
    const Result<Scene> scene = read(name, content);
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
    ASSERT_EQ(scene.ok(), triangles > 0) << name << (scene ? "" : ": " + scene.error().message);
    if (scene) {
      EXPECT_EQ(scene->triangles.size(), triangles) << name;
    } else {
      EXPECT_NE(scene.error().message.find(says), std::string::npos) << scene.error().message;
    }
    EXPECT_LT(time.count(), 20.0) << name;  // for a build with sanitizers on a busy machine
  }
};

const std::string kThreeCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

TEST_F(Amounts, ObjGroupsMaterialsAndLibraries) {
  std::string groups = kThreeCorners;
  std::string materials = kThreeCorners;
  std::string both = "mtllib big.mtl\n" + kThreeCorners;
  std::string library;
  for (int i = 0; i < 100000; ++i) {
    const std::string name = "a" + std::to_string(i) + "\n";
    groups += "g " + name + "f 1 2 3\n";
    materials += "usemtl " + name + "f 1 2 3\n";
    both += "g " + name + "usemtl " + name + "f 1 2 3\n";
    library += "newmtl " + name + "Kd 1 0 0\n";
  }
  write("big.mtl", library);
  expect_quick("g.obj", groups, 100000);
  expect_quick("m.obj", materials, 100000);
  expect_quick("b.obj", both, 100000);
}

// One large group leaves large tables: the small ones after it must not pay for them.
TEST_F(Amounts, ObjSmallGroupsAfterALargeOne) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "v " + std::to_string(i) + " " + std::to_string(i % 977) + " 0\n";
  text += "g large\n";
  for (int i = 1; i < 99990; ++i)
    text += "f " + std::to_string(i) + " " + std::to_string(i + 1) + " " + std::to_string(i + 2) + "\n";
  for (int i = 0; i < 50000; ++i) text += "g b" + std::to_string(i) + "\nf 1 2 3\n";
  expect_quick("l.obj", text, 149989);
}

TEST_F(Amounts, ObjTooManyLibraries) {
  std::string text;
  for (int i = 0; i < 300; ++i) text += "mtllib a" + std::to_string(i) + ".mtl\n";
  expect_quick("l.obj", text + kThreeCorners + "f 1 2 3\n", 0, "more than 256 material libraries");
}

// A snake of corners has few ears at any time.
TEST_F(Amounts, ConcavePolygons) {
  std::string corners;
  std::string face = "f";
  constexpr int kHalf = 1024;
  for (int i = 0; i < kHalf; ++i) corners += "v " + std::to_string(i) + " " + std::to_string(1 + i % 2) + " 0\n";
  for (int i = kHalf; i-- > 0;) corners += "v " + std::to_string(i) + " " + std::to_string(0.5 + i % 2) + " 0\n";
  for (int i = 1; i <= 2 * kHalf; ++i) face += " " + std::to_string(i);
  expect_quick("one.obj", corners + face + "\n", 2 * kHalf - 2);
  std::string many = corners;
  for (int i = 0; i < 40; ++i) many += face + "\n";
  expect_quick("many.obj", many, 0, "too many large concave polygons");
}

// Primitives share accessors of 65,536 vertices, of which each uses three.
std::string shared_gltf(std::size_t primitives, std::size_t nodes, std::size_t corners) {
  std::string text = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0)";
  for (std::size_t i = 1; i < nodes; ++i) text += "," + std::to_string(i);
  text += R"(]}], "nodes": [{"mesh": 0})";
  for (std::size_t i = 1; i < nodes; ++i) text += R"(,{"mesh": 0})";
  text += R"(], "meshes": [{"primitives": [)";
  for (std::size_t i = 0; i < primitives; ++i)
    text += std::string(i > 0 ? "," : "") + R"({"attributes": {"POSITION": 0}, "indices": 1})";
  return text + R"(]}], "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 65536},
    {"bufferView": 1, "componentType": 5123, "type": "SCALAR", "count": )" +
         std::to_string(corners) + R"(}], "bufferViews": [{"buffer": 0, "byteLength": 786432},
    {"buffer": 0, "byteOffset": 786432, "byteLength": )" +
         std::to_string(2 * corners) + R"(}], "buffers": [{"byteLength": )" + std::to_string(786432 + 2 * corners) +
         R"(, "uri": "shared.bin"}]})";
}

TEST_F(Amounts, GltfPrimitivesAndNodesThatShare) {
  std::string data(786432, '\0');
  for (std::size_t i = 0; i < 3 * 3000; ++i) put(data, static_cast<std::uint32_t>(i % 65536), 2);
  write("shared.bin", data);
  expect_quick("p.gltf", shared_gltf(20000, 1, 3), 20000);
  expect_quick("n.gltf", shared_gltf(1, 20000, 3), 20000);
  // 3,000 triangles 4,000 times, in 60 KB and a buffer of 800 KB.
  expect_quick("b.gltf", shared_gltf(1, 4000, 9000), 0, "its nodes place more than");
  expect_quick("q.gltf", shared_gltf(4000, 1, 9000), 0, "its nodes place more than");
  expect_quick("both.gltf", shared_gltf(70, 70, 9000), 0, "its nodes place more than");
}

TEST_F(Amounts, GltfElementsThatOverlap) {
  write("shared.bin", std::string(786438, '\0'));
  std::string text = shared_gltf(1, 1, 3);
  const std::string view = R"({"buffer": 0, "byteLength": 786432})";
  text.replace(text.find(view), view.size(), R"({"buffer": 0, "byteLength": 786432, "byteStride": 4})");
  expect_quick("o.gltf", text, 0, "elements that do not overlap");
}

TEST_F(Amounts, GltfTooManyBuffers) {
  std::string text = R"({"asset": {"version": "2.0"}, "scenes": [{}], "buffers": [{"byteLength": 1, "uri": "a"})";
  for (int i = 0; i < 5000; ++i) text += R"(,{"byteLength": 1, "uri": "a"})";
  expect_quick("b.gltf", text + "]}", 0, "has 5001 buffers; at most 4096");
}

// Nodes of a 3DS file place a mesh by its name, again and again.
std::string instanced_3ds(std::uint32_t faces, int nodes) {
  std::string vertices;
  put(vertices, 3, 2);
  for (const float value : {0.F, 0.F, 0.F, 1.F, 0.F, 0.F, 0.F, 1.F, 0.F}) put(vertices, value);
  std::string rows;
  put(rows, faces, 2);
  for (std::uint32_t i = 0; i < faces; ++i) {
    for (const std::uint32_t value : {0U, 1U, 2U, 0U}) put(rows, value, 2);
  }
  const std::string mesh = chunk_3ds(0x4100, chunk_3ds(0x4110, vertices) + chunk_3ds(0x4120, rows));
  std::string tracks;
  for (int i = 0; i < nodes; ++i) {
    std::string name = std::string("a") + '\0';
    put(name, 0, 4);
    put(name, 0xFFFF, 2);
    tracks += chunk_3ds(0xB002, chunk_3ds(0xB010, name));
  }
  return chunk_3ds(0x4D4D,
                   chunk_3ds(0x3D3D, chunk_3ds(0x4000, std::string("a") + '\0' + mesh)) + chunk_3ds(0xB000, tracks));
}

TEST_F(Amounts, ThreeDsNodesThatRepeatAMesh) {
  expect_quick("few.3ds", instanced_3ds(10, 20), 200);
  expect_quick("nodes.3ds", instanced_3ds(1, 16000), 0, "more than 4096 nodes");
  expect_quick("placed.3ds", instanced_3ds(20000, 1000), 0, "its nodes place more than");
}

}  // namespace
}  // namespace ninebit::scene_tests

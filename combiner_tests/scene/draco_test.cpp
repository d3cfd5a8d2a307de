// Compressed meshes of glTF files: right ones, damaged streams, and what a file says of them wrongly.
#include "combiner_tests/scene/draco_text.h"
#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

constexpr const char* kEngine = "/usr/share/assimp/models/glTF2/draco/2CylinderEngine.gltf";

void expect_same(const Scene& one, const Scene& other) {
  EXPECT_EQ(one.positions, other.positions);
  EXPECT_EQ(one.normals, other.normals);
  EXPECT_EQ(one.triangles, other.triangles);
  EXPECT_EQ(one.triangle_object, other.triangle_object);
  EXPECT_EQ(one.triangle_material, other.triangle_material);
}

class DracoFiles : public SceneFiles {
 protected:
  // Reads a file in this process and in a child, and expects the same of both.
  [[nodiscard]] Result<Scene> read_both(const std::string& content) const {
    const std::filesystem::path file = write("a.gltf", content);
    Result<Scene> here = read_scene(file);
    const Result<Scene> there = read_scene(file, {.isolated = true});
    EXPECT_EQ(here.ok(), there.ok());
    if (here && there) expect_same(*here, *there);
    if (!here && !there) {
      EXPECT_EQ(here.error().message, there.error().message);
    }
    return here;
  }

  [[nodiscard]] std::string complaint(const DracoFile& file) const {
    const Result<Scene> scene = read_both(draco_gltf(file));
    return scene ? "" : scene.error().message;
  }

  // In a child process alone, where a decoder may crash.
  [[nodiscard]] Result<Scene> read_isolated(const DracoFile& file) const {
    return read_scene(write("a.gltf", draco_gltf(file)), {.isolated = true});
  }
};

TEST(DracoModel, HasAllTriangles) {
  if (!std::filesystem::exists(kEngine)) GTEST_SKIP() << "install assimp-testmodels";
  const Result<Scene> here = read_scene(kEngine);
  const Result<Scene> there = read_scene(kEngine, {.isolated = true});
  ASSERT_TRUE(here) << here.error().text();
  ASSERT_TRUE(there) << there.error().text();
  EXPECT_EQ(here->triangles.size(), 110336U);
  EXPECT_EQ(here->objects.size(), 67U);
  expect_contract(*here);
  expect_same(*here, *there);
}

TEST_F(DracoFiles, BothMethodsGiveTheMesh) {
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    for (const std::uint32_t side : {1U, 2U, 40U}) {
      for (const bool metadata : {false, true}) {
        for (const int bits : {0, 12}) {
          const DracoGrid grid{.side = side, .method = method, .metadata = metadata, .position_bits = bits};
          const Result<Scene> scene = read_both(draco_gltf(draco_file(grid)));
          ASSERT_TRUE(scene) << scene.error().text() << " method " << method << " side " << side;
          expect_contract(*scene);
          EXPECT_EQ(scene->triangles.size(), grid.triangles());
          EXPECT_EQ(scene->positions.size(), grid.vertices());
          const auto far_corner = static_cast<float>(side);
          expect_near(bounds_of(*scene).low, {0, 0, 0}, 0.02F);
          expect_near(bounds_of(*scene).high, {far_corner, far_corner, 0}, 0.02F);
          for (std::size_t i = 0; i < scene->triangles.size(); ++i) expect_near(front_of(*scene, i), {0, 0, 1});
          for (const glm::vec3& normal : scene->normals) expect_near(normal, {0, 0, 1});
        }
      }
    }
  }
}

TEST_F(DracoFiles, NormalsOfBytesAreNormalized) {
  const DracoGrid grid{.method = draco::MESH_SEQUENTIAL_ENCODING, .normals = draco::DT_INT8};
  const Result<Scene> scene = read_both(draco_gltf(draco_file(grid)));
  ASSERT_TRUE(scene) << scene.error().text();
  for (const glm::vec3& normal : scene->normals) expect_near(normal, {0, 0, 1});
}

TEST_F(DracoFiles, AStripsTrianglesComeOneByOne) {
  DracoFile file = draco_file({});
  file.mode = "5";
  file.indices = 12;  // a strip of 10 triangles, of which some may be degenerate
  const Result<Scene> scene = read_both(draco_gltf(file));
  ASSERT_TRUE(scene) << scene.error().text();
  const Result<Scene> one_by_one = read_both(draco_gltf(draco_file({})));
  ASSERT_TRUE(one_by_one) << one_by_one.error().text();
  EXPECT_EQ(scene->triangles.size(), 8U);
  expect_same(*scene, *one_by_one);
}

TEST_F(DracoFiles, AttributesThatAreNotNamedAreLeftOut) {
  DracoFile file = draco_file({});
  file.attributes = R"({"POSITION": 0, "TEXCOORD_0": 9})";
  EXPECT_EQ(complaint(file), "primitive 0 of mesh 0 uses an accessor that has no data");
  std::string text = draco_gltf(file);
  text.replace(text.find(R"(, "NORMAL": 1)"), 13, "");
  const Result<Scene> scene = read_both(text);
  ASSERT_TRUE(scene) << scene.error().text();
  for (const glm::vec3& normal : scene->normals) expect_near(normal, {0, 0, 1});  // those of the triangles
}

TEST_F(DracoFiles, UncompressedDataIsUsedWhereItIsThere) {
  std::string text = triangle_gltf(R"({"mesh": 0})", "0");
  const std::string material = R"("material": 0)";
  text.replace(text.find(material), material.size(),
               material + R"(, "extensions": {"KHR_draco_mesh_compression": {"bufferView": 99}})");
  const Result<Scene> scene = read_both(text);
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->triangles.size(), 1U);
}

TEST_F(DracoFiles, FaultsOfTheExtension) {
  const std::string where = "primitive 0 of mesh 0 has no valid extensions.KHR_draco_mesh_compression";
  const DracoFile right = draco_file({});
  DracoFile file = right;
  for (const char* extension : {"7", "[]", "true", "\"a\""}) {
    file.extension = extension;
    EXPECT_EQ(complaint(file), where + "; expected an object");
  }
  file.extension = R"({"bufferView": 0})";
  EXPECT_EQ(complaint(file), where + ".attributes; expected an object");
  file = right;
  for (const char* view : {"1", "-1", "0.5", "null", "\"0\"", "1e300"}) {
    file.view = view;
    EXPECT_EQ(complaint(file), where + ".bufferView; expected the index of a buffer view");
  }
  file = right;
  for (const char* id : {"-1", "4294967296", "0.5", "{}"}) {
    file.attributes = R"({"POSITION": )" + std::string(id) + R"(, "NORMAL": 1})";
    EXPECT_EQ(complaint(file), where + ".attributes.POSITION; expected the id of an attribute of the compressed data");
  }
  file.attributes = R"({"POSITION": 0, "NORMAL": 4294967295})";
  EXPECT_EQ(complaint(file),
            "primitive 0 of mesh 0 has no compressed attribute with the id 4294967295, which NORMAL names");
}

TEST_F(DracoFiles, FaultsOfThePrimitive) {
  const DracoFile right = draco_file({});
  DracoFile file = right;
  file.mode = "6";
  EXPECT_EQ(complaint(file), "primitive 0 of mesh 0 is compressed and of mode 6; expected mode 4 or 5");
  file = right;
  file.normal_component = "5122";
  EXPECT_EQ(complaint(file),
            "primitive 0 of mesh 0 has compressed data whose type differs from the accessor of its NORMAL");
  file.normal_component = "5125";
  EXPECT_EQ(complaint(file), "primitive 0 of mesh 0 uses an accessor of the wrong type");
  file = right;
  file.indices = 21;
  EXPECT_EQ(complaint(file),
            "primitive 0 of mesh 0 has compressed data of 8 triangles; expected at most the 7 that its accessors "
            "declare");
  file.indices = 1;
  EXPECT_EQ(complaint(file), "has no triangles");
  file.indices = std::uint64_t{1} << 50U;
  EXPECT_EQ(complaint(file), "primitive 0 of mesh 0 declares 375299968947541 triangles; at most 134217728 are read");
  file.indices = 3 * (std::uint64_t{1} << 26U);
  EXPECT_NE(complaint(file).find("its nodes place more than "), std::string::npos) << complaint(file);
  std::string text = draco_gltf(right);
  text.replace(text.find(R"("indices": 2, )"), 14, "");
  const Result<Scene> scene = read_both(text);
  ASSERT_FALSE(scene);
  EXPECT_EQ(scene.error().message, "primitive 0 of mesh 0 names an accessor that does not exist");
}

TEST_F(DracoFiles, HeadersAreCheckedBeforeDracoIsCalled) {
  const std::string name = "primitive 0 of mesh 0 ";
  const DracoFile right = draco_file({});
  DracoFile file = right;
  const auto with = [&](std::size_t at, const std::string& bytes) {
    file.stream = right.stream;
    file.stream.replace(at, bytes.size(), bytes);
    return complaint(file);
  };
  EXPECT_EQ(with(0, "draco"), name + "is malformed: its compressed data does not start with 'DRACO'");
  EXPECT_EQ(with(5, "\1\3"), name + "has compressed data of Draco version 1.3; version 2.2 is read");
  EXPECT_EQ(with(7, std::string(1, '\0')), name + "is malformed: its compressed data is not a triangle mesh");
  EXPECT_EQ(with(8, "\7"), name + "has compressed data of the unknown method 7");
  EXPECT_EQ(with(13, "\x7F"),
            name + "has compressed data of 127 triangles; expected at most the 8 that its accessors declare");
  EXPECT_EQ(with(12, "\xFF\xFF\xFF\xFF\x0F\x08"),
            name + "has compressed data of 4294967295 vertices for 8 triangles; expected at most three for each");
  EXPECT_EQ(with(12, "\x08\xFF\xFF\xFF\xFF\x0F"),
            name + "has compressed data of 4294967295 triangles; expected at most the 8 that its accessors declare");
  EXPECT_EQ(with(12, "\xFF\xFF\xFF\xFF\xFF"), name + "is malformed: its compressed data ends early");
  for (const std::size_t size : {std::size_t{0}, std::size_t{4}}) {
    file.stream = right.stream.substr(0, size);
    EXPECT_EQ(complaint(file), name + "is malformed: its compressed data does not start with 'DRACO'") << size;
  }
  for (const std::size_t size : {std::size_t{5}, std::size_t{10}, std::size_t{11}, std::size_t{12}, std::size_t{13}}) {
    file.stream = right.stream.substr(0, size);
    EXPECT_EQ(complaint(file), name + "is malformed: its compressed data ends early") << size;
  }
}

// Metadata nests as deep as a stream says, and lies before the counts.
TEST_F(DracoFiles, MetadataIsCheckedToo) {
  ASSERT_NE(draco_stream({.metadata = true})[10] & 0x80, 0) << "Draco's encoder wrote no metadata";
  DracoFile file = draco_file({});
  const std::string right = file.stream;
  const auto with = [&](const std::string& metadata) {
    file.stream = right.substr(0, 10) + "\x80" + metadata + right.substr(11);
    return complaint(file);
  };
  const auto nested = [](int depth) {
    std::string text(1, '\0');  // no attribute has any
    for (int i = 0; i < depth; ++i) text += std::string("\0\1\1a", 4);
    return text + std::string(2, '\0');
  };
  EXPECT_EQ(with(nested(0)), "");
  EXPECT_EQ(with(nested(32)), "");
  for (const int depth : {33, 100000})
    EXPECT_EQ(with(nested(depth)),
              "primitive 0 of mesh 0 is malformed: the metadata of its compressed data nests too deep");
  EXPECT_EQ(with("\xFF\xFF\xFF\xFF\x0F"), "primitive 0 of mesh 0 is malformed: its compressed data ends early");
}

// Whatever a stream holds, a scene keeps its promises or the file gets one line. In a child, as Draco may crash.
TEST_F(DracoFiles, DamagedStreamsGiveASceneOrOneLine) {
  std::size_t refused = 0, read = 0;
  const auto look = [&](const DracoFile& file) {
    const Result<Scene> scene = read_isolated(file);
    scene ? ++read : ++refused;
    if (scene) expect_contract(*scene);
    if (!scene) {
      EXPECT_FALSE(scene.error().message.empty());
      EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
    }
  };
  for (const int method : {draco::MESH_SEQUENTIAL_ENCODING, draco::MESH_EDGEBREAKER_ENCODING}) {
    const DracoFile right = draco_file({.method = method, .position_bits = 12});
    DracoFile file = right;
    for (std::size_t size = 0; size < right.stream.size(); size += 3) {
      file.stream = right.stream.substr(0, size);
      if (size > 0) look(file);
    }
    EXPECT_EQ(read, 0U) << "a stream that is cut short was read";
    file = right;
    for (std::size_t at = 11; at < right.stream.size(); ++at) {
      file.stream = right.stream;
      file.stream[at] = static_cast<char>(file.stream[at] ^ (1 << (at % 8)));
      look(file);
    }
    EXPECT_GT(refused, 0U);
    read = 0;
  }
}

}  // namespace
}  // namespace ninebit::scene_tests

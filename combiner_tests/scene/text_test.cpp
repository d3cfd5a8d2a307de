// Words, numbers and encodings of scene files, and what a file seems to be.
#include <bit>
#include <cmath>

#include "combiner_tests/scene/gltf_text.h"
#include "combiner_tests/scene/scene_test_support.h"
#include "src/scene/files/file_kind.h"
#include "src/scene/files/gltf_storage.h"
#include "src/scene/files/json_value.h"
#include "src/scene/files/text_scan.h"

namespace ninebit::scene_tests {
namespace {

TEST(Numbers, Words) {
  const std::vector<std::pair<const char*, float>> good{{"0", 0.0F},
                                                        {"-0", -0.0F},
                                                        {"+2.5", 2.5F},
                                                        {".5", 0.5F},
                                                        {"-.5", -0.5F},
                                                        {"5.", 5.0F},
                                                        {"1e3", 1e3F},
                                                        {"1E-2", 1e-2F},
                                                        {"12.25e+1", 122.5F},
                                                        {"1e-400", 0.0F},
                                                        {"100000000000000000000000", 1e23F},
                                                        {"0.00001e40", 1e35F},
                                                        {"-1e-50", -0.0F}};
  for (const auto& [word, value] : good) {
    const std::optional<float> read = real_of<float>(word);
    ASSERT_TRUE(read) << word;
    EXPECT_FLOAT_EQ(*read, value) << word;
    EXPECT_EQ(std::signbit(*read), std::signbit(value)) << word;
  }
  for (const char* word : {"1e39", "inf", "-Infinity", "1e999999999999999999999", "-1e400"})
    EXPECT_TRUE(std::isinf(real_of<float>(word).value_or(0.0F))) << word;
  EXPECT_TRUE(std::isnan(real_of<float>("nan").value_or(0.0F)));
  for (const char* word :
       {"", "+", "-", ".", "e5", "1e", "1e+", "1x", "--1", "+-1", "++1", "1.2.3", "0x10", "1,5", "1 "})
    EXPECT_FALSE(real_of<float>(word)) << word;
}

// The digits before and behind the point are rounded each on their own; pictures have depended on that.
TEST(Numbers, SumOfTwoRoundedParts) {
  EXPECT_EQ(*real_of<float>("16777217"), 16777216.0F);
  EXPECT_EQ(*real_of<float>("8388608.75"), 8388608.0F + 0.75F);
  EXPECT_EQ(*real_of<float>("3.14159"), 3.0F + static_cast<float>(14159 * 0.00001));
  EXPECT_EQ(*real_of<double>("3.14159"), 3.0 + 14159 * 0.00001);
  // Only 15 digits behind the point count.
  EXPECT_EQ(*real_of<double>("0.1234567890123456789"), 123456789012345.0 * 1e-15);
}

TEST(Base64, PaddingAndLetters) {
  EXPECT_EQ(decode_base64(""), "");
  EXPECT_EQ(decode_base64("QQ=="), "A");
  EXPECT_EQ(decode_base64("QUI="), "AB");
  EXPECT_EQ(decode_base64("QUJD"), "ABC");
  EXPECT_EQ(decode_base64("+/+/AA=="), std::string("\xFB\xFF\xBF\0", 4));
  for (const char* bad : {"QQ", "QQ=", "Q===", "====", "QUI=QUI=", "QU=I", "QU I", "QUJD=", "QUJ\n", "QUJ-"})
    EXPECT_FALSE(decode_base64(bad)) << bad;
  for (std::size_t size = 0; size < 9; ++size) {
    const std::string data = std::string("\0\xFF\x80 abcde", 9).substr(0, size);
    EXPECT_EQ(decode_base64(base64(data)), data);
  }
}

TEST(Percent, Decoding) {
  EXPECT_EQ(decode_percent("my%20mesh%2Ebin"), "my mesh.bin");
  EXPECT_EQ(decode_percent("%C3%a9"), "\xC3\xA9");
  for (const char* odd : {"%", "a%2", "%zz", "100%"}) EXPECT_EQ(decode_percent(odd), odd);
}

TEST(JsonValue, NestsSixtyFourDeep) {
  const auto nested = [](std::size_t depth) { return std::string(depth, '[') + std::string(depth, ']'); };
  EXPECT_TRUE(parse_json(nested(64)));
  const auto deep = parse_json(nested(65));
  ASSERT_FALSE(deep);
  EXPECT_NE(deep.error().message.find("nests too deep"), std::string::npos);
  // Depth counts what is open, not what was.
  EXPECT_TRUE(parse_json("[" + nested(63) + "," + nested(63) + "]"));
}

TEST_F(SceneFiles, GltfSpotOfExactlyHalfACircle) {
  const auto spot = [&](const std::string& angle) {
    return read("s.gltf", triangle_gltf(R"({"mesh": 0}, {"extensions": {"KHR_lights_punctual": {"light": 0}}})", "0, 1",
                                        R"(, "extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "spot":
                              {"outerConeAngle": )" +
                                            angle + "}}]}}"));
  };
  const Result<Scene> half = spot("1.5707963267948966");
  ASSERT_TRUE(half) << half.error().text();
  EXPECT_EQ(half->lights[0].spot_degrees, 179.0F);
  EXPECT_FALSE(spot("1.5707963267948968"));
}

TEST_F(SceneFiles, GltfNormalsOfBytes) {
  // Three positions, then three normals of one byte each and one of padding: (0, 0, -1).
  std::string data = triangle_bytes().substr(0, 36);
  for (int i = 0; i < 3; ++i) data += std::string("\0\0\x81\0", 4);
  const std::string text = R"({"asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}}]}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3},
      {"bufferView": 1, "componentType": 5120, "type": "VEC3", "count": 3, "normalized": true}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 12, "byteStride": 4}],
    "buffers": [{"byteLength": 48, "uri": "data:application/octet-stream;base64,)" +
                           base64(data) + "\"}]}";
  const Result<Scene> scene = read("b.gltf", text);
  ASSERT_TRUE(scene) << scene.error().text();
  for (glm::length_t k = 0; k < 3; ++k) expect_near(scene->normals[scene->triangles[0][k]], {0, 0, -1});
  EXPECT_EQ(scene->objects[0].name, "nodes[0]");
  EXPECT_EQ(scene->materials[scene->triangle_material[0]].base_color, glm::vec3(1.0F));
}

TEST_F(SceneFiles, OffWithNormalsAndColours) {
  const Result<Scene> scene =
      read("n.off", "CNOFF\n3 1 0\n0 0 0 1 0 0 255 0 0\n1 0 0 1 0 0 255 0\n0 1 0 0 0 0 9\n3 0 1 2\n");
  ASSERT_TRUE(scene) << scene.error().text();
  const glm::uvec3 t = scene->triangles[0];
  expect_near(scene->normals[t.x], {1, 0, 0});
  expect_near(scene->normals[t.z], {0, 0, 1});  // none in the file
  EXPECT_FALSE(read("m.off", "NOFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"));
}

TEST_F(SceneFiles, PlyStripsMaterialsAndPackedNormals) {
  const std::string head = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n";
  const Result<Scene> strip =
      read("s.ply", "ply\nformat ascii 1.0\n" + head +
                        "element material 1\nproperty uchar diffuse_red\nproperty float diffuse_green\n"
                        "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
                        "0 0 0\n1 0 0\n0 1 0\n1 1 0\n51 0.5\n8 0 1 2 3 -1 3 2 1\n");
  ASSERT_TRUE(strip) << strip.error().text();
  ASSERT_EQ(strip->triangles.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) expect_near(front_of(*strip, i), {0, 0, 1});
  expect_near(strip->materials[0].base_color, {0.2F, 0.5F, 0});
  for (const char* bad : {"4 0 1 2 -2\n", "4 0 1 2 4\n", "4 0 1 2\n"}) {
    const Result<Scene> scene = read("b.ply", "ply\nformat ascii 1.0\n" + head +
                                                  "element tristrips 1\nproperty list int int vertex_indices\n"
                                                  "end_header\n0 0 0\n1 0 0\n0 1 0\n1 1 0\n" +
                                                  bad);
    ASSERT_FALSE(scene) << bad;
    EXPECT_EQ(scene.error().line, 14) << bad;
  }
}

// A byte of binary data may look like the end of a line.
TEST_F(SceneFiles, PlyDataThatBeginsWithALineEnd) {
  std::string file =
      "ply\nformat binary_little_endian 1.0\nelement vertex 3\nproperty uchar x\nproperty uchar y\nproperty uchar z\n"
      "element face 1\nproperty list uchar uchar vertex_indices\nend_header\n";
  file += std::string("\n\0\0\1\0\0\0\1\0\3\0\1\2", 13);
  const Result<Scene> scene = read("e.ply", file);
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(bounds_of(*scene).high, glm::vec3(10, 1, 0));
}

TEST(FileKind, ByItsFirstBytes) {
  EXPECT_EQ(other_kind("\x89PNG\r\n", ".obj"), "a PNG picture");
  EXPECT_EQ(other_kind("ply\nformat ascii 1.0\n", ".obj"), "a PLY file");
  EXPECT_EQ(other_kind("ply\nformat ascii 1.0\n", ".ply"), std::nullopt);
  EXPECT_EQ(other_kind("\n {\"asset\": {}}", ".obj"), "a glTF file (.gltf)");
  EXPECT_EQ(other_kind("{}", ".off"), "a JSON file");
  EXPECT_EQ(other_kind("{}", ".gltf"), std::nullopt);
  EXPECT_EQ(other_kind("v 0 0 0\n", ".obj"), std::nullopt);
  EXPECT_EQ(other_kind("", ".obj"), std::nullopt);
}

TEST_F(SceneFiles, AFileOfAnotherKindIsNamed) {
  const std::string gltf = triangle_gltf(R"({"mesh": 0})", "0");
  const std::vector<std::array<std::string, 3>> all{
      {"a.obj", "\x89PNG\r\n\x1A\n", "seems to be a PNG picture; expected what its extension .obj says"},
      {"b.obj", gltf, "seems to be a glTF file"},
      {"c.gltf", "glTF\2", "seems to be a binary glTF file"},
      {"d.ply", "OFF\n1 1 1\n", "seems to be an OFF file"},
      {"e.3ds", "!!RC1.0\n", "seems to be a combiner program"},
      {"f.glb", gltf, "seems to be a glTF file"}};
  for (const auto& [name, content, says] : all) {
    const Result<Scene> scene = read(name, content);
    ASSERT_FALSE(scene) << name;
    EXPECT_NE(scene.error().message.find(says), std::string::npos) << scene.error().message;
  }
}

}  // namespace
}  // namespace ninebit::scene_tests

// STL, COLLADA, FBX and glTF 1.0, which Assimp reads; vertex data of PLY and glTF files; the axis that points up.
#include <algorithm>

#include "combiner_tests/scene/gltf_text.h"
#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

const std::string kModels = "/usr/share/assimp/models/";

bool has_note(const Scene& scene, const std::string& text) {
  return std::any_of(scene.notes.begin(), scene.notes.end(),
                     [&](const std::string& note) { return note.find(text) != std::string::npos; });
}

constexpr std::string_view kStl =
    "solid one\nfacet normal 0 0 1\nouter loop\nvertex 0 0 5\nvertex 2 0 5\nvertex 0 3 5\nendloop\nendfacet\nendsolid "
    "one\n";

// z of the file points up: (x, y, z) becomes (x, z, -y).
TEST_F(SceneFiles, StlHasZUp) {
  const Result<Scene> scene = read("a.stl", kStl);
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  ASSERT_EQ(scene->positions.size(), 3U);
  EXPECT_EQ(scene->positions[0], glm::vec3(0, 5, 0));
  EXPECT_EQ(scene->positions[1], glm::vec3(2, 5, 0));
  EXPECT_EQ(scene->positions[2], glm::vec3(0, 5, -3));
  EXPECT_EQ(scene->normals[0], glm::vec3(0, 1, 0));
  EXPECT_EQ(scene->up, UpAxis::z);
  const Result<Scene> as_it_is = read_scene(write("b.stl", kStl), {.up = UpAxis::y});
  ASSERT_TRUE(as_it_is) << as_it_is.error().text();
  EXPECT_EQ(as_it_is->positions[2], glm::vec3(0, 3, 5));
  EXPECT_EQ(as_it_is->normals[0], glm::vec3(0, 0, 1));
}

TEST_F(SceneFiles, UpTurnsAnyFormat) {
  const std::string_view text = "v 0 0 1\nv 1 0 1\nv 0 1 1\nf 1 2 3\n";
  const Result<Scene> turned = read_scene(write("a.obj", text), {.up = UpAxis::z});
  ASSERT_TRUE(turned) << turned.error().text();
  EXPECT_EQ(turned->positions[2], glm::vec3(0, 1, -1));
  EXPECT_EQ(turned->normals[2], glm::vec3(0, 1, 0));
  const Result<Scene> same = read_scene(write("b.obj", text), {.up = UpAxis::y});
  ASSERT_TRUE(same);
  EXPECT_EQ(same->positions[2], glm::vec3(0, 1, 1));
  // The 3DS reader has turned its file already.
  const std::string cube = "/usr/share/glmark2/models/horse.3ds";
  const Result<Scene> by_format = read_scene(cube), z = read_scene(cube, {.up = UpAxis::z}),
                      y = read_scene(cube, {.up = UpAxis::y});
  ASSERT_TRUE(by_format && z && y);
  EXPECT_EQ(by_format->positions, z->positions);
  for (std::size_t i = 0; i < y->positions.size(); ++i) {
    const glm::vec3& p = z->positions[i];
    ASSERT_EQ(y->positions[i], glm::vec3(p.x, -p.z, p.y) + 0.0F);
  }
}

// The file says which axis points up; Assimp turns COLLADA and not FBX.
TEST_F(SceneFiles, FbxAndColladaSayWhatPointsUp) {
  const auto with = [&](const std::string& name, const std::string& from, const std::string& to) {
    const std::string file = file_content(kModels + name);
    return read("a" + std::filesystem::path(name).extension().string(), replaced(file, from, to));
  };
  const auto expect_turned = [](const Scene& y, const Scene& z) {
    ASSERT_EQ(y.positions.size(), z.positions.size());
    EXPECT_EQ(y.up, UpAxis::y);
    EXPECT_EQ(z.up, UpAxis::z);
    for (std::size_t i = 0; i < y.positions.size(); ++i) {
      const glm::vec3& p = y.positions[i];
      expect_near(z.positions[i], glm::vec3(p.x, p.z, -p.y), 1e-3F);
    }
  };
  const std::string axis = "P: \"UpAxis\", \"int\", \"Integer\", \"\",";
  const Result<Scene> fbx_y = with("FBX/embedded_ascii/box.FBX", axis + "2", axis + "1"),
                      fbx_z = with("FBX/embedded_ascii/box.FBX", axis + "2", axis + "2");
  ASSERT_TRUE(fbx_y && fbx_z);
  expect_turned(*fbx_y, *fbx_z);
  const Result<Scene> dae_y = with("Collada/duck.dae", "Y_UP", "Y_UP"),
                      dae_z = with("Collada/duck.dae", "Y_UP", "Z_UP");
  ASSERT_TRUE(dae_y && dae_z);
  expect_turned(*dae_y, *dae_z);
}

TEST_F(SceneFiles, PlyColorsAndCoordinates) {
  const Result<Scene> scene =
      read("a.ply",
           "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty "
           "float s\n"
           "property float t\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
           "property list uchar int vertex_indices\nend_header\n"
           "0 0 0 0.25 0.75 255 0 51\n1 0 0 1 0 0 255 0\n0 1 0 0 1 0 0 0\n3 0 1 2\n");
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  ASSERT_EQ(scene->texture_coordinates.size(), 3U);
  EXPECT_EQ(scene->texture_coordinates[0], glm::vec2(0.25F, 0.25F)) << "t from the picture's top";
  ASSERT_EQ(scene->colors.size(), 3U);
  EXPECT_EQ(scene->colors[0], glm::vec4(1.0F, 0.0F, 0.2F, 1.0F));
  EXPECT_EQ(scene->colors[1], glm::vec4(0.0F, 1.0F, 0.0F, 1.0F));
}

TEST_F(SceneFiles, PlyAlphaAndRealColors) {
  const Result<Scene> scene = read(
      "a.ply",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float red\nproperty float green\nproperty float blue\nproperty float alpha\nproperty float texture_u\n"
      "property float texture_v\nelement face 1\nproperty list uchar int vertex_index\nend_header\n"
      "0 0 0 0.5 2 -1 0.25 0 0\n1 0 0 0 0 0 1 0 0\n0 1 0 0 0 0 1 0 0\n3 0 1 2\n");
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(scene->colors.at(0), glm::vec4(0.5F, 1.0F, 0.0F, 0.25F)) << "clamped";
  EXPECT_EQ(scene->texture_coordinates.at(0), glm::vec2(0.0F, 1.0F));
}

TEST(ImportedFormats, TexturesAndNotes) {
  const Result<Scene> duck = read_scene(kModels + "Collada/duck.dae");
  ASSERT_TRUE(duck) << duck.error().text();
  EXPECT_EQ(duck->texture_coordinates.size(), duck->positions.size());
  ASSERT_EQ(duck->textures.size(), 1U);
  EXPECT_TRUE(std::filesystem::exists(duck->textures[0].file)) << duck->textures[0].file;
  EXPECT_TRUE(has_note(*duck, "cameras and lights"));
  const Bounds bounds = bounds_of(*duck);
  EXPECT_GT(bounds.high.y - bounds.low.y, 0.5F * (bounds.high.x - bounds.low.x)) << "it stands";

  const Result<Scene> spider = read_scene(kModels + "FBX/spider.fbx");
  ASSERT_TRUE(spider) << spider.error().text();
  EXPECT_TRUE(has_note(*spider, "which was not found"));
  for (const Material& material : spider->materials) EXPECT_FALSE(material.base_texture);

  const Result<Scene> skinned = read_scene(kModels + "FBX/huesitos.fbx");
  ASSERT_TRUE(skinned) << skinned.error().text();
  EXPECT_TRUE(has_note(*skinned, "skins"));
  EXPECT_TRUE(has_note(*skinned, "animations"));

  const Result<Scene> embedded = read_scene(kModels + "FBX/embedded_ascii/box_embedded_texture_fragmented.fbx");
  ASSERT_TRUE(embedded) << embedded.error().text();
  ASSERT_FALSE(embedded->textures.empty());
  EXPECT_FALSE(embedded->textures[0].bytes.empty());

  const Result<Scene> truck = read_scene(kModels + "glTF/CesiumMilkTruck/CesiumMilkTruck.gltf");
  ASSERT_TRUE(truck) << truck.error().text();
  ASSERT_FALSE(truck->textures.empty());
  EXPECT_TRUE(std::filesystem::exists(truck->textures[0].file));
}

// One triangle; its positions are the 36 bytes of the body.
constexpr std::string_view kGltf1 = R"({"asset": {"version": "1.0"}, "scene": "s", "scenes": {"s": {"nodes": ["n"]}},
"nodes": {"n": {"meshes": ["m"], "translation": [10, 0, 0]}},
"meshes": {"m": {"primitives": [{"attributes": {"POSITION": "a"}, "mode": 4}]}},
"accessors": {"a": {"bufferView": "v", "byteOffset": 0, "componentType": 5126, "count": 3, "type": "VEC3"}},
"bufferViews": {"v": {"buffer": "BUFFER", "byteOffset": 0, "byteLength": 36, "target": 34962}},
"buffers": {"BUFFER": {"byteLength": 36, "type": "arraybuffer", "uri": "body.bin"}}})";

// The positions alone.
std::string positions_of_triangle() {
  return triangle_bytes().substr(0, 36);
}

// The triangle with the tangent +x and w 1 at each corner; `node`: members of its node.
std::string tangent_gltf(const std::string& node) {
  std::string data = triangle_bytes({});
  for (int i = 0; i < 3; ++i) {
    for (const float value : {1.F, 0.F, 0.F, 1.F}) put(data, value);
  }
  return R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0, )" + node +
         R"(}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1, "TANGENT": 2}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
{"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC3"},
{"bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC4"}],
"bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 36},
{"buffer": 0, "byteOffset": 72, "byteLength": 48}],
"buffers": [{"byteLength": 120, "uri": "data:application/octet-stream;base64,)" +
         base64(data) + R"("}]})";
}

TEST_F(SceneFiles, Gltf1WithAFileAndInOne) {
  write("body.bin", positions_of_triangle());
  const Result<Scene> two = read("a.gltf", kGltf1);
  ASSERT_TRUE(two) << two.error().text();
  ASSERT_EQ(two->triangles.size(), 1U);
  EXPECT_EQ(two->positions[1], glm::vec3(11, 0, 0));

  std::string json(kGltf1);
  for (std::size_t at = 0; (at = json.find("BUFFER")) != std::string::npos;) json.replace(at, 6, "binary_glTF");
  json.replace(json.find("body.bin"), 8, "data:,");
  json.resize((json.size() + 3) / 4 * 4, ' ');
  const std::string body = positions_of_triangle() + std::string(4, '\0');
  const auto size = static_cast<std::uint32_t>(json.size());
  std::string glb = "glTF";
  for (const std::uint32_t number : {1U, 20 + size + 40, size, 0U}) put(glb, number, 4);
  glb += json + body;
  const Result<Scene> one = read("b.glb", glb);
  ASSERT_TRUE(one) << one.error().text();
  EXPECT_EQ(one->positions, two->positions);
  const Result<Scene> cut = read("c.glb", glb.substr(0, glb.size() - 1));
  ASSERT_FALSE(cut);
  EXPECT_NE(cut.error().message.find("ends early"), std::string::npos) << cut.error().message;
  const Result<Scene> outside = read("d.gltf", std::string(kGltf1).replace(kGltf1.find("body.bin"), 8, "../x.bin"));
  ASSERT_FALSE(outside);
  EXPECT_NE(outside.error().message.find("--allow-outside"), std::string::npos) << outside.error().message;
}

// A damaged file gives a fault or a valid scene; the child process takes whatever the importer does.
TEST_F(SceneFiles, ImportedFilesThatAreCut) {
  for (const char* name : {"STL/Spider_binary.stl", "STL/Spider_ascii.stl", "Collada/cameras.dae", "FBX/box.fbx",
                           "glTF/BoxTextured-glTF-Embedded/BoxTextured.gltf"}) {
    const std::string content = file_content(kModels + name);
    ASSERT_FALSE(content.empty()) << name;
    for (std::size_t part = 0; part < 24; ++part) {
      std::string damaged = content.substr(0, content.size() * part / 24);
      if (part % 2 == 1 && damaged.size() > 100) damaged[damaged.size() / 2] = static_cast<char>(0xFF);
      const Result<Scene> scene = read("cut" + std::filesystem::path(name).extension().string(), damaged);
      if (scene) {
        expect_contract(*scene);
      } else {
        EXPECT_FALSE(scene.error().message.empty());
        EXPECT_EQ(scene.error().fault, Fault::invalid_input);
      }
    }
  }
}

TEST_F(SceneFiles, WhatImportedFilesAreNot) {
  const Result<Scene> words = read("a.fbx", "these are no shapes\n");
  ASSERT_FALSE(words);
  const Result<Scene> picture = read("a.stl", "\x89PNG\r\n\x1a\n and more");
  ASSERT_FALSE(picture);
  EXPECT_NE(picture.error().message.find("a PNG picture"), std::string::npos) << picture.error().message;
}

TEST_F(SceneFiles, GltfTangentsTurnWithTheNode) {
  // A quarter turn about z takes +x to +y; a mirrored node changes the bitangent's side.
  const Result<Scene> turned = read("a.gltf", tangent_gltf(R"("rotation": [0, 0, 0.70710678, 0.70710678])"));
  ASSERT_TRUE(turned) << turned.error().text();
  ASSERT_EQ(turned->tangents.size(), 3U);
  EXPECT_LT(glm::distance(turned->tangents[0], glm::vec4(0, 1, 0, 1)), 1e-6F);
  const Result<Scene> mirrored = read("b.gltf", tangent_gltf(R"("scale": [-1, 1, 1])"));
  ASSERT_TRUE(mirrored) << mirrored.error().text();
  EXPECT_LT(glm::distance(mirrored->tangents[0], glm::vec4(-1, 0, 0, -1)), 1e-6F);
}

}  // namespace
}  // namespace ninebit::scene_tests

// Every kind of broken file gives one Diagnostic that names the file and says what is wrong.
#include "combiner_tests/scene/gltf_text.h"
#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

struct BadFile {
  std::string name;
  std::string content;
  std::string says;  // within the message
  int line = 0;
};

const std::string kObj = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
const std::string kPly =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::vector<BadFile> bad_texts() {
  return {
      {"empty.obj", "", "empty"},
      {"words.obj", "these are no shapes\n", "no triangles"},
      {"vertices.obj", kObj, "no triangles"},
      {"range.obj", kObj + "f 1 2 3\nf 1 2 99\n", "index 99 is out of range", 5},
      {"zero.obj", kObj + "f 0 1 2\n", "index 0 is out of range", 4},
      {"back.obj", kObj + "f -1 -2 -4\n", "index -4 is out of range", 4},
      {"normal.obj", kObj + "vn 0 0 1\nf 1//1 2//1 3//2\n", "normal index 2 is out of range", 5},
      {"texture.obj", kObj + "f 1/1 2/1 3/1\n", "texture coordinate index 1 is out of range", 4},
      {"corner.obj", kObj + "f 1 2 3\nf 1 two 3\n", "not a face corner", 5},
      {"two.obj", kObj + "f 1 2 3\nf 1 2\n", "at least three corners", 5},
      {"cut.obj", kObj + "f 1 2 3\nv 1 2", "three numbers", 5},
      {"nan.obj", "v 0 0 0\nv 1 nan 0\nv 0 1 0\nf 1 2 3\n", "not finite", 2},
      {"inf.obj", "v 0 0 0\nv 1 0 0\nv 0 -inf 0\nf 1 2 3\n", "not finite", 3},
      {"huge.obj", "v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n", "not finite", 2},
      {"control.obj", "v 0 \x1B[31m\x07 0\n", "'?[31m?' is not a number", 1},
      {"letter.obj", "v 0 0 0\nv 1 x 0\nv 0 1 0\nf 1 2 3\n", "not a number", 2},
      {"binary.obj", kObj + std::string("f 1 2 3\n\0\1\2", 11), "binary data"},
      {"wide.obj", "\xFF\xFEv", "UTF-16"},
      {"words.off", "these are no shapes\n", "does not start with 'OFF'", 1},
      {"four.off", "4OFF\n3 1 0\n", "unsupported kind", 1},
      {"counts.off", "OFF\n3 1\n0 0 0\n", "numbers of vertices, faces and edges", 2},
      {"many.off", "OFF\n4000000000 6 0\n0 0 0\n", "declares 4000000000 vertices and has 1"},
      {"more.off", "OFF\n353535235358 6 0\n0 0 0\n", "numbers of vertices, faces and edges", 2},
      {"range.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "index 3 is out of range", 6},
      {"negative.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "index -1 is out of range", 6},
      {"cut.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "declares 2 faces and has 1"},
      {"short.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n9 0 1 2\n", "fewer corners", 6},
      {"nan.off", "OFF\n3 1 0\n0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "not finite", 4},
      {"none.off", "OFF\n3 0 0\n0 0 0\n1 0 0\n0 1 0\n", "no triangles"},
      {"words.ply", "these are no shapes\n", "does not start with 'ply'", 1},
      {"header.ply", "ply\nformat ascii 1.0\nelement vertex 3\n", "ends within its header"},
      {"range.ply", kPly + "0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n", "index 3 is out of range", 13},
      {"negative.ply", kPly + "0 0 0\n1 0 0\n0 1 0\n3 0 1 -1\n", "index -1 is out of range", 13},
      {"row.ply", kPly + "0 0 0\n1 0 0\n0 1 0\n3 0 1\n", "too few values", 13},
      {"cut.ply", kPly + "0 0 0\n1 0 0\n", "declares 3 of element 'vertex' and has 2"},
      {"nan.ply", kPly + "0 0 0\n1 nan 0\n0 1 0\n3 0 1 2\n", "not finite", 11},
      {"letter.ply", kPly + "0 0 0\n1 x 0\n0 1 0\n3 0 1 2\n", "not a number", 11},
      {"type.ply", replaced(kPly, "property float x", "property half x"), "unknown type", 4},
      {"none.ply", replaced(kPly, "face 1", "face 0") + "0 0 0\n1 0 0\n0 1 0\n", "no triangles"},
      {"words.3ds", "these are no shapes\n", "main chunk"},
      {"cut.3ds", triangle_3ds(2).substr(0, 60), "ends early"},
      {"range.3ds", triangle_3ds(3), "index 3 of object 'shape' is out of range"},
      {"nothing.3ds", chunk_3ds(0x4D4D, ""), "no triangles"},
      {"chunk.3ds", chunk_3ds(0x4D4D, replaced(chunk_3ds(0x3D3D, "abc"), std::string("\x09", 1), "\x29")),
       "longer than its parent"},
      {"shape.blend", "solid\n",
       "unknown extension '.blend'; scenes are read from .gltf, .glb, .obj, .ply, .off, .3ds, .stl, .dae and .fbx"},
      {"shape", "v 0 0 0\n", "has no extension"},
  };
}

std::vector<BadFile> bad_gltfs() {
  const std::string good = triangle_gltf(R"({"mesh": 0})", "0");
  std::string nan_bytes = triangle_bytes();
  nan_bytes.replace(12, 4, std::string("\0\0\xC0\x7F", 4));
  std::string deep;
  for (int i = 0; i < 3000; ++i) deep += R"({"children": [)" + std::to_string(i + 1) + "]}, ";
  return {
      {"empty.gltf", "", "empty"},
      {"words.gltf", "these are no shapes\n", "malformed", 1},
      {"cut.gltf", good.substr(0, good.size() / 2), "ends early", 5},
      {"nested.gltf", std::string(100000, '['), "nests too deep", 1},
      {"version.gltf", replaced(good, "\"2.0\"", "\"1.0\""), "version 1.0, but its accessors are not an object"},
      {"unmarked.gltf", R"({"scenes": []})", "has no asset.version"},
      {"range.gltf", triangle_gltf(R"({"mesh": 0})", "0", "", triangle_bytes({0, 1, 2, 0, 1, 3})),
       "index is out of range: the primitive has 3"},
      {"allrange.gltf", triangle_gltf(R"({"mesh": 0})", "0", "", triangle_bytes({7, 8, 9})),
       "node 0, mesh 0: a vertex index"},
      {"nan.gltf", triangle_gltf(R"({"mesh": 0})", "0", "", nan_bytes), "not finite"},
      {"far.gltf", triangle_gltf(R"({"mesh": 0, "scale": [1e39, 1, 1]})", "0"), "not finite"},
      {"product.gltf",
       triangle_gltf(R"({"children": [1], "scale": [1e30, 1, 1]}, {"mesh": 0, "scale": [1e30, 1, 1]})", "0"),
       "not finite"},
      {"loop.gltf", triangle_gltf(R"({"mesh": 0, "children": [1]}, {"children": [0]})", "0"), "reached twice"},
      {"deep.gltf", triangle_gltf(deep + R"({"mesh": 0})", "0"), "nest more than"},
      {"node.gltf", triangle_gltf(R"({"mesh": 0})", "0, 5"), "a node that does not exist"},
      {"mesh.gltf", triangle_gltf(R"({"mesh": 4})", "0"), "a mesh that does not exist"},
      {"none.gltf", triangle_gltf(R"({"name": "alone"})", "0"), "no triangles"},
      {"accessor.gltf", replaced(good, "\"count\": 3", "\"count\": 4"), "past the end of its buffer view"},
      {"view.gltf", replaced(good, "\"byteOffset\": 36", "\"byteOffset\": 99"), "past the end of its buffer"},
      {"buffer.gltf", replaced(good, "base64,AAAA", "base64,"), "buffer 0 ends early"},
      {"sparse.gltf", replaced(good, "\"count\": 3,", "\"count\": 3, \"sparse\": {},"), "is sparse"},
      {"kind.gltf", replaced(good, "\"indices\": 2", "\"indices\": 0"), "an accessor of the wrong type"},
      {"data.gltf", replaced(good, "{\"bufferView\": 2, ", "{"), "has no data"},
      {"letters.gltf", replaced(good, "base64,AAAA", "base64,!!!!"), "not base64"},
      {"beside.gltf", replaced(good, "data:application/octet-stream;base64,", "gone.bin?"), "cannot be opened"},
      {"words.glb", "these are no shapes\n", "does not start with 'glTF'"},
  };
}

class BadFiles : public SceneFiles {
 protected:
  void expect_refused(const BadFile& bad) const {
    const std::filesystem::path file = write(bad.name, bad.content);
    const Result<Scene> scene = read_scene(file);
    ASSERT_FALSE(scene) << bad.name << " was read";
    EXPECT_NE(scene.error().message.find(bad.says), std::string::npos) << bad.name << ": " << scene.error().message;
    EXPECT_EQ(scene.error().file, file.string());
    EXPECT_EQ(scene.error().line, bad.line) << bad.name;
    EXPECT_EQ(scene.error().fault, Fault::invalid_input);
    EXPECT_EQ(scene.error().message.find('\n'), std::string::npos);
  }
};

TEST_F(BadFiles, TextsAndChunks) {
  for (const BadFile& bad : bad_texts()) expect_refused(bad);
}

TEST_F(BadFiles, Gltf) {
  for (const BadFile& bad : bad_gltfs()) expect_refused(bad);
}

TEST_F(BadFiles, MissingOrFolder) {
  const Result<Scene> missing = read_scene(folder_ / "none.obj");
  ASSERT_FALSE(missing);
  EXPECT_NE(missing.error().message.find("no such file"), std::string::npos);
  std::filesystem::create_directory(folder_ / "folder.obj");
  const Result<Scene> folder = read_scene(folder_ / "folder.obj");
  ASSERT_FALSE(folder);
  EXPECT_NE(folder.error().message.find("folder"), std::string::npos);
  EXPECT_EQ(folder.error().file, (folder_ / "folder.obj").string());
}

// Any byte may be damaged and any tail may be missing: whatever comes of it, it is a scene that keeps the contract or
// one Diagnostic.
TEST_F(BadFiles, DamagedFilesNeverBreakTheContract) {
  const std::vector<std::pair<std::string, std::string>> files{{"d.3ds", triangle_3ds(2)},
                                                               {"d.gltf", triangle_gltf(R"({"mesh": 0})", "0")},
                                                               {"d.obj", kObj + "vn 0 0 1\nf 1//1 2//1 3//1\n"},
                                                               {"d.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"},
                                                               {"d.ply", kPly + "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"}};
  std::uint32_t random = 12345;
  int read_anyway = 0;
  int refused = 0;
  for (const auto& [name, content] : files) {
    for (int i = 0; i < 300; ++i) {
      random = random * 1664525U + 1013904223U;
      std::string damaged = content;
      damaged[(random >> 8U) % content.size()] = static_cast<char>(random >> 24U);
      if (i % 3 == 0) damaged.resize((random >> 4U) % content.size());
      const Result<Scene> scene = read(name, damaged);
      if (scene) expect_contract(*scene);
      ++(scene ? read_anyway : refused);
    }
  }
  EXPECT_GT(read_anyway, 50);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace ninebit::scene_tests

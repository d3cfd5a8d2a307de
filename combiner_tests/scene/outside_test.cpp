// Files that a scene names: only below its folder, unless that is allowed; only regular ones.
#include <sys/stat.h>

#include "combiner_tests/scene/gltf_text.h"
#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

class NamedFilesTest : public SceneFiles {
 protected:
  void SetUp() override {
    SceneFiles::SetUp();
    std::filesystem::create_directories(folder_ / "scene/below");
    write("out.bin", triangle_bytes());
    write("scene/in.bin", triangle_bytes());
    write("scene/below/a b.bin", triangle_bytes());
    write("out.mtl", "newmtl red\nKd 1 0 0\n");
    std::filesystem::create_symlink("../out.bin", folder_ / "scene/link.bin");
    std::filesystem::create_symlink("in.bin", folder_ / "scene/inner.bin");
    ASSERT_EQ(mkfifo((folder_ / "scene/pipe.bin").c_str(), 0600), 0);
  }

  [[nodiscard]] Result<Scene> read_with(const std::string& uri, const SceneReadOptions& options = {}) const {
    std::string text = triangle_gltf(R"({"mesh": 0})", "0");
    const std::size_t at = text.find("data:");
    text.replace(at, text.find('"', at) - at, uri);
    return read_scene(write("scene/a.gltf", text), options);
  }

  void expect_refused(const std::string& uri, const std::string& says, const SceneReadOptions& options = {}) const {
    const Result<Scene> scene = read_with(uri, options);
    ASSERT_FALSE(scene) << uri;
    EXPECT_NE(scene.error().message.find(says), std::string::npos) << scene.error().message;
  }
};

TEST_F(NamedFilesTest, BuffersBelowTheFolderAreRead) {
  for (const char* uri : {"in.bin", "./in.bin", "below/a%20b.bin", "below/a b.bin", "inner.bin", "%69n.bin"}) {
    const Result<Scene> scene = read_with(uri);
    ASSERT_TRUE(scene) << uri << ": " << scene.error().message;
    EXPECT_EQ(scene->triangles.size(), 1U);
  }
}

TEST_F(NamedFilesTest, OthersAreRefusedByName) {
  const std::string absolute = (folder_ / "out.bin").string();
  expect_refused("../out.bin", "'../out.bin' leaves the folder");
  expect_refused("%2e%2e/out.bin", "'../out.bin' leaves the folder");
  expect_refused("below/../../out.bin", "leaves the folder");
  expect_refused(absolute, "is an absolute path");
  expect_refused("file://" + absolute, "is an address");
  expect_refused("http://example.org/a.bin", "is an address");
  expect_refused("link.bin", "'link.bin' is a link out of the folder");
  expect_refused("pipe.bin", "is not a regular file");
  expect_refused("below", "is not a regular file");
  expect_refused("in.bin%00", "byte 0");
}

TEST_F(NamedFilesTest, OutsideIfAllowed) {
  const SceneReadOptions allowed{.allow_outside = true};
  for (const std::string& uri : {std::string("../out.bin"), (folder_ / "out.bin").string(), std::string("link.bin")}) {
    const Result<Scene> scene = read_with(uri, allowed);
    ASSERT_TRUE(scene) << uri << ": " << scene.error().message;
  }
  // A FIFO would wait without end.
  expect_refused("pipe.bin", "pipe.bin", allowed);
  expect_refused("/dev/zero", "/dev/zero", allowed);
}

TEST_F(NamedFilesTest, MaterialLibraries) {
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  const std::string text = "mtllib ../out.mtl\n" + corners + "usemtl red\nf 1 2 3\n";
  const Result<Scene> refused = read("scene/a.obj", text);
  ASSERT_FALSE(refused);
  EXPECT_NE(refused.error().message.find("'../out.mtl' leaves the folder"), std::string::npos);
  const Result<Scene> allowed = read_scene(folder_ / "scene/a.obj", {.allow_outside = true});
  ASSERT_TRUE(allowed) << allowed.error().text();
  EXPECT_EQ(allowed->materials[allowed->triangle_material[0]].base_color, glm::vec3(1, 0, 0));
  // Without a material nobody asks for the library.
  ASSERT_TRUE(read("scene/b.obj", "mtllib ../out.mtl\n" + corners + "f 1 2 3\n"));
}

}  // namespace
}  // namespace ninebit::scene_tests

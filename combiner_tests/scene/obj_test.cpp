// The statements of OBJ files and of their material libraries.
#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

const std::string kCorners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

class ObjFiles : public SceneFiles {
 protected:
  // The colour of each triangle.
  [[nodiscard]] std::vector<glm::vec3> colors_of(const Result<Scene>& scene) const {
    std::vector<glm::vec3> colors;
    if (!scene) ADD_FAILURE() << scene.error().text();
    for (std::size_t i = 0; scene && i < scene->triangles.size(); ++i)
      colors.push_back(scene->materials[scene->triangle_material[i]].base_color);
    return colors;
  }
};

const glm::vec3 kGrey(0.6F);

TEST_F(ObjFiles, LibrariesByTheirNames) {
  write("two words.mtl", "\xEF\xBB\xBF# first\nnewmtl red\r\nKd 1 0 0 # not 0 1 0\r\nmap_Kd a.png\r\n");
  write("b.mtl", "Kd 1 1 1\nnewmtl half green\n\tKd 0 .5 0\nnewmtl grey\nKd 0.25\nnewmtl bright\nKd 3 -1 0\n");
  write("c.mtl", "newmtl odd\nKd spectral a.rfl\nKs 1 1 1\nnewmtl blue\nKd 0 0 1\nnewmtl odd\nKd nan 0 0\n");
  std::string text = "mtllib two words.mtl\nmtllib b.mtl ./c.mtl\n" + kCorners + "f 1 2 3\n";
  for (const char* name : {"red", "half green", "grey", "bright", "odd", "blue", "unknown"})
    text += std::string("usemtl ") + name + "\nf 1 2 3\n";
  const Result<Scene> scene = read("l.obj", text);
  const std::vector<glm::vec3> expected{kGrey,     {1, 0, 0}, {0, 0.5F, 0}, glm::vec3(0.25F),
                                        {1, 0, 0}, kGrey,     {0, 0, 1},    kGrey};
  EXPECT_EQ(colors_of(scene), expected);
  EXPECT_TRUE(scene->notes.empty());
}

TEST_F(ObjFiles, AFaceHasTheMaterialThatStandsBeforeIt) {
  write("m.mtl", "newmtl a\nKd 1 0 0\nnewmtl b\nKd 0 1 0\n");
  const Result<Scene> scene =
      read("m.obj", "o x\n" + kCorners + "f 1 2 3\nusemtl b\nf 1 2 3\nmtllib m.mtl\nf 1 2 3\nusemtl a\nf 1 2 3\n");
  EXPECT_EQ(colors_of(scene), (std::vector<glm::vec3>{kGrey, {0, 1, 0}, {0, 1, 0}, {1, 0, 0}}));
}

TEST_F(ObjFiles, AMissingLibraryIsNoted) {
  const std::string text = "mtllib gone.mtl\n" + kCorners + "usemtl red\nf 1 2 3\n";
  const Result<Scene> grey = read("s.obj", text);
  EXPECT_EQ(colors_of(grey), std::vector<glm::vec3>{kGrey});
  ASSERT_EQ(grey->notes.size(), 1U);
  EXPECT_EQ(grey->notes[0], "the material library 'gone.mtl' was not found; its materials are grey");
  write("s.mtl", "newmtl red\nKd 1 0 0\n");
  const Result<Scene> red = read("s.obj", text);
  EXPECT_EQ(colors_of(red), (std::vector<glm::vec3>{{1, 0, 0}}));
  ASSERT_EQ(red->notes.size(), 1U);
  EXPECT_EQ(red->notes[0], "the material library 'gone.mtl' was not found; 's.mtl' was read instead");
}

// Nobody looks for it: it may be missing, or anything.
TEST_F(ObjFiles, WithoutMaterialsNoLibraryIsRead) {
  std::filesystem::create_directory(folder_ / "folder.mtl");
  const Result<Scene> scene = read("u.obj", "mtllib folder.mtl\nmtllib gone.mtl\n" + kCorners + "f 1 2 3\n");
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_TRUE(scene->notes.empty());
  EXPECT_FALSE(read("u.obj", "mtllib folder.mtl\n" + kCorners + "usemtl a\nf 1 2 3\n"));
}

TEST_F(ObjFiles, ObjectsAndGroups) {
  const Result<Scene> scene =
      read("o.obj", kCorners +
                        "f 1 2 3\no a b\nf 1 2 3\ng one  two\nf 1 2 3\ng one two\nf 1 2 3\no last\no empty\no a\n"
                        "f 3 2 1\ng\nf 1 2 3\n");
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  std::vector<std::pair<std::string, std::uint32_t>> objects;
  for (const SceneObject& object : scene->objects) objects.emplace_back(object.name, object.triangle_count);
  const std::vector<std::pair<std::string, std::uint32_t>> expected{
      {"defaultobject", 1}, {"a", 2}, {"one two", 2}, {"", 1}};
  EXPECT_EQ(objects, expected);
  expect_near(front_of(*scene, 2), {0, 0, -1});
}

TEST_F(ObjFiles, VerticesWithWeightsAndColours) {
  const Result<Scene> scene =
      read("v.obj",
           "\xEF\xBB\xBFv 0 0 0 0.5 0.5 0.5\nv 4 0 0 2\nv 0 1 0 1 0 0 1\nvt 1\nvt 0 0 0 0\nf 1/1 2/2 3\ncstype x\n");
  ASSERT_TRUE(scene) << scene.error().text();
  EXPECT_EQ(bounds_of(*scene).high, glm::vec3(2, 1, 0));
  const Result<Scene> flat = read("w.obj", "v 0 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  ASSERT_FALSE(flat);
  EXPECT_EQ(flat.error().line, 1);
}

TEST_F(ObjFiles, NormalsStayWithTheirCorners) {
  const Result<Scene> scene = read("n.obj", kCorners + "vn 1 0 0\nvn 0 1 0\nf 1//1 2 3//2\n");
  ASSERT_TRUE(scene) << scene.error().text();
  const glm::uvec3 t = scene->triangles[0];
  expect_near(scene->normals[t.x], {1, 0, 0});
  expect_near(scene->normals[t.y], {0, 0, 1});  // none in the file
  expect_near(scene->normals[t.z], {0, 1, 0});
}

}  // namespace
}  // namespace ninebit::scene_tests

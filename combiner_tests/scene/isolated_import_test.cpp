// Importers that crash, hang, eat memory and lie, in a child process; and a right one, whose scene is the same.
#include "src/scene/files/isolated_import.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/socket.h>

#include <chrono>
#include <cstdlib>
#include <string>
#include <thread>

#include "src/system/sandbox.h"

namespace ninebit {
namespace {

Imported triangle() {
  Imported imported;
  Scene& scene = imported.scene;
  scene.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  scene.normals = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}};
  scene.triangles = {{0, 1, 2}};
  scene.triangle_object = {0};
  scene.triangle_material = {0};
  scene.objects = {{"an object", 0, 1}};
  scene.materials = {{"red", {1, 0, 0}}};
  imported.root_transform[3] = {1, 2, 3, 1};
  return imported;
}

// The fault of a file whose importer is the given one; empty if a scene came back.
std::string complaint(GeometryImport import, const std::function<bool()>& go_on = {}) {
  const auto imported = import_isolated(import, "a.3ds", "content", go_on);
  return imported ? "" : imported.error().message;
}

TEST(IsolatedImport, BringsTheWholeScene) {
  const auto imported = import_isolated(
      [](const std::filesystem::path&, std::string_view) -> Result<Imported> { return triangle(); }, "a.3ds", "", {});
  ASSERT_TRUE(imported.ok());
  const Imported expected = triangle();
  EXPECT_EQ(imported->root_transform, expected.root_transform);
  EXPECT_EQ(imported->scene.positions, expected.scene.positions);
  EXPECT_EQ(imported->scene.normals, expected.scene.normals);
  EXPECT_EQ(imported->scene.triangles, expected.scene.triangles);
  EXPECT_EQ(imported->scene.triangle_object, expected.scene.triangle_object);
  EXPECT_EQ(imported->scene.triangle_material, expected.scene.triangle_material);
  ASSERT_EQ(imported->scene.objects.size(), 1U);
  EXPECT_EQ(imported->scene.objects[0].name, "an object");
  EXPECT_EQ(imported->scene.objects[0].triangle_count, 1U);
  ASSERT_EQ(imported->scene.materials.size(), 1U);
  EXPECT_EQ(imported->scene.materials[0].name, "red");
  EXPECT_EQ(imported->scene.materials[0].base_color, glm::vec3(1, 0, 0));
}

TEST(IsolatedImport, BringsTheFault) {
  EXPECT_EQ(complaint([](const std::filesystem::path&, std::string_view content) -> Result<Imported> {
              return Diagnostic{"cannot read " + std::string(content)};
            }),
            "cannot read content");
}

TEST(IsolatedImport, SurvivesWhatItCalls) {
  EXPECT_EQ(complaint([](const std::filesystem::path&, std::string_view) -> Result<Imported> { std::abort(); }),
            "Assimp's reader of .3ds files crashed");
  EXPECT_EQ(complaint([](const std::filesystem::path&, std::string_view) -> Result<Imported> { throw 1; }),
            "Assimp's reader of .3ds files crashed");
  EXPECT_EQ(complaint([](const std::filesystem::path&, std::string_view) -> Result<Imported> {
              std::this_thread::sleep_for(std::chrono::hours(1));
              return triangle();
            }),
            "Assimp's reader of .3ds files took more than 8 s");
}

TEST(IsolatedImport, LimitsMemory) {
  if (!posix::can_limit_memory()) GTEST_SKIP() << "sanitizers map terabytes, so the address space has no limit";
  EXPECT_EQ(complaint([](const std::filesystem::path&, std::string_view) -> Result<Imported> {
              Imported imported = triangle();
              imported.scene.positions.resize(std::size_t{1} << 32U);
              return imported;
            }),
            "Assimp's reader of .3ds files needed more than 1024 MiB");
}

TEST(IsolatedImport, OpensNoFileAndNoSocket) {
  EXPECT_EQ(complaint([](const std::filesystem::path&, std::string_view) -> Result<Imported> {
              const bool reads = ::open("/etc/passwd", O_RDONLY) >= 0;
              const bool writes = ::open("ninebit-written", O_WRONLY | O_CREAT, 0666) >= 0;
              const bool connects = ::socket(AF_INET, SOCK_STREAM, 0) >= 0;
              return Diagnostic{std::string("did") + (reads ? " read" : "") + (writes ? " write" : "") +
                                (connects ? " connect" : "")};
            }),
            "did");
}

TEST(IsolatedImport, IsStoppedByTheCaller) {
  const GeometryImport hangs = [](const std::filesystem::path&, std::string_view) -> Result<Imported> {
    std::this_thread::sleep_for(std::chrono::hours(1));
    return triangle();
  };
  EXPECT_EQ(complaint(hangs, [] { return false; }), "interrupted");
}

// A scene that no importer should give is not taken for one.
template <class Change>
void expect_senseless(Change) {
  EXPECT_EQ(complaint([](const std::filesystem::path&, std::string_view) -> Result<Imported> {
              Imported imported = triangle();
              Change()(imported.scene);
              return imported;
            }),
            "Assimp's reader of .3ds files gave no scene");
}

TEST(IsolatedImport, IsNotBelieved) {
  expect_senseless([](Scene& scene) { scene.triangles[0].z = 3; });
  expect_senseless([](Scene& scene) { scene.normals.pop_back(); });
  expect_senseless([](Scene& scene) { scene.triangle_object[0] = 1; });
  expect_senseless([](Scene& scene) { scene.triangle_material.clear(); });
  expect_senseless([](Scene& scene) { scene.objects[0].triangle_count = 2; });
  expect_senseless([](Scene& scene) { scene.materials[0].base_color.x = std::nanf(""); });
  expect_senseless([](Scene& scene) { scene.positions[0].x = INFINITY; });
}

}  // namespace
}  // namespace ninebit

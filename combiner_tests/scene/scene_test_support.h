// Files for the scene tests, and what holds for every scene.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

#include "ninebit/scene/scene_io.h"

namespace ninebit::scene_tests {

// A folder of its own for each test, gone with it.
class SceneFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    static std::atomic<int> count{0};
    folder_ = std::filesystem::temp_directory_path() /
              ("ninebit_scene_" + std::to_string(getpid()) + "_" + std::to_string(count++));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path write(const std::string& name, std::string_view content) const {
    std::filesystem::path file = folder_ / name;
    std::ofstream(file, std::ios::binary).write(content.data(), static_cast<std::streamsize>(content.size()));
    return file;
  }

  [[nodiscard]] Result<Scene> read(const std::string& name, std::string_view content) const {
    return read_scene(write(name, content));
  }

  std::filesystem::path folder_;
};

inline std::string file_content(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

// The text with its first `from` replaced; a failure if there is none.
inline std::string replaced(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

inline void expect_near(const glm::vec3& actual, const glm::vec3& expected, float tolerance = 1e-5F) {
  EXPECT_NEAR(actual.x, expected.x, tolerance);
  EXPECT_NEAR(actual.y, expected.y, tolerance);
  EXPECT_NEAR(actual.z, expected.z, tolerance);
}

inline glm::vec3 front_of(const Scene& scene, std::size_t triangle) {
  const glm::uvec3 t = scene.triangles[triangle];
  const glm::vec3 a = scene.positions[t.x];
  return glm::normalize(glm::cross(scene.positions[t.y] - a, scene.positions[t.z] - a));
}

// Adds an object: a box that faces outward, or inward like a room.
inline void add_box(Scene& scene, const glm::vec3& low, const glm::vec3& high, const std::string& name,
                    bool inward = false) {
  const auto base = static_cast<std::uint32_t>(scene.positions.size());
  const auto object = static_cast<std::uint32_t>(scene.objects.size());
  scene.objects.push_back({name, static_cast<std::uint32_t>(scene.triangles.size()), 12});
  if (scene.materials.empty()) scene.materials.push_back({"plain", glm::vec3(0.5F)});
  // Vertex i lies high in x, y and z as its bits say.
  for (unsigned i = 0; i < 8; ++i) {
    scene.positions.emplace_back((i & 1U) != 0 ? high.x : low.x, (i & 2U) != 0 ? high.y : low.y,
                                 (i & 4U) != 0 ? high.z : low.z);
    scene.normals.push_back(glm::normalize(glm::vec3(i & 1U, (i >> 1U) & 1U, i >> 2U) - 0.5F));
  }
  constexpr std::array<std::array<std::uint32_t, 4>, 6> kSides{
      {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};
  for (const auto& side : kSides) {
    for (const glm::uvec3 corner : {glm::uvec3(0, 1, 2), glm::uvec3(0, 2, 3)}) {
      glm::uvec3 t(side[corner.x] + base, side[corner.y] + base, side[corner.z] + base);
      if (inward) std::swap(t.y, t.z);
      scene.triangles.push_back(t);
      scene.triangle_object.push_back(object);
      scene.triangle_material.push_back(0);
    }
  }
}

inline Scene box(const glm::vec3& low, const glm::vec3& high, bool inward = false) {
  Scene scene;
  scene.name = "box";
  add_box(scene, low, high, "box", inward);
  return scene;
}

// Everything that scene.h promises of a scene.
inline void expect_contract(const Scene& scene) {
  const Status valid = validate(scene);
  ASSERT_TRUE(valid) << valid.error().text();
  ASSERT_EQ(scene.normals.size(), scene.positions.size());
  ASSERT_EQ(scene.triangle_object.size(), scene.triangles.size());
  ASSERT_EQ(scene.triangle_material.size(), scene.triangles.size());
  for (std::size_t i = 0; i < scene.positions.size(); ++i) {
    for (glm::length_t k = 0; k < 3; ++k) ASSERT_TRUE(std::isfinite(scene.positions[i][k]));
    const float length = glm::length(scene.normals[i]);
    ASSERT_TRUE(length == 0.0F || std::abs(length - 1.0F) < 1e-5F) << length;
  }
  std::size_t covered = 0;
  for (std::size_t object = 0; object < scene.objects.size(); ++object) {
    ASSERT_EQ(scene.objects[object].first_triangle, covered);
    ASSERT_GT(scene.objects[object].triangle_count, 0U);
    for (std::size_t i = 0; i < scene.objects[object].triangle_count; ++i, ++covered) {
      ASSERT_LT(covered, scene.triangles.size());
      ASSERT_EQ(scene.triangle_object[covered], object);
      ASSERT_LT(scene.triangle_material[covered], scene.materials.size());
      for (glm::length_t k = 0; k < 3; ++k) ASSERT_LT(scene.triangles[covered][k], scene.positions.size());
    }
  }
  ASSERT_EQ(covered, scene.triangles.size());
}

}  // namespace ninebit::scene_tests

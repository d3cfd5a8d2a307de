// Gathers the faces of one object after the other into a Scene.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "ninebit/scene/scene.h"

namespace ninebit {

// Corners of one object with the same position and normal, bit for bit, become one vertex: importers hand out corners,
// techniques need shared vertices. A corner whose normal is zero or not finite gets the mean normal of the object's
// triangles at exactly its position, weighted by area; its sharing is by position alone.
class MeshBuilder {
 public:
  explicit MeshBuilder(Scene& scene) : scene_(scene) {}

  void begin_object(const std::string& name);
  [[nodiscard]] std::uint32_t vertex(const glm::vec3& position, const glm::vec3& normal);
  void triangle(const glm::uvec3& corners, std::uint32_t material);
  // Drops the object again if it got no triangle.
  void end_object();

 private:
  using Key = std::array<std::uint32_t, 6>;
  struct KeyHash {
    std::size_t operator()(const Key& key) const;
  };

  void fill_normals();

  Scene& scene_;
  std::size_t first_vertex_ = 0;
  std::unordered_map<Key, std::uint32_t, KeyHash> shared_;
};

}  // namespace ninebit

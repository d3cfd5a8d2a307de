// A scene's objects as surfaces without seams: vertices with equal positions are joined, and edges list the triangles
// that use them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "ninebit/scene/scene.h"

namespace ninebit {

// A triangle's side, from the lower to the higher number of its vertices.
struct EdgeUse {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
  std::uint32_t triangle = 0;
  bool rises = false;  // whether the triangle's order of corners runs from `low` to `high`
};

struct SurfaceFaults {
  std::uint64_t open_edges = 0;         // used by one triangle
  std::uint64_t nonmanifold_edges = 0;  // used by more than two, or by two in the same direction
  [[nodiscard]] bool none() const { return open_edges == 0 && nonmanifold_edges == 0; }
};

// Vertices of different objects are never joined, and the numbers of an object's vertices follow each other.
struct VolumeMesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;  // of the scene, in its order: their corners in `positions`
  std::vector<EdgeUse> uses;          // grouped by edge; none for triangles that use a vertex twice
  std::vector<SurfaceFaults> faults;  // of each of the scene's objects
};

// Joins positions that compare equal: 0 and -0 are the same.
[[nodiscard]] VolumeMesh volume_mesh(const Scene& scene);

// The end of the group of uses of one edge that begins at `first`.
[[nodiscard]] std::size_t end_of_edge(const std::vector<EdgeUse>& uses, std::size_t first);

// Whether a triangle uses a vertex twice.
[[nodiscard]] inline bool has_corner_twice(const glm::uvec3& t) {
  return t.x == t.y || t.y == t.z || t.z == t.x;
}

}  // namespace ninebit

// Vertices at the same position.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

namespace ninebit {

// For each vertex its place: places are numbered in the order in which the triangles first use them, and vertices whose
// positions have the same bits share one. `of_vertex` is kNoPlace for vertices that no triangle uses.
inline constexpr unsigned int kNoPlace = ~0U;
struct WeldedVertices {
  std::vector<unsigned int> of_vertex{};
  std::size_t places = 0;
};
[[nodiscard]] WeldedVertices weld_vertices(std::span<const glm::uvec3> triangles, std::span<const glm::vec3> positions);

}  // namespace ninebit

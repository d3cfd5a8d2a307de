#include "src/bench/provoking_vertices.h"

#include <numeric>

namespace ninebit::bench {

ProvokingVertices provoking_vertices(std::span<const glm::uvec3> triangles, std::span<const ColorBytes> colors,
                                     std::size_t vertices) {
  ProvokingVertices result;
  result.source.resize(vertices);
  std::iota(result.source.begin(), result.source.end(), 0U);
  result.colors.resize(vertices, ColorBytes{});
  std::vector<bool> taken(vertices, false);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    glm::uvec3 triangle = triangles[t];
    const auto serves = [&](std::uint32_t v) { return !taken[v] || result.colors[v] == colors[t]; };
    for (int turns = 0; turns < 2 && !serves(triangle.z); ++turns) triangle = {triangle.y, triangle.z, triangle.x};
    if (!serves(triangle.z)) {
      result.source.push_back(triangle.z);
      triangle.z = static_cast<std::uint32_t>(result.colors.size());
      result.colors.emplace_back();
      taken.push_back(false);
    }
    taken[triangle.z] = true;
    result.colors[triangle.z] = colors[t];
    result.triangles.push_back(triangle);
  }
  return result;
}

}  // namespace ninebit::bench

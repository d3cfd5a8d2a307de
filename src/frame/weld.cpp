#include "src/frame/weld.h"

#include <array>
#include <bit>
#include <cstddef>

namespace ninebit {
namespace {

using PositionBits = std::array<std::uint32_t, 3>;

PositionBits bits_of_position(const glm::vec3& p) {
  return {std::bit_cast<std::uint32_t>(p.x), std::bit_cast<std::uint32_t>(p.y), std::bit_cast<std::uint32_t>(p.z)};
}

std::size_t hash_of_bits(const PositionBits& bits) {
  std::uint64_t hash = 0;
  for (const std::uint32_t word : bits) {
    hash = (hash ^ word) * 0x9e3779b97f4a7c15U;
    hash ^= hash >> 29;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace

WeldedVertices weld_vertices(std::span<const glm::uvec3> triangles, std::span<const glm::vec3> positions) {
  WeldedVertices out;
  out.of_vertex.assign(positions.size(), kNoPlace);
  // An open hash table of vertices, one for each place, at most half full.
  std::vector<std::uint32_t> table(std::bit_ceil(2 * positions.size() + 1), kNoPlace);
  const std::size_t mask = table.size() - 1;
  const auto place_of_vertex = [&](std::uint32_t vertex) {
    const PositionBits bits = bits_of_position(positions[vertex]);
    for (std::size_t at = hash_of_bits(bits) & mask;; at = (at + 1) & mask) {
      if (table[at] == kNoPlace) {
        table[at] = vertex;
        return static_cast<unsigned int>(out.places++);
      }
      if (bits_of_position(positions[table[at]]) == bits) return out.of_vertex[table[at]];
    }
  };
  for (const glm::uvec3& triangle : triangles) {
    for (glm::length_t corner = 0; corner < 3; ++corner) {
      unsigned int& place = out.of_vertex[triangle[corner]];
      if (place == kNoPlace) place = place_of_vertex(triangle[corner]);
    }
  }
  return out;
}

}  // namespace ninebit

// Vertices at the same position, as meshoptimizer's library finds them.
#include <gtest/gtest.h>
#include <meshoptimizer.h>

#include <random>
#include <vector>

#include "src/frame/surface_groups.h"

namespace ninebit {
namespace {

TEST(Weld, AgreesWithMeshoptimizer) {
  std::mt19937 random(1);
  for (int round = 0; round < 200; ++round) {
    // Few coordinates, so that positions meet; zeros of both signs, which differ.
    const std::vector<float> coordinates{0.0F, -0.0F, 1.0F, 0.25F, 1e-30F};
    const auto coordinate = [&] { return coordinates[random() % coordinates.size()]; };
    std::vector<glm::vec3> positions(1 + random() % 300);
    for (glm::vec3& p : positions) p = {coordinate(), coordinate(), coordinate()};
    const auto vertex = [&] { return static_cast<unsigned>(random() % positions.size()); };
    std::vector<glm::uvec3> triangles(1 + random() % 100);
    std::vector<unsigned> indices;
    for (glm::uvec3& t : triangles) {
      t = {vertex(), vertex(), vertex()};
      indices.insert(indices.end(), {t.x, t.y, t.z});
    }
    std::vector<unsigned> expected(positions.size());
    const std::size_t places = meshopt_generateVertexRemap(expected.data(), indices.data(), indices.size(),
                                                           positions.data(), positions.size(), sizeof(glm::vec3));
    const WeldedVertices welded = weld_vertices(triangles, positions);
    ASSERT_EQ(welded.places, places);
    ASSERT_EQ(welded.of_vertex, expected);
  }
}

}  // namespace
}  // namespace ninebit

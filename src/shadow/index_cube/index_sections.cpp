#include "src/shadow/index_cube/index_sections.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <utility>

#include "ninebit/frame/index_codes.h"
#include "src/frame/surface_groups.h"

namespace ninebit {
namespace {

// meshoptimizer's cone weight: how far a section prefers triangles of its own orientation to near ones.
constexpr float kFlatness = 0.5F;

// A position with more corners becomes several vertices. For each triangle added to a section, meshoptimizer visits all
// remaining triangles at the section's vertices: around the apex of a fan this would take quadratic time.
constexpr unsigned int kMaxValence = 1024;

// meshoptimizer requires a multiple of four.
std::size_t triangles_in_section(int size) {
  return static_cast<std::size_t>(size / 4 * 4);
}

using Corners = std::array<unsigned int, 3>;

// One object's triangles, scaled into a box of size 1, with their own vertices: one per position, or per kMaxValence
// corners there.
struct ObjectMesh {
  std::vector<unsigned int> indices;
  std::vector<glm::vec3> positions;
};

class SectionCutter {
 public:
  SectionCutter(const Scene& scene, int size)
      : scene_(scene),
        size_(triangles_in_section(size)),
        place_(weld_vertices(scene.triangles, scene.positions).of_vertex) {
    sections_.of_triangle.resize(scene.triangles.size());
    in_mesh_.assign(scene.positions.size(), kNowhere);
    corners_at_.resize(scene.positions.size());
  }

  Sections cut() {
    for (const SceneObject& object : scene_.objects) cut(object);
    return std::move(sections_);
  }

 private:
  static constexpr unsigned int kNowhere = ~0U;

  ObjectMesh mesh_of(const SceneObject& object) {
    ObjectMesh mesh;
    glm::vec3 low(scene_.positions[scene_.triangles[object.first_triangle].x]), high = low;
    std::vector<unsigned int> met;
    for (std::size_t t = object.first_triangle; t < std::size_t{object.first_triangle} + object.triangle_count; ++t) {
      for (glm::length_t corner = 0; corner < 3; ++corner) {
        const unsigned int vertex = scene_.triangles[t][corner], place = place_[vertex];
        if (in_mesh_[place] == kNowhere || corners_at_[place] == kMaxValence) {
          corners_at_[place] = 0;
          in_mesh_[place] = static_cast<unsigned int>(mesh.positions.size());
          met.push_back(place);
          mesh.positions.push_back(scene_.positions[vertex]);
          low = glm::min(low, mesh.positions.back());
          high = glm::max(high, mesh.positions.back());
        }
        ++corners_at_[place];
        mesh.indices.push_back(in_mesh_[place]);
      }
    }
    for (const unsigned int place : met) in_mesh_[place] = kNowhere;
    // At size 1, squares of areas stay within the range of a float for objects of any size.
    const glm::vec3 size = high - low;
    const float largest = std::max({size.x, size.y, size.z});
    const float scale = largest > 0.0F ? 1.0F / largest : 1.0F;
    for (glm::vec3& position : mesh.positions) position = (position - low) * scale;
    return mesh;
  }

  void cut(const SceneObject& object) {
    const ObjectMesh mesh = mesh_of(object);
    const std::size_t most = meshopt_buildMeshletsBound(mesh.indices.size(), kMaxSectionVertices, size_);
    std::vector<meshopt_Meshlet> meshlets(most);
    std::vector<unsigned int> vertices(most * kMaxSectionVertices);
    std::vector<unsigned char> corners(most * size_ * 3);
    meshlets.resize(meshopt_buildMeshlets(meshlets.data(), vertices.data(), corners.data(), mesh.indices.data(),
                                          mesh.indices.size(), &mesh.positions[0].x, mesh.positions.size(),
                                          sizeof(glm::vec3), kMaxSectionVertices, size_, kFlatness));
    // A meshlet identifies a triangle only by its corners, in the mesh's order. Equal triangles are matched in sorted
    // order.
    std::vector<std::pair<Corners, std::uint32_t>> cut, asked;
    for (const meshopt_Meshlet& meshlet : meshlets) {
      const unsigned int* const vertex = vertices.data() + meshlet.vertex_offset;
      for (std::size_t i = 0; i < meshlet.triangle_count; ++i) {
        const unsigned char* const c = corners.data() + meshlet.triangle_offset + 3 * i;
        cut.push_back({{vertex[c[0]], vertex[c[1]], vertex[c[2]]}, sections_.count});
      }
      ++sections_.count;
    }
    for (std::uint32_t t = 0; t < object.triangle_count; ++t) {
      const unsigned int* const c = mesh.indices.data() + std::size_t{3} * t;
      asked.push_back({{c[0], c[1], c[2]}, object.first_triangle + t});
    }
    std::sort(cut.begin(), cut.end());
    std::sort(asked.begin(), asked.end());
    for (std::size_t i = 0; i < asked.size(); ++i) sections_.of_triangle[asked[i].second] = cut[i].second;
  }

  const Scene& scene_;
  std::size_t size_;
  std::vector<unsigned int> place_;       // per vertex of the scene
  std::vector<unsigned int> in_mesh_;     // latest vertex at each position, in the object being cut
  std::vector<unsigned int> corners_at_;  // triangle corners at that vertex
  Sections sections_;
};

}  // namespace

Sections cut_into_sections(const Scene& scene, int size) {
  return SectionCutter(scene, size).cut();
}

std::uint64_t most_sections(const Scene& scene, int size) {
  std::uint64_t most = 0;
  for (const SceneObject& object : scene.objects) {
    most += meshopt_buildMeshletsBound(std::size_t{object.triangle_count} * 3, kMaxSectionVertices,
                                       triangles_in_section(size));
  }
  return most;
}

}  // namespace ninebit

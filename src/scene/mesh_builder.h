// Adds the faces of one object after the other to a Scene.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ninebit/scene/scene.h"

namespace ninebit {

// The position of a mesh in the world.
struct MeshPlace {
  glm::dmat4 world{1.0};    // from the mesh to the world
  glm::dmat3 normals{1.0};  // the inverse transpose of its linear part, up to a positive factor
  bool mirrored = false;    // whether fronts become backs

  [[nodiscard]] static MeshPlace of(const glm::dmat4& world);
};

// A hash table of vertex numbers, keyed by the bits of the vertices' data in the scene. Its memory and the time to
// clear it are proportional to its number of vertices.
class VertexTable {
 public:
  void clear();
  // Makes room for one more vertex; `hash_of` returns the hash of a vertex in the table.
  template <class HashOf>
  void reserve_one(HashOf hash_of);
  // The slot of the vertex for which `matches` is true, or the free slot for it. Only after reserve_one().
  template <class Matches>
  [[nodiscard]] std::uint32_t& slot(std::size_t hash, Matches matches);

  static constexpr std::uint32_t kFree = 0xFFFFFFFFU;
  std::size_t count = 0;

 private:
  std::vector<std::uint32_t> slots_;  // a power of two, at most half of them used
};

// Corners of one object with the same position and normal, bit for bit, become one vertex: files store corners,
// techniques need shared vertices. A corner whose normal is zero or not finite gets the mean normal of the object's
// triangles at exactly its position, weighted by area; such corners are shared by position only.
class MeshBuilder {
 public:
  explicit MeshBuilder(Scene& scene) : scene_(scene) {}

  void begin_object(const std::string& name);
  [[nodiscard]] std::uint32_t vertex(const glm::vec3& position, const glm::vec3& normal);
  void triangle(const glm::uvec3& corners, std::uint32_t material);
  // Removes the object if it has no triangle.
  void end_object();

  // Adds a vertex of a mesh, transformed by `place`. Returns a fault if its position is then not finite.
  [[nodiscard]] std::optional<std::string> vertex_at(const MeshPlace& place, const glm::vec3& position,
                                                     const glm::vec3& normal, std::uint32_t& vertex);
  // Adds the triangles of a polygon with three corners or more, which are vertices of this object. Returns a fault for
  // a concave polygon with too many corners and for a scene with too many triangles.
  [[nodiscard]] std::optional<std::string> polygon(std::span<const std::uint32_t> corners, std::uint32_t material,
                                                   bool mirrored = false);

 private:
  void fill_normals();

  Scene& scene_;
  std::size_t first_vertex_ = 0;
  VertexTable shared_;
  std::uint64_t effort_ = 0;  // of cutting concave polygons
  std::vector<glm::vec3> outline_;
  std::vector<std::array<std::uint32_t, 3>> pieces_;
};

}  // namespace ninebit

// Adds the faces of one object after the other to a Scene.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
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

// A corner as a file gives it.
struct MeshVertex {
  glm::vec3 position{0.0F};
  glm::vec3 normal{0.0F};  // zero: the file has none
  std::optional<glm::vec2> texture_coordinate{};
  std::optional<glm::vec4> tangent{};  // as in Scene; of any length
  std::optional<glm::vec4> color{};
  std::optional<glm::vec4> secondary_color{};
  std::optional<float> fog_factor{};
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

// Corners of one object with equal data, bit for bit, become one vertex: files store corners,
// techniques need shared vertices. A corner whose normal is zero or not finite gets the mean normal of the object's
// triangles at exactly its position, weighted by area. Texture coordinates, tangents, colours, secondary colours and
// fog factors that a corner does not have, while others of the scene do, are (0, 0), zero, white, black and 1.
class MeshBuilder {
 public:
  explicit MeshBuilder(Scene& scene) : scene_(scene) {}

  void begin_object(const std::string& name);
  [[nodiscard]] std::uint32_t vertex(const MeshVertex& corner);
  void triangle(const glm::uvec3& corners, std::uint32_t material);
  // Removes the object if it has no triangle.
  void end_object();

  // Adds a vertex of a mesh, transformed by `place`. Returns a fault if its position is then not finite.
  [[nodiscard]] std::optional<std::string> vertex_at(const MeshPlace& place, MeshVertex corner, std::uint32_t& vertex);
  // Adds the triangles of a polygon with three corners or more, which are vertices of this object. Returns a fault for
  // a concave polygon with too many corners and for a scene with too many triangles.
  [[nodiscard]] std::optional<std::string> polygon(std::span<const std::uint32_t> corners, std::uint32_t material,
                                                   bool mirrored = false);

 private:
  // The data of a vertex in the scene, or of a corner as the scene would hold it.
  struct Stored {
    glm::vec3 position, normal;
    glm::vec2 texture_coordinate;
    glm::vec4 tangent;
    glm::vec4 color;
    glm::vec4 secondary_color;
    float fog_factor;
  };
  [[nodiscard]] Stored stored(std::uint32_t vertex) const;
  [[nodiscard]] static bool equal(const Stored& a, const Stored& b);
  [[nodiscard]] static std::size_t hash(const Stored& vertex);
  void fill_normals();

  Scene& scene_;
  std::size_t first_vertex_ = 0;
  VertexTable shared_;
  std::uint64_t effort_ = 0;  // of cutting concave polygons
  std::vector<glm::vec3> outline_;
  std::vector<std::array<std::uint32_t, 3>> pieces_;
};

// Triangulation of polygons.

// Concave polygons with more corners are rejected: the time to cut them is quadratic in the corners.
inline constexpr std::size_t kMostConcaveCorners = 4096;

// The largest sum, over a scene's concave polygons, of the squares of their corner counts; polygons with few corners do
// not count.
inline constexpr std::uint64_t kMostConcaveEffort = std::uint64_t{1} << 27U;
inline constexpr std::size_t kSmallPolygon = 16;

// Appends the n - 2 triangles of a polygon with n >= 3 corners, each as three indices into corners, in the polygon's
// winding. Convex polygons become a fan around their first corner. If no ear is left (the polygon crosses itself or has
// no area), the rest becomes a fan, so that the count is always n - 2. Returns false, with nothing appended, for a
// concave polygon beyond kMostConcaveCorners. `effort` grows by the square of a concave polygon's corners, which is
// proportional to the time to cut it.
[[nodiscard]] bool triangulate(std::span<const glm::vec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles,
                               std::uint64_t* effort = nullptr);

}  // namespace ninebit

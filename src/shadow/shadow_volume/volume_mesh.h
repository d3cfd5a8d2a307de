// A scene's objects as surfaces without seams: vertices with equal positions are joined, and edges list the triangles
// that use them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ninebit/raster/pipeline_state.h"
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

// Shadow volumes as triangles: the space behind a surface, seen from the light, up to infinity.

// The light in homogeneous coordinates: its position with w = 1, or the direction to it with w = 0.
[[nodiscard]] glm::dvec4 homogeneous_light(const Light& light);

// For each triangle: 1 if its front faces the light, -1 if its back does, 0 if it is edge-on or has no area. Every part
// of a volume is made from these values, so a rounding error in them opens no gap.
[[nodiscard]] std::vector<std::int8_t> facing_of(const VolumeMesh& mesh, const glm::dvec4& light);

// The triangles that cast a shadow. 1: as it is; -1: with its corners reversed, so that its front faces the light; 0:
// casts none. In a closed object the triangles that face the light cast, since they cover the others; in any other
// object all triangles cast. Triangles that `cull` removes, as seen from the light, do not cast. If it removes the
// fronts of a closed object, its backs cast.
[[nodiscard]] std::vector<std::int8_t> casters_of(const Scene& scene, const VolumeMesh& mesh,
                                                  std::span<const std::int8_t> facing, CullFace cull);

// Triangles, each with the number of the scene's triangle that it comes from.
struct VolumeTriangles {
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> casters;
  void add(const glm::uvec3& triangle, std::uint32_t caster) {
    triangles.push_back(triangle);
    casters.push_back(caster);
  }
};

struct VolumeCaps {
  bool front = true;  // the casters themselves
  bool back = true;   // the casters moved away from the light to infinity (for a directional light a point: no cap)
};

// The boundary of all casters' volumes. On a ray to a point, crossings into a volume minus crossings out of one are the
// number of casters between that point and the light.
struct ShadowVolumes {
  std::vector<glm::vec4> positions;  // homogeneous: the mesh's, then the same moved away from the light to infinity
  VolumeTriangles outward;           // their fronts are outside
  // Their backs are outside: front caps of casters whose back faces the light. They keep the scene's order of corners,
  // which clipping depends on, so that they have exactly the surface's depth.
  VolumeTriangles inward;
  std::uint64_t silhouette_edges = 0;  // edges with a side
};

// An edge has a side if the casters, with their fronts to the light, run along it more often in one direction than in
// the other: around the silhouette of a closed object, and around every caster without a neighbour.
[[nodiscard]] ShadowVolumes extrude(const VolumeMesh& mesh, std::span<const std::int8_t> casters,
                                    const glm::dvec4& light, const VolumeCaps& caps);

// The pyramid that a spot light shines through (light_projection), up to infinity, with its fronts inside: counted like
// a shadow volume, it subtracts 1 inside. `clip_from_world` is the light's projection.
struct LightPyramid {
  std::vector<glm::vec4> positions;
  std::vector<glm::uvec3> triangles;
};
[[nodiscard]] LightPyramid light_pyramid(const glm::mat4& clip_from_world, const Light& light);

}  // namespace ninebit

// Shadow volumes as triangles: what lies behind a surface, seen from the light, up to infinity.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ninebit/raster/pipeline_state.h"
#include "ninebit/scene/scene.h"
#include "src/shadow/shadow_volume/volume_mesh.h"

namespace ninebit {

// The light in homogeneous coordinates: its position with w = 1, or the direction to it with w = 0.
[[nodiscard]] glm::dvec4 homogeneous_light(const Light& light);

// For each triangle 1 where its front is turned to the light, -1 where its back is, 0 where it is seen edge-on or has
// no area. Everything about a volume that depends on this takes it from here, so that a rounding error in it opens no
// gap.
[[nodiscard]] std::vector<std::int8_t> facing_of(const VolumeMesh& mesh, const glm::dvec4& light);

// Which triangles cast a shadow: 1 as they are, -1 with the order of their corners reversed, which then turns their
// front to the light; 0: none. Of a closed object those whose front is turned to the light, which cover the others;
// of any other object all. What `cull` leaves out as seen from the light casts none; where it leaves out the fronts of
// a closed object, its backs cast.
[[nodiscard]] std::vector<std::int8_t> casters_of(const Scene& scene, const VolumeMesh& mesh,
                                                  std::span<const std::int8_t> facing, CullFace cull);

// Triangles, and for each the scene's that it comes from.
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
  bool back = true;   // the casters moved away from the light to infinity (of a directional light a point: none)
};

// The border of all casters' volumes together. A ray that ends at some point crosses it from outside to inside as many
// times more often than back as there are casters between that point and the light.
struct ShadowVolumes {
  std::vector<glm::vec4> positions;  // homogeneous: the mesh's, then these moved away from the light to infinity
  VolumeTriangles outward;           // fronts outside
  // Backs outside: front caps of casters whose back is turned to the light. They have to be drawn in the scene's order
  // of corners, as clipping cuts a triangle by it, to have the depth of the surface itself.
  VolumeTriangles inward;
  std::uint64_t silhouette_edges = 0;  // that sides come from
};

// Sides stand on every edge along which casters, turned to the light, do not run as often in one direction as in the
// other: around the silhouette of a closed object, and around every caster without a neighbour.
[[nodiscard]] ShadowVolumes extrude(const VolumeMesh& mesh, std::span<const std::int8_t> casters,
                                    const glm::dvec4& light, const VolumeCaps& caps);

// What a spot light shines through (light_projection), up to infinity, its fronts inside: counted like a shadow volume,
// it takes 1 away within. Clip coordinates are those of the light's projection.
struct LightPyramid {
  std::vector<glm::vec4> positions;
  std::vector<glm::uvec3> triangles;
};
[[nodiscard]] LightPyramid light_pyramid(const glm::mat4& clip_from_world, const Light& light);

}  // namespace ninebit

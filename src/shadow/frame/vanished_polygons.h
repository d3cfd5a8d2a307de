// Polygons that are too small or too thin for the light's cube map.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/raster/prepared_draw.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

struct VanishedPolygons {
  std::vector<std::uint32_t> triangles;  // their numbers in the scene, in its order
  double texels = 0.0;                   // their area on the faces together, in texels
};

// The scene's triangles that cover the centre of no texel in any of the six faces of `size` texels, as they were
// prepared from positions relative to the light, though they have an area in one beyond the near plane. What is culled
// is not missed.
[[nodiscard]] VanishedPolygons find_vanished_polygons(const Scene& scene, std::span<const glm::vec3> from_light,
                                                      std::span<const PreparedDraw, 6> faces, int size,
                                                      float near_plane, CullFace cull_face);

}  // namespace ninebit

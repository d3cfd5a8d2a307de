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
  double texels = 0.0;                   // their total area on the faces, in texels
};

// Finds the scene's triangles that cover no texel centre of the six faces, of `size` texels a side, although they have
// an area on one beyond the near plane. `faces` were prepared from the positions relative to the light. Culled
// triangles are not included.
[[nodiscard]] VanishedPolygons find_vanished_polygons(const Scene& scene, std::span<const glm::vec3> from_light,
                                                      std::span<const PreparedDraw, 6> faces, int size,
                                                      float near_plane, CullFace cull_face);

}  // namespace ninebit

// Records which polygon each of the camera's fragments found in the light's map, which explains wrong shadows
// (ShadowEvidence in technique.h).
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/prepared_draw.h"
#include "ninebit/raster/surface.h"
#include "ninebit/scene/scene.h"
#include "src/frame/camera_frame.h"

namespace ninebit {

// How a technique drew the scene's triangles into its map, and how the camera's fragments look the map up.
struct LightMap {
  PipelineState pass{};                      // its culling, polygon offset and depth test are used
  std::span<const glm::vec3> positions{};    // as drawn, one per vertex
  std::span<const glm::mat4> projections{};  // one for a 2D map; six for a cube map, in the order of CubeFace
  int size = 0;                              // texels a side
  DepthStencilFormat format = DepthStencilFormat::d24s8;  // of the map's depth
  // Lookup coordinates, one per vertex. Of a cube map: the direction (x, y, z); empty: the positions. Of a 2D map: s, t
  // and q as the components x, y and w; a lookup with q <= 0 or outside [0, 1] finds nothing.
  std::span<const glm::vec4> coordinates{};
};

// Draws the map again with the number of the triangle in each texel. Records in the rendering's evidence the triangle
// in the texel that NEAREST selects for the visible fragment of each pixel, and which triangles own a texel. The
// frame's depth must be drawn. Does nothing without settings.evidence. Reports what rasterize() reports.
[[nodiscard]] Status add_map_evidence(CameraFrame& frame, const LightMap& map);

// Polygons that are too small or too thin for the light's cube map.

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

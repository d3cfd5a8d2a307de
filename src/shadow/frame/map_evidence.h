// Which polygon each fragment of the camera's view met in the light's map: what the causes of wrong shadows are told
// from (technique.h: ShadowEvidence).
#pragma once

#include <glm/glm.hpp>
#include <span>

#include "ninebit/numerics/result.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"
#include "src/shadow/frame/camera_frame.h"

namespace ninebit {

// How a technique drew the scene's triangles into its map, and how the camera's fragments look the map up.
struct LightMap {
  PipelineState pass{};                      // of the drawing: its culling, polygon offset and depth test count here
  std::span<const glm::vec3> positions{};    // what was drawn, one a vertex
  std::span<const glm::mat4> projections{};  // one for a 2D map; six for a cube map, in the order of CubeFace
  int size = 0;                              // texels a side
  DepthStencilFormat format = DepthStencilFormat::d24s8;  // of the map's depth
  // What a fragment looks up, one a vertex: the direction (x, y, z) into a cube map; s, t and q, as the components x, y
  // and w, of a 2D map, where nothing is found with q <= 0 or outside [0, 1]. Empty: the positions, of a cube map.
  std::span<const glm::vec4> coordinates{};
};

// Draws the map again with the number of the triangle in each texel, and notes in the rendering's evidence which one
// stands in the texel that NEAREST selects for the fragment that is seen at each pixel, and which triangles own a
// texel. The frame's depth must be drawn. Without settings.evidence it does nothing. Reports what rasterize() reports.
[[nodiscard]] Status add_map_evidence(CameraFrame& frame, const LightMap& map);

}  // namespace ninebit

// Draws index cube shadows frame by frame. Everything that stays the same between frames is made once.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "ninebit/raster/plane_samples.h"
#include "ninebit/raster/prepared_draw.h"
#include "ninebit/shadow/index_cube.h"
#include "src/frame/camera_frame.h"
#include "src/frame/map_evidence.h"
#include "src/shadow/index_cube/index_assignment.h"

namespace ninebit {

// One scene seen from its camera, lit by its light. Made once: index colours, vertex colours, projections, surfaces.
// Per frame: draw_maps, then draw_camera. Both clear the surfaces that they draw into, so any number of frames can be
// drawn into them.
class IndexCubeRenderer {
 public:
  // The scene must outlive the renderer. Reports what render_index_cube reports.
  [[nodiscard]] static Result<IndexCubeRenderer> make(const Scene& scene, const RenderSettings& settings);

  // Draws indices from the light into the six faces.
  Status draw_maps();
  // Draws the camera's passes: depth; shadows into the stencil buffer; colour where the stencil is 0, and where it is
  // 1. They are drawn together, tile by tile, and the rendering's time for each is its share of the whole. With layers,
  // a watched pixel, light_facing, textures or alpha masks each pass is drawn and timed by itself.
  Status draw_camera();
  // Draws only the first two of these passes, each by itself, for a technique with its own colour passes.
  Status draw_shadows();

  // Finds the polygons that vanish from the map. Call it between draw_maps and draw_camera.
  void find_vanished();
  // With settings.evidence, after a frame: records ShadowEvidence in the rendering.
  Status add_evidence();
  // After draw_camera: counts pixels, completes layers and facts, and reads the picked pixel.
  Status finish();

  // The rendering so far. The caller sets its times of the scene's set-up and of the map.
  [[nodiscard]] const Rendering& rendering() const { return frame_.rendering(); }
  [[nodiscard]] Rendering& rendering() { return frame_.rendering(); }

  // The inputs of the passes, for another renderer of the same frame.
  [[nodiscard]] CameraFrame& frame() { return frame_; }
  [[nodiscard]] const glm::mat4& camera_projection() const { return frame_.projection(); }
  [[nodiscard]] const std::array<glm::mat4, 6>& face_projections() const { return face_projections_; }
  [[nodiscard]] const std::vector<ColorBytes>& index_colors() const { return indices_.color; }  // one per triangle
  [[nodiscard]] const VertexShading& shading() const { return frame_.shading(); }

 private:
  IndexCubeRenderer(CameraFrame frame, IndexCubePasses passes, IndexAssignment indices);

  // Whether masked triangles leave holes in the map.
  [[nodiscard]] bool masks_map() const;
  Status draw_masked_face(std::size_t face, RenderTarget& target) const;
  Status draw_camera_together();
  Status draw_comparison();

  void make_map();
  // The planes of a face that are drawn and looked up.
  [[nodiscard]] std::array<Plane<std::uint8_t>, 4> face_planes(std::size_t face);
  Result<std::uint64_t> count_vanished_pixels();
  Status pick(const glm::ivec2& pixel);
  [[nodiscard]] bool faces_light(std::size_t triangle) const;

  // Some of the scene's triangles, with their index colours. With settings.layers all of them, the others without area,
  // so that the numbers of primitives are the scene's.
  struct TriangleSet {
    std::vector<glm::uvec3> triangles;
    std::vector<ColorBytes> index_colors;
    std::vector<std::uint32_t> numbers;  // in the scene
  };
  [[nodiscard]] TriangleSet light_facing_triangles() const;

  CameraFrame frame_;
  IndexCubePasses passes_;
  IndexAssignment indices_;
  std::array<glm::mat4, 6> face_projections_{};
  float near_plane_ = 0.0F;                               // of the faces' views
  std::vector<glm::vec3> from_light_;                     // positions relative to the light
  std::array<PlaneSamples<std::uint32_t>, 6> map_depth_;  // discarded; not even written if passes share tiles
  Texture map_;                                           // a view of the faces in the rendering
  std::array<PreparedDraw, 6> prepared_;                  // one per face; the camera's draw reuses the first
  VanishedPolygons vanished_;
};

}  // namespace ninebit

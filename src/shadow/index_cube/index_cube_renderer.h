// Index cube shadows, frame after frame: what a frame does not change is made once.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "ninebit/raster/plane_samples.h"
#include "ninebit/raster/prepared_draw.h"
#include "ninebit/shadow/index_cube.h"
#include "src/shadow/frame/camera_frame.h"
#include "src/shadow/frame/vanished_polygons.h"
#include "src/shadow/index_cube/index_assignment.h"

namespace ninebit {

// One scene seen from its camera, lit by its light. Made once: index colours, vertex colours, projections, surfaces.
// Drawn each frame: draw_maps, then draw_camera. Each clears what it begins with, so that a frame follows another in
// the same surfaces.
class IndexCubeRenderer {
 public:
  // The scene must outlive the renderer. Reports what render_index_cube reports.
  [[nodiscard]] static Result<IndexCubeRenderer> make(const Scene& scene, const RenderSettings& settings);

  // Indices, from the light into the six faces.
  Status draw_maps();
  // The camera's passes: depth; shadows into the stencil buffer; colour where the stencil is 0, and where it is 1. They
  // are drawn tile by tile together, unless layers, a watched pixel or light_facing ask for each by itself. The times
  // of the passes, which go into the rendering's, are then their shares of the whole.
  Status draw_camera();
  // The first two of these passes alone, each by itself, for a technique that goes on otherwise.
  Status draw_shadows();

  // Between draw_maps and draw_camera: finds the polygons that vanish from the map.
  void find_vanished();
  // With settings.evidence, after a frame: what each pixel's shadow was decided by.
  Status add_evidence();
  // After draw_camera: counts pixels, completes layers and facts, and reads the picked pixel.
  Status finish();

  // What has been drawn so far; its times are the caller's.
  [[nodiscard]] const Rendering& rendering() const { return frame_.rendering(); }
  [[nodiscard]] Rendering& rendering() { return frame_.rendering(); }

  // What the passes draw with, for another renderer of the same frame.
  [[nodiscard]] CameraFrame& frame() { return frame_; }
  [[nodiscard]] const glm::mat4& camera_projection() const { return frame_.projection(); }
  [[nodiscard]] const std::array<glm::mat4, 6>& face_projections() const { return face_projections_; }
  [[nodiscard]] const std::vector<ColorBytes>& index_colors() const { return indices_.color; }  // one a triangle
  [[nodiscard]] const VertexShading& shading() const { return frame_.shading(); }

 private:
  IndexCubeRenderer(CameraFrame frame, IndexCubePasses passes, IndexAssignment indices);

  Status draw_camera_together();
  Status draw_comparison();

  void make_map();
  // What of a face is drawn and looked up.
  [[nodiscard]] std::array<Plane<std::uint8_t>, 4> face_planes(std::size_t face);
  Result<std::uint64_t> count_vanished_pixels();
  Status pick(const glm::ivec2& pixel);
  [[nodiscard]] bool faces_light(std::size_t triangle) const;

  // A share of the scene's triangles with their index colours.
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
  float near_plane_ = 0.0F;                               // of the faces
  std::vector<glm::vec3> from_light_;                     // positions relative to the light, of the frame being drawn
  std::array<PlaneSamples<std::uint32_t>, 6> map_depth_;  // discarded: never touched where tiles share it
  Texture map_;                                           // views the faces
  std::array<PreparedDraw, 6> prepared_;                  // one a face; the camera uses the first one's memory again
  VanishedPolygons vanished_;
};

}  // namespace ninebit

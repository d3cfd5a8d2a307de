// Index cube shadows, frame after frame: what a frame does not change is made once.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <string_view>
#include <vector>

#include "ninebit/raster/prepared_draw.h"
#include "ninebit/shadow/index_cube.h"
#include "src/shadow/shading.h"

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
  // of the passes are then their shares of the whole.
  Status draw_camera(PassTimes& times);

  // Counts lit, shadowed and background pixels, and names the polygons of the layers.
  void count();

  // What has been drawn so far; its times are the caller's.
  [[nodiscard]] const Rendering& rendering() const { return rendering_; }
  [[nodiscard]] Rendering& rendering() { return rendering_; }

  // What the passes draw with, for another renderer of the same frame.
  [[nodiscard]] const glm::mat4& camera_projection() const { return camera_projection_; }
  [[nodiscard]] const std::array<glm::mat4, 6>& face_projections() const { return face_projections_; }
  [[nodiscard]] const std::vector<ColorBytes>& index_colors() const { return index_colors_; }  // one a triangle
  [[nodiscard]] const VertexShading& shading() const { return shading_; }

  static constexpr ColorBytes kBackground{38, 42, 51, 255};

 private:
  IndexCubeRenderer(const Scene& scene, const RenderSettings& settings, IndexCubePasses passes, Surface frame);

  // One of the camera's passes. All of them draw the same positions through the same matrix and differ in what they
  // attach to them.
  struct CameraPass {
    std::string_view name;
    const PipelineState& state;
    VertexArrays arrays;  // positions and indices are filled in where they are empty
    std::span<const TextureUnit> units{};
    std::span<const std::uint32_t> scene_triangles{};  // numbers of the triangles drawn; empty: all
  };
  Status draw_camera_pass(CameraPass pass, RenderTarget& target);
  Status draw_camera_together(PassTimes& times);
  Status draw_depth();
  Status draw_comparison();
  Status draw_lit();
  Status draw_shadow();
  [[nodiscard]] VertexArrays all_triangles(std::span<const glm::vec3> positions) const;

  void assign_indices();
  void make_map();
  void add_layers(RenderTarget& target);
  void name_polygons(ComparisonLayers& layers) const;
  [[nodiscard]] bool faces_light(const glm::uvec3& triangle) const;

  // A share of the scene's triangles with their index colours.
  struct TriangleSet {
    std::vector<glm::uvec3> triangles;
    std::vector<ColorBytes> index_colors;
    std::vector<std::uint32_t> numbers;  // in the scene
  };
  void split_by_facing(TriangleSet& compared, TriangleSet& averted) const;

  const Scene* scene_;
  RenderSettings settings_;
  IndexCubePasses passes_;
  Rendering rendering_;
  std::vector<ColorBytes> index_colors_;
  VertexShading shading_;
  glm::mat4 camera_projection_{1.0F};
  std::array<glm::mat4, 6> face_projections_{};
  std::vector<glm::vec3> from_light_;  // positions relative to the light, of the frame being drawn
  std::array<std::vector<std::uint32_t>, 6> map_depth_;
  Texture map_;                           // views the faces in rendering_
  std::array<PreparedDraw, 6> prepared_;  // one a face; the camera uses the first one's memory again
};

}  // namespace ninebit

// Draws depth cube shadows pass by pass.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "ninebit/raster/prepared_draw.h"
#include "ninebit/shadow/depth_cube.h"
#include "src/frame/camera_frame.h"
#include "src/frame/views.h"

namespace ninebit {

// In the order of CubeFace.

// One scene seen from its camera, lit by its light. The passes are drawn in the order of these functions.
class DepthCubeRenderer {
 public:
  // The scene must outlive the renderer. Reports what render_depth_cube reports.
  [[nodiscard]] static Result<DepthCubeRenderer> make(const Scene& scene, const RenderSettings& settings);

  // Draws distances from the light into one face.
  Status draw_map(std::size_t face);
  Status draw_depth();
  // Marks fragments in this face's direction that lie behind the stored distance; `comparison` is an index into
  // passes().comparisons.
  Status draw_comparison(std::size_t comparison, std::size_t face);
  // The same for all faces at once, with floats.
  Status compare_floats();
  // With light_facing: marks triangles that face away from the light.
  Status draw_averted();
  Status draw_lit_and_shadow() { return frame_.draw_lit_and_shadow(); }
  // With settings.evidence: records the triangles in the map and those that the pixels looked up.
  Status add_evidence();
  // Counts pixels, completes layers, maps, pictures and facts.
  void finish();

  [[nodiscard]] const DepthCubePasses& passes() const { return passes_; }
  [[nodiscard]] Rendering& rendering() { return frame_.rendering(); }

 private:
  DepthCubeRenderer(CameraFrame frame, DepthCubePasses passes);

  [[nodiscard]] bool uses_floats() const { return settings().depth_cube.bits == DepthCubeBits::real; }
  [[nodiscard]] const RenderSettings& settings() const { return frame_.settings(); }
  // Whether the face of each pixel's fragment is needed.
  [[nodiscard]] bool needs_directions() const;
  [[nodiscard]] std::size_t face_at(std::size_t pixel) const;
  [[nodiscard]] std::size_t texel_at(std::size_t pixel) const;
  [[nodiscard]] Texture map_of_face(std::size_t face) const;
  void make_ramps();
  void set_ramp_coordinates(std::size_t face);
  Status draw_directions();
  void keep_layers_of_face(std::size_t face, std::size_t first, std::size_t count);
  void keep_maps();
  void add_picture();
  void add_facts();

  CameraFrame frame_;
  DepthCubePasses passes_;
  DepthRange range_;
  std::array<glm::mat4, 6> face_projections_;
  DistanceCode code_{};  // for 8 and 16 bits
  float bias_ = 0.0F;    // for floats, in world units
  Texture map_ramp_, camera_ramp_;
  std::vector<glm::vec3> from_light_;        // positions relative to the light
  std::vector<glm::vec4> from_light_four_;   // the same as an attribute; empty unless needs_directions()
  std::vector<glm::vec3> ramp_coordinates_;  // for the face being drawn
  struct Face {
    std::vector<std::uint8_t> luminance, alpha;
    std::vector<float> distance;
  };
  std::array<Face, 6> faces_;
  std::vector<std::uint8_t> blank_;  // a face that holds the farthest code
  std::vector<std::uint32_t> map_depth_;
  PreparedDraw prepared_map_, prepared_camera_;
  std::array<std::vector<float>, 3> directions_;  // from the light to each pixel's fragment
};

}  // namespace ninebit

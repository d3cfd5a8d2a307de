// Projections: the camera's, and the six of a cube map around the light.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "ninebit/raster/surface.h"
#include "ninebit/raster/texture.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

// Distances along a view axis between which the whole scene lies.
struct DepthRange {
  float near_plane;
  float far_plane;
};

// The range for a view from `eye` that sees points up to `cos_corner` away from its axis (cosine of the angle between
// axis and the picture's corner). The near plane is as far away as the nearest triangle allows, and at least at far /
// 65,536.
[[nodiscard]] DepthRange depth_range(const Scene& scene, const glm::vec3& eye, float cos_corner);

// World space to clip space of a camera, with window y up.
[[nodiscard]] glm::mat4 camera_projection(const Scene& scene, const Camera& camera, float aspect_ratio);

// The same without a far plane: a point of homogeneous coordinate w = 0 has exactly the window depth 1, because clip z
// and clip w of a direction are the same sum.
[[nodiscard]] glm::mat4 infinite_camera_projection(const Scene& scene, const Camera& camera, float aspect_ratio);

// The matrix times a power of two, which moves no position in the window, if the format is a W buffer's: the largest w
// of these positions is in the upper half of what the buffer holds.
[[nodiscard]] glm::mat4 scaled_to_w_buffer(const glm::mat4& projection, std::span<const glm::vec3> positions,
                                           DepthStencilFormat format);

// World space to clip space of a spot or directional light's map: the square pyramid of the spot's opening angle, which
// is everything that the light illuminates, or a parallel beam around the whole scene.
[[nodiscard]] glm::mat4 light_projection(const Scene& scene, const Light& light);

// Clip space of one cube-map face, from positions relative to the cube's middle: window x follows the face's s, window
// y its t.
[[nodiscard]] glm::mat4 cube_face_projection(CubeFace face, const DepthRange& range);

// The same for all faces, in the order of CubeFace.
[[nodiscard]] std::array<glm::mat4, 6> cube_face_projections(const DepthRange& range);

// The cosine of the angle between a cube face's axis and its corner.
inline constexpr float kCubeCornerCosine = 0.57735026F;

// The light's view of a scene: positions in its shadow map.

// The map's resolution at a point: world units per texel across the light's axis, and per step of the depth codes along
// it.
struct MapResolution {
  double texel_size;
  double depth_step;
};

// A spot or directional light's beam.
class LightBeam {
 public:
  // The scene has triangles.
  LightBeam(const Scene& scene, const Light& light);

  // World space to the map's clip space.
  [[nodiscard]] const glm::mat4& projection() const { return projection_; }

  // One entry per position: (s, t, r) and q of the map, where inside the beam s/q, t/q and r/q are from 0 to 1 and q is
  // positive; and a direction whose major axis is +z only inside the beam.
  struct Coordinates {
    std::vector<glm::vec3> str;
    std::vector<float> q;
    std::vector<glm::vec3> direction;
  };
  [[nodiscard]] Coordinates coordinates(std::span<const glm::vec3> positions) const;

  // At the middle of the scene's bounding box, or on the near plane if the middle lies in front of it.
  [[nodiscard]] MapResolution resolution(int map_size, std::uint32_t depth_codes) const;

  // Whether a triangle's front faces the light.
  [[nodiscard]] bool lights_front(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) const;

 private:
  Light light_;
  glm::mat4 projection_;
  glm::vec3 middle_;
};

}  // namespace ninebit

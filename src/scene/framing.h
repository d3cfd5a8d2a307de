// The default camera, light and floor of a scene.
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

// The length that all distances are relative to. A scene that is almost a single point needs some length, too, which
// must not be lost in the rounding of its coordinates.
[[nodiscard]] float scale_of(const Bounds& bounds);

// A three-quarter view from the front, the right and above. It is as near as all vertices of the triangles fit into
// both angles of view, with some margin.
[[nodiscard]] Camera framing_camera(const Scene& scene, const Bounds& bounds, float fov_degrees, float aspect_ratio);

// Above the box and outside it, to the left of the camera and a little toward it: the shadow falls to the right, in
// view.
[[nodiscard]] Light framing_light(const Bounds& bounds, const Camera& camera);

// The extent of a floor: x and z in world space.
struct FloorReach {
  glm::vec2 low{0.0F}, high{0.0F};
};

// A floor that fills the lower part of the framing camera's picture and reaches 1.5 diagonals around the box, and no
// farther than 6.
[[nodiscard]] FloorReach floor_reach(const Bounds& bounds, const Camera& framing, float aspect_ratio, float height);

// Aims a spot light at what the camera sees of the scene, and opens its pyramid as far as it takes to hold that: at
// most 150 degrees. Leaves a light as it is that sees nothing of it.
void fit_spot(const Scene& scene, const Camera& camera, float aspect_ratio, Light& light);

// The cameras and lights of a file, before they are added to its scene.

struct Viewpoints {
  std::vector<Camera> cameras;  // perspective ones only
  std::vector<Light> lights;    // directions not yet of unit length
};

// Adds the cameras and lights to a scene, which has its triangles: transformed by `place`, with unit directions and
// colours whose largest channel is 1. Returns a fault for values that are not finite and for missing directions.
[[nodiscard]] std::optional<Diagnostic> add_viewpoints(const Viewpoints& viewpoints, const glm::dmat4& place,
                                                       Scene& scene);

// Moves the cameras' look-at points along their axes to beside the scene's middle, for files that only give a
// direction.
void move_look_at_points(Scene& scene);

}  // namespace ninebit

#include "src/scene/framing.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

constexpr double kMinExtent = 1e-12;  // a smaller scene counts as a point: its squares would vanish in floats
constexpr double kMargin = 1.12;      // of the picture to the model
constexpr double kWidestFit = 150.0;  // degrees

// A camera's axes and the tangents of half its angles of view.
struct Frame {
  glm::dvec3 position, right, up, back;
  double tan_x = 0.0, tan_y = 0.0;
};

// `back` points from what the camera looks at to the camera, at any distance.
Frame frame_of(const Camera& camera, const glm::dvec3& back, float aspect_ratio) {
  Frame out;
  out.position = glm::dvec3(camera.position);
  out.back = glm::normalize(back);
  out.right = glm::normalize(glm::cross(glm::dvec3(camera.up), out.back));
  out.up = glm::cross(out.back, out.right);
  out.tan_y = std::tan(glm::radians(static_cast<double>(camera.vertical_fov_degrees)) * 0.5);
  out.tan_x = out.tan_y * static_cast<double>(aspect_ratio);
  return out;
}

Frame frame_of(const Camera& camera, float aspect_ratio) {
  return frame_of(camera, glm::dvec3(camera.position) - glm::dvec3(camera.look_at), aspect_ratio);
}

// Adds the part of a polygon for which `side` of its corners is not negative.
template <class Side>
void clip(std::vector<glm::dvec3>& polygon, std::vector<glm::dvec3>& out, const Side& side) {
  out.clear();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const glm::dvec3& a = polygon[i];
    const glm::dvec3& b = polygon[(i + 1) % polygon.size()];
    const double from = side(a), to = side(b);
    if (from >= 0.0) out.push_back(a);
    if ((from < 0.0) != (to < 0.0)) out.push_back(a + (b - a) * (from / (from - to)));
  }
  polygon.swap(out);
}

// The part of the triangle inside the camera's pyramid: corners as right, up and ahead of the camera.
void clip_to_view(const Frame& frame, std::vector<glm::dvec3>& polygon, std::vector<glm::dvec3>& spare) {
  clip(polygon, spare, [&](const glm::dvec3& p) { return p.z * frame.tan_x - p.x; });
  clip(polygon, spare, [&](const glm::dvec3& p) { return p.z * frame.tan_x + p.x; });
  clip(polygon, spare, [&](const glm::dvec3& p) { return p.z * frame.tan_y - p.y; });
  clip(polygon, spare, [&](const glm::dvec3& p) { return p.z * frame.tan_y + p.y; });
}

// The corners of all parts of triangles inside the camera's pyramid, hidden ones as well, in world space. A vertex
// inside comes once, however many triangles share it.
std::vector<glm::dvec3> seen_corners(const Scene& scene, const Frame& frame) {
  const auto in_view = [&](std::uint32_t vertex) {
    const glm::dvec3 at = glm::dvec3(scene.positions[vertex]) - frame.position;
    return glm::dvec3(glm::dot(at, frame.right), glm::dot(at, frame.up), -glm::dot(at, frame.back));
  };
  const auto inside = [&](const glm::dvec3& p) {
    return std::abs(p.x) <= p.z * frame.tan_x && std::abs(p.y) <= p.z * frame.tan_y;
  };
  std::vector<bool> added(scene.positions.size(), false);
  std::vector<glm::dvec3> corners, polygon, spare;
  for (const glm::uvec3& t : scene.triangles) {
    polygon.assign({in_view(t.x), in_view(t.y), in_view(t.z)});
    if (std::all_of(polygon.begin(), polygon.end(), inside)) {
      for (int k = 0; k < 3; ++k) {
        if (!added[t[k]]) corners.emplace_back(scene.positions[t[k]]);
        added[t[k]] = true;
      }
      continue;
    }
    clip_to_view(frame, polygon, spare);
    for (const glm::dvec3& p : polygon) {
      corners.push_back(frame.position + p.x * frame.right + p.y * frame.up + p.z * -frame.back);
    }
  }
  return corners;
}

double diagonal_of(const Bounds& bounds) {
  return glm::length(glm::dvec3(bounds.high) - glm::dvec3(bounds.low));
}

bool has_extent(const Bounds& bounds) {
  return diagonal_of(bounds) >= kMinExtent;
}

}  // namespace

float scale_of(const Bounds& bounds) {
  if (has_extent(bounds)) return static_cast<float>(diagonal_of(bounds));
  return std::max(1.0F, 1e-3F * glm::length(bounds.center()));
}

Camera framing_camera(const Scene& scene, const Bounds& bounds, float fov_degrees, float aspect_ratio) {
  Camera camera;
  camera.vertical_fov_degrees = fov_degrees;
  const Frame frame = frame_of(camera, glm::dvec3(0.62, 0.92, 1.0), aspect_ratio);
  const double tan_x = frame.tan_x / kMargin, tan_y = frame.tan_y / kMargin;
  // A vertex at (x, y, z), seen from the middle and z toward the eye, lies left of the picture's right side if
  // x + tan_x z <= eye.x + tan_x eye.z, and so on. The largest left sides decide.
  const double scale = static_cast<double>(scale_of(bounds));
  constexpr double kLow = std::numeric_limits<double>::lowest();
  double right = kLow, left = kLow, top = kLow, bottom = kLow, nearest = kLow;
  for (const glm::uvec3& t : scene.triangles) {
    for (int k = 0; k < 3; ++k) {
      const glm::dvec3 at = glm::dvec3(scene.positions[t[k]]) - glm::dvec3(bounds.center());
      const double x = glm::dot(at, frame.right), y = glm::dot(at, frame.up), z = glm::dot(at, frame.back);
      right = std::max(right, x + tan_x * z);
      left = std::max(left, tan_x * z - x);
      top = std::max(top, y + tan_y * z);
      bottom = std::max(bottom, tan_y * z - y);
      nearest = std::max(nearest, z);
    }
  }
  const double distance = std::max({(right + left) / (2.0 * tan_x), (top + bottom) / (2.0 * tan_y),
                                    nearest + (has_extent(bounds) ? 0.05 : 2.0) * scale});
  const glm::dvec3 middle =
      glm::dvec3(bounds.center()) + frame.right * ((right - left) * 0.5) + frame.up * ((top - bottom) * 0.5);
  camera.look_at = glm::vec3(middle);
  camera.position = glm::vec3(middle + frame.back * distance);
  return camera;
}

Light framing_light(const Bounds& bounds, const Camera& camera) {
  glm::vec3 toward_eye = camera.position - camera.look_at;
  toward_eye.y = 0.0F;
  const float length = glm::length(toward_eye);
  toward_eye = length > 0.0F && std::isfinite(length) ? toward_eye / length : glm::vec3(0.0F, 0.0F, 1.0F);
  const glm::vec3 right = glm::cross(glm::vec3(0.0F, 1.0F, 0.0F), toward_eye);
  const glm::vec3 direction = glm::normalize(glm::vec3(0.0F, 1.0F, 0.0F) - 0.55F * right + 0.35F * toward_eye);
  return {.name = "light", .position = bounds.center() + direction * (1.3F * scale_of(bounds))};
}

FloorReach floor_reach(const Bounds& bounds, const Camera& framing, float aspect_ratio, float height) {
  const double scale = static_cast<double>(scale_of(bounds));
  const glm::dvec2 center(bounds.center().x, bounds.center().z);
  glm::dvec2 low = center - 1.5 * scale, high = center + 1.5 * scale;
  const Frame frame = frame_of(framing, aspect_ratio);
  const double above = frame.position.y - static_cast<double>(height);
  for (const glm::dvec2& corner : {glm::dvec2(-1, -1), glm::dvec2(1, -1), glm::dvec2(-1, 1), glm::dvec2(1, 1)}) {
    const glm::dvec3 ray = frame.right * (corner.x * frame.tan_x) + frame.up * (corner.y * frame.tan_y) - frame.back;
    // A ray that does not come down leaves the floor at its farthest.
    const double along = ray.y < 0.0 && above > 0.0 ? -above / ray.y : 100.0 * scale;
    const glm::dvec2 at = glm::dvec2(frame.position.x, frame.position.z) + glm::dvec2(ray.x, ray.z) * along;
    low = glm::min(low, at);
    high = glm::max(high, at);
  }
  return {glm::vec2(glm::max(low, center - 6.0 * scale)), glm::vec2(glm::min(high, center + 6.0 * scale))};
}

void fit_spot(const Scene& scene, const Camera& camera, float aspect_ratio, Light& light) {
  const std::vector<glm::dvec3> corners = seen_corners(scene, frame_of(camera, aspect_ratio));
  std::vector<glm::dvec3> directions;
  glm::dvec3 sum(0.0);
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 to = corner - glm::dvec3(light.position);
    const double length = glm::length(to);
    if (!(length > 0.0) || !std::isfinite(length)) continue;
    directions.push_back(to / length);
    sum += directions.back();
  }
  if (!(glm::length(sum) > 1e-6)) return;
  // Badoiu and Clarkson: steps towards the farthest direction, each shorter than the one before.
  glm::dvec3 axis = glm::normalize(sum);
  for (int step = 1; step <= 64; ++step) {
    const auto farthest = std::min_element(directions.begin(), directions.end(), [&](const auto& a, const auto& b) {
      return glm::dot(a, axis) < glm::dot(b, axis);
    });
    const glm::dvec3 next = axis + (*farthest - axis) / static_cast<double>(step + 1);
    if (!(glm::length(next) > 1e-6)) break;
    axis = glm::normalize(next);
  }
  double smallest = 1.0;
  for (const glm::dvec3& direction : directions) smallest = std::min(smallest, glm::dot(direction, axis));
  // The cone inside the pyramid: whichever way the map is turned, it holds the cone.
  const double degrees = glm::degrees(2.0 * std::acos(std::clamp(smallest, -1.0, 1.0))) + 1.0;
  light.direction = glm::vec3(axis);
  light.spot_degrees = static_cast<float>(std::clamp(degrees, 1.0, kWidestFit));
}

namespace {

glm::vec3 moved(const glm::dmat4& by, const glm::vec3& point) {
  return glm::vec3(glm::dvec3(by * glm::dvec4(glm::dvec3(point), 1.0)));
}

// Moves the look-at point along the view axis to beside the scene's middle, which is what the camera seems to look at.
// If the middle is behind the camera, any distance will do.
void move_look_at(Camera& camera, const Bounds& bounds) {
  const glm::dvec3 position(camera.position);
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(camera.look_at) - position);
  const double diagonal = static_cast<double>(bounds.diagonal());
  double distance = glm::dot(glm::dvec3(bounds.center()) - position, ahead);
  if (distance < 1e-3 * diagonal) distance = diagonal > 0.0 ? diagonal : 1.0;
  const glm::vec3 on_axis(position + ahead * distance);
  if (is_finite(on_axis)) camera.look_at = on_axis;
}

}  // namespace

std::optional<Diagnostic> add_viewpoints(const Viewpoints& viewpoints, const glm::dmat4& place, Scene& scene) {
  for (Camera camera : viewpoints.cameras) {
    camera.position = moved(place, camera.position);
    camera.look_at = moved(place, camera.look_at);
    camera.up = glm::vec3(glm::dmat3(place) * glm::dvec3(camera.up));
    if (!is_finite(camera.position) || !is_finite(camera.look_at) || !is_finite(camera.up))
      return fault_of("a camera's position or direction is not finite");
    if (camera.look_at == camera.position) return fault_of("a camera has no view direction");
    scene.cameras.push_back(camera);
  }
  for (Light light : viewpoints.lights) {
    light.position = moved(place, light.position);
    if (!is_finite(light.position)) return fault_of("a light's position is not finite");
    if (light.kind != LightKind::point) {
      const glm::dvec3 direction = glm::dmat3(place) * glm::dvec3(light.direction);
      const double length = glm::length(direction);
      if (!(length > 0.0) || !std::isfinite(length)) return fault_of("a spot or directional light has no direction");
      light.direction = glm::vec3(direction / length);
    }
    const glm::vec3 color = is_finite(light.color) ? glm::max(light.color, 0.0F) : glm::vec3(1.0F);
    const float largest = std::max({color.r, color.g, color.b});
    light.color = largest > 0.0F ? glm::min(color / largest, 1.0F) : glm::vec3(0.0F);
    scene.lights.push_back(light);
  }
  return std::nullopt;
}

void move_look_at_points(Scene& scene) {
  const Bounds bounds = bounds_of(scene);
  for (Camera& camera : scene.cameras) move_look_at(camera, bounds);
}

}  // namespace ninebit

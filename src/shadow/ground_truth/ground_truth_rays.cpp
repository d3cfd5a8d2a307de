#include "src/shadow/ground_truth/ground_truth_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>
#include <limits>
#include <utility>

#include "src/shadow/ground_truth/box_tree.h"

namespace ninebit {

bool CandidateTest::take(std::uint32_t triangle) {
  if (triangle == own_) return false;
  const auto at = crossing(ray_, corners_of(*rays_.scene, triangle), rays_.touching);
  if (!at) return false;
  if (all_ == nullptr) return true;
  all_->push_back({triangle, *at});
  return false;
}

GroundTruthScene::Rays::Rays(const Scene& judged, std::unique_ptr<BoxSearch> search)
    : scene(&judged), touching(touching_distance(judged)), boxes(std::move(search)) {}

bool GroundTruthScene::Rays::blocked(const LightRay& ray, std::uint32_t own) const {
  if (glm::dot(ray.way, ray.way) == 0.0) return false;  // at the light
  CandidateTest test(*this, ray, own, nullptr);
  return boxes->search(ray, test);
}

void GroundTruthScene::Rays::find_all(const LightRay& ray, std::uint32_t own, std::vector<RayCrossing>& crossed) const {
  crossed.clear();
  if (glm::dot(ray.way, ray.way) == 0.0) return;
  CandidateTest test(*this, ray, own, &crossed);
  static_cast<void>(boxes->search(ray, test));
  const auto by_number = [](const RayCrossing& l, const RayCrossing& r) { return l.triangle < r.triangle; };
  std::sort(crossed.begin(), crossed.end(), by_number);
}

TriangleBox box_of(const Scene& scene, std::uint32_t triangle, double margin) {
  const glm::uvec3& t = scene.triangles[triangle];
  const auto& p = scene.positions;
  const glm::vec3 wider(static_cast<float>(margin));
  return {glm::min(glm::min(p[t.x], p[t.y]), p[t.z]) - wider, glm::max(glm::max(p[t.x], p[t.y]), p[t.z]) + wider};
}

Status check_judged(const Scene& scene) {
  if (Status valid = validate(scene); !valid) return valid;
  if (scene.cameras.size() == 1 && scene.lights.size() == 1) return {};
  return Diagnostic{.message = fmt::format("the scene has {} cameras and {} lights; expected one of each",
                                           scene.cameras.size(), scene.lights.size())};
}

GroundTruthScene::GroundTruthScene(std::unique_ptr<Rays> rays) : rays_(std::move(rays)) {}
GroundTruthScene::~GroundTruthScene() = default;
GroundTruthScene::GroundTruthScene(GroundTruthScene&& other) noexcept = default;
GroundTruthScene& GroundTruthScene::operator=(GroundTruthScene&& other) noexcept = default;

Result<GroundTruthScene> GroundTruthScene::make_portable(const Scene& scene) {
  if (Status good = check_judged(scene); !good) return good.error();
  return GroundTruthScene(std::make_unique<Rays>(scene, std::make_unique<BoxTree>(scene)));
}

namespace {

using glm::cross;
using glm::dot;
using glm::dvec3;

// The same as touching_distance, for directions of unit length.
constexpr double kTouching = 0x1p-22;

// Six times the signed volumes between a line through the origin and the edges of a triangle seen from there: all of
// one sign if the line passes through the triangle. Two triangles compute exactly opposite values for a common edge, so
// no line slips through between them.
struct EdgeVolumes {
  EdgeVolumes(const dvec3& way, const dvec3& a, const dvec3& b, const dvec3& c)
      : at_a(dot(cross(b, c), way)), at_b(dot(cross(c, a), way)), at_c(dot(cross(a, b), way)) {}
  [[nodiscard]] bool inside() const {
    return (at_a >= 0.0 && at_b >= 0.0 && at_c >= 0.0) || (at_a <= 0.0 && at_b <= 0.0 && at_c <= 0.0);
  }
  [[nodiscard]] double sum() const { return at_a + at_b + at_c; }
  double at_a, at_b, at_c;
};

}  // namespace

PixelRays::PixelRays(const Camera& camera, int width, int height)
    : eye_(camera.position), forward_(glm::normalize(dvec3(camera.look_at) - eye_)), width_(width), height_(height) {
  const double half_height = std::tan(static_cast<double>(camera.vertical_fov_degrees) * (glm::pi<double>() / 360.0));
  const dvec3 right = glm::normalize(cross(forward_, dvec3(camera.up)));
  across_ = right * (half_height * width / height);
  up_ = cross(right, forward_) * half_height;
}

dvec3 PixelRays::point_on(const Corners& triangle, int x, int y) const {
  const dvec3 way = forward_ + across_ * ((2.0 * x + 1.0) / width_ - 1.0) + up_ * ((2.0 * y + 1.0) / height_ - 1.0);
  const dvec3 a = triangle.a - eye_, b = triangle.b - eye_, c = triangle.c - eye_;
  const EdgeVolumes volumes(way, a, b, c);
  if (volumes.inside() && volumes.sum() != 0.0) {
    return eye_ + (a * volumes.at_a + b * volumes.at_b + c * volumes.at_c) / volumes.sum();
  }
  // Seen along the ray, edges are segments in a plane, and the ray is its origin.
  const auto along = [&](const dvec3& v) { return v - way * (dot(v, way) / dot(way, way)); };
  dvec3 nearest = a;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [from, to] : {std::array{a, b}, std::array{b, c}, std::array{c, a}}) {
    const dvec3 start = along(from), edge = along(to) - start;
    const double length = dot(edge, edge);
    const double t = length > 0.0 ? std::clamp(-dot(start, edge) / length, 0.0, 1.0) : 0.0;
    const dvec3 offset = start + edge * t;
    if (dot(offset, offset) < least) {
      least = dot(offset, offset);
      nearest = from + (to - from) * t;
    }
  }
  return eye_ + nearest;
}

LightRay light_ray(const Light& light, const dvec3& from) {
  if (light.kind == LightKind::directional) return {from, glm::normalize(-dvec3(light.direction)), true};
  return {from, dvec3(light.position) - from, false};
}

std::optional<double> crossing(const LightRay& ray, const Corners& triangle, double touching) {
  const dvec3 normal = cross(triangle.b - triangle.a, triangle.c - triangle.a);
  const double length = std::sqrt(dot(normal, normal));
  if (length == 0.0) return std::nullopt;
  const dvec3 a = triangle.a - ray.from;
  const double above = -dot(normal, a) / length;  // of the ray's origin over the plane
  const double change = dot(normal, ray.way) / length;
  if (std::fabs(above) <= touching) return std::nullopt;
  if (ray.endless) {
    if (std::fabs(change) <= kTouching || (above > 0.0) == (change > 0.0)) return std::nullopt;
  } else {
    const double end = above + change;
    if (std::fabs(end) <= touching || (above > 0.0) == (end > 0.0)) return std::nullopt;
  }
  if (!EdgeVolumes(ray.way, a, triangle.b - ray.from, triangle.c - ray.from).inside()) return std::nullopt;
  return -above / change;
}

double touching_distance(const Scene& scene) {
  const Bounds bounds = bounds_of(scene);
  const glm::vec3 largest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  return kTouching * static_cast<double>(std::max({largest.x, largest.y, largest.z}));
}

bool in_spot(const glm::dmat4& light_projection, const dvec3& point) {
  const glm::dvec4 clip = light_projection * glm::dvec4(point, 1.0);
  return clip.w > 0.0 && std::fabs(clip.x) <= clip.w && std::fabs(clip.y) <= clip.w;
}

bool are_neighbours(const Scene& scene, std::uint32_t first, std::uint32_t second) {
  if (first == second || scene.triangle_object[first] != scene.triangle_object[second]) return false;
  for (int i = 0; i < 3; ++i) {
    for (int k = 0; k < 3; ++k) {
      if (scene.positions[scene.triangles[first][i]] == scene.positions[scene.triangles[second][k]]) return true;
    }
  }
  return false;
}

}  // namespace ninebit

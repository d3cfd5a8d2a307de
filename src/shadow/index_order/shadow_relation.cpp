#include "src/shadow/index_order/shadow_relation.h"

#include <algorithm>
#include <cstdint>
#include <utility>

namespace ninebit {

namespace {

// Pairs of a plane and a corner that are compared for one pair of patches at most.
constexpr std::size_t kMostComparisons = std::size_t{1} << 20;

}  // namespace

bool ShadowRelation::may_shadow(std::uint32_t a, std::uint32_t b) {
  if (a > b) std::swap(a, b);
  const auto [entry, is_new] = known_.try_emplace((std::uint64_t{a} << 32) | b, false);
  if (is_new) entry->second = decide(a, b);
  return entry->second;
}

bool ShadowRelation::decide(std::uint32_t a, std::uint32_t b) const {
  const std::size_t most = std::max(patches_.planes(a).size() * patches_.places(b).size(),
                                    patches_.planes(b).size() * patches_.places(a).size());
  if (most > kMostComparisons) return true;
  return occludes(a, b) || occludes(b, a);
}

bool ShadowRelation::reaches(std::uint32_t patch, std::uint32_t other, double side) const {
  const glm::dvec3& middle = patches_.middle(patch);
  const glm::dvec3& half = patches_.half_size(patch);
  for (const std::uint32_t plane : patches_.planes(other)) {
    const glm::dvec3 normal = surface_.normal(plane) * side;
    const double offset = surface_.offset(plane) * side + relief_;
    // The box around the patch decides most planes.
    if (glm::dot(normal, middle) + glm::dot(glm::abs(normal), half) <= offset) continue;
    for (const std::uint32_t place : patches_.places(patch)) {
      if (glm::dot(normal, surface_.position(place)) > offset) return true;
    }
  }
  return false;
}

namespace {

// Whether an edge of a polygon is shared by exactly one other polygon, which runs along it in the other direction.
bool is_closed(const SceneSurface& surface, std::uint32_t polygon, std::size_t edge) {
  const std::uint32_t from = surface.corners(polygon)[edge], to = surface.corners(polygon)[(edge + 1) % 3];
  int others = 0, opposite = 0;
  surface.across_edge(polygon, edge, [&](std::uint32_t other) {
    const SceneSurface::Corners& c = surface.corners(other);
    ++others;
    for (std::size_t i = 0; i < 3; ++i) opposite += c[i] == to && c[(i + 1) % 3] == from ? 1 : 0;
  });
  return others == 1 && opposite == 1;
}

bool hides_backs(const Scene& scene, const SceneObject& object, const SceneSurface& surface) {
  double length = 0.0, open = 0.0, volume = 0.0;
  const glm::dvec3 origin = object.triangle_count > 0 ? surface.centroid(object.first_triangle) : glm::dvec3(0.0);
  for (std::uint32_t t = object.first_triangle; t < object.first_triangle + object.triangle_count; ++t) {
    if (surface.twice_area(t) <= 0.0) continue;
    const SceneSurface::Corners& c = surface.corners(t);
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const double own = glm::length(surface.position(c[(edge + 1) % 3]) - surface.position(c[edge]));
      length += own;
      if (!is_closed(surface, t, edge)) open += own;
    }
    volume += glm::dot(surface.position(c[0]) - origin, surface.normal(t)) * surface.twice_area(t);
  }
  if (open > kMostOpen * length || volume == 0.0) return false;
  return volume > 0.0 || winding_number(scene, object, scene.lights[0].position) <= kInsideRoom;
}

}  // namespace

std::vector<bool> find_hidden_backs(const Scene& scene, const SceneSurface& surface) {
  std::vector<bool> hidden;
  for (const SceneObject& object : scene.objects) hidden.push_back(hides_backs(scene, object, surface));
  return hidden;
}

}  // namespace ninebit

#include "src/shadow/index_order/hidden_backs.h"

#include <cstdint>

namespace ninebit {
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

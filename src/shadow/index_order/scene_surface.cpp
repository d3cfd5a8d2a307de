#include "src/shadow/index_order/scene_surface.h"

#include <numeric>

#include "src/frame/surface_groups.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

SceneSurface::SceneSurface(const Scene& scene) {
  const std::size_t count = scene.triangles.size();
  const WeldedVertices welded = weld_vertices(scene.triangles, scene.positions);
  const std::vector<unsigned int>& place = welded.of_vertex;
  const std::size_t places = welded.places;
  position_.resize(places);
  for (std::size_t v = 0; v < place.size(); ++v) {
    if (place[v] < places) position_[place[v]] = scene.positions[v];
  }
  corners_.resize(count);
  normal_.resize(count);
  offset_.resize(count);
  twice_area_.resize(count);
  first_at_.assign(places + 1, 0);
  for (std::size_t t = 0; t < count; ++t) {
    const glm::uvec3& v = scene.triangles[t];
    corners_[t] = {place[v.x], place[v.y], place[v.z]};
    for (const std::uint32_t p : corners_[t]) ++first_at_[p + 1];
    const glm::dvec3 a = position_[corners_[t][0]];
    const glm::dvec3 across = glm::cross(position_[corners_[t][1]] - a, position_[corners_[t][2]] - a);
    twice_area_[t] = glm::length(across);
    normal_[t] = twice_area_[t] > 0.0 ? across / twice_area_[t] : glm::dvec3(0.0);
    offset_[t] = glm::dot(normal_[t], a);
  }
  std::partial_sum(first_at_.begin(), first_at_.end(), first_at_.begin());
  at_place_.resize(count * 3);
  std::vector<std::uint32_t> next(first_at_.begin(), first_at_.end() - 1);
  for (std::uint32_t t = 0; t < count; ++t) {
    for (const std::uint32_t p : corners_[t]) at_place_[next[p]++] = t;
  }
  diagonal_ = static_cast<double>(bounds_of(scene).diagonal());
  find_neighbours();
}

void SceneSurface::find_neighbours() {
  across_.assign(corners_.size() * 3, kNoPolygon);
  parallel_for(corners_.size(), 4096, [this](std::size_t polygon) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      std::uint32_t& across = across_[polygon * 3 + edge];
      search_edge(static_cast<std::uint32_t>(polygon), edge,
                  [&](std::uint32_t other) { across = across == kNoPolygon ? other : kSeveral; });
    }
  });
}

}  // namespace ninebit

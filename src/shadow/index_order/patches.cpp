#include "src/shadow/index_order/patches.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <queue>
#include <utility>

#include "src/frame/surface_groups.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

constexpr std::uint32_t kNoPatch = ~0U;

// Planes are one plane if their normals agree to this cosine and their distance is below this part of the diagonal.
constexpr double kSameNormal = 1.0 - 1e-9;
constexpr double kSameDistance = 1e-6;
// A polygon is compared with so many of the patch's latest planes. More would find a few planes that were met before.
constexpr std::size_t kLatestPlanes = 4;

}  // namespace

class Patches::Grower {
 public:
  Grower(const SceneSurface& surface, std::span<const std::uint32_t> object_of_polygon, double degrees, Patches& out)
      : surface_(surface),
        object_(object_of_polygon),
        out_(out),
        least_cosine_(std::cos(degrees * std::numbers::pi / 180.0)),
        relief_(kPatchRelief * surface.diagonal()),
        listed_in_(surface.places(), kNoPatch) {
    out_.of_polygon_.assign(surface.polygons(), kNoPatch);
  }

  void grow_all() {
    std::vector<std::uint32_t> order(surface_.polygons());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [this](std::uint32_t a, std::uint32_t b) {
      return surface_.twice_area(a) > surface_.twice_area(b);
    });
    for (const std::uint32_t seed : order) {
      if (out_.of_polygon_[seed] == kNoPatch) grow(seed);
    }
  }

 private:
  // Nearest first; of equally near polygons the one with the lower number.
  struct Candidate {
    double distance;
    std::uint32_t polygon;
    bool operator<(const Candidate& o) const {
      return distance > o.distance || (distance == o.distance && polygon > o.polygon);
    }
  };

  void grow(std::uint32_t seed) {
    patch_ = out_.count();
    seed_ = seed;
    polygons_.clear();
    planes_.clear();
    places_.clear();
    candidates_ = {};
    add(seed, true);
    while (!candidates_.empty() && planes_.size() < kMaxPatchPlanes) {
      const std::uint32_t polygon = candidates_.top().polygon;
      candidates_.pop();
      if (out_.of_polygon_[polygon] == kNoPatch && fits(polygon)) add(polygon, is_new_plane(polygon));
    }
    out_.planes_.numbers.insert(out_.planes_.numbers.end(), planes_.begin(), planes_.end());
    out_.places_.numbers.insert(out_.places_.numbers.end(), places_.begin(), places_.end());
    out_.finish_patch(surface_, polygons_);
  }

  void add(std::uint32_t polygon, bool new_plane) {
    out_.of_polygon_[polygon] = patch_;
    polygons_.push_back(polygon);
    if (new_plane) planes_.push_back(polygon);
    for (const std::uint32_t place : surface_.corners(polygon)) {
      if (listed_in_[place] == patch_) continue;
      listed_in_[place] = patch_;
      places_.push_back(place);
    }
    const glm::dvec3 from = surface_.centroid(seed_);
    for (std::size_t edge = 0; edge < 3; ++edge) {
      surface_.across_edge(polygon, edge, [&](std::uint32_t other) {
        if (out_.of_polygon_[other] != kNoPatch || object_[other] != object_[seed_]) return;
        candidates_.push({glm::length(surface_.centroid(other) - from), other});
      });
    }
  }

  [[nodiscard]] bool fits(std::uint32_t polygon) const {
    if (surface_.twice_area(polygon) <= 0.0) return true;
    const bool turns = glm::dot(surface_.normal(polygon), surface_.normal(seed_)) < least_cosine_;
    if (turns && surface_.twice_area(seed_) > 0.0) return false;
    for (const std::uint32_t place : surface_.corners(polygon)) {
      if (listed_in_[place] == patch_) continue;
      for (const std::uint32_t plane : planes_) {
        if (surface_.height(place, plane) > relief_) return false;
      }
    }
    if (!is_new_plane(polygon)) return true;
    return std::none_of(places_.begin(), places_.end(),
                        [&](std::uint32_t place) { return surface_.height(place, polygon) > relief_; });
  }

  [[nodiscard]] bool is_new_plane(std::uint32_t polygon) const {
    if (surface_.twice_area(polygon) <= 0.0) return false;
    const std::size_t latest = std::min(planes_.size(), kLatestPlanes);
    return std::none_of(planes_.end() - static_cast<std::ptrdiff_t>(latest), planes_.end(), [&](std::uint32_t plane) {
      return glm::dot(surface_.normal(plane), surface_.normal(polygon)) > kSameNormal &&
             std::abs(surface_.height(surface_.corners(polygon)[0], plane)) < kSameDistance * surface_.diagonal();
    });
  }

  const SceneSurface& surface_;
  std::span<const std::uint32_t> object_;
  Patches& out_;
  double least_cosine_, relief_;
  std::vector<std::uint32_t> listed_in_;  // by place: the patch that listed it last
  std::uint32_t patch_ = 0, seed_ = 0;
  std::vector<std::uint32_t> polygons_, planes_, places_;
  std::priority_queue<Candidate> candidates_;
};

Patches Patches::grow(const SceneSurface& surface, std::span<const std::uint32_t> object_of_polygon, double degrees) {
  Patches patches;
  Grower(surface, object_of_polygon, degrees, patches).grow_all();
  return patches;
}

Patches Patches::of_units(const SceneSurface& surface, std::span<const std::uint32_t> unit_of_polygon,
                          std::uint32_t units) {
  Patches patches;
  patches.of_polygon_.assign(unit_of_polygon.begin(), unit_of_polygon.end());
  std::vector<std::vector<std::uint32_t>> polygons(units);
  for (std::uint32_t t = 0; t < surface.polygons(); ++t) polygons[unit_of_polygon[t]].push_back(t);
  for (const std::vector<std::uint32_t>& own : polygons) {
    std::vector<std::uint32_t> places;
    for (const std::uint32_t polygon : own) {
      if (surface.twice_area(polygon) > 0.0) patches.planes_.numbers.push_back(polygon);
      places.insert(places.end(), surface.corners(polygon).begin(), surface.corners(polygon).end());
    }
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    patches.places_.numbers.insert(patches.places_.numbers.end(), places.begin(), places.end());
    patches.finish_patch(surface, own);
  }
  return patches;
}

void Patches::finish_patch(const SceneSurface& surface, std::span<const std::uint32_t> polygons) {
  planes_.end_list();
  places_.end_list();
  if (polygons.empty()) {  // an object without triangles
    for (auto* list : {&center_, &middle_, &half_size_}) list->emplace_back(0.0);
    return;
  }
  glm::dvec3 sum(0.0);
  double weight = 0.0;
  for (const std::uint32_t polygon : polygons) {
    const double own = std::max(surface.twice_area(polygon), 1e-300);
    sum += surface.centroid(polygon) * own;
    weight += own;
  }
  center_.push_back(sum / weight);
  const auto own_places = places_.of(count() - 1);
  glm::dvec3 low = surface.position(own_places[0]), high = low;
  for (const std::uint32_t place : own_places) {
    low = glm::min(low, surface.position(place));
    high = glm::max(high, surface.position(place));
  }
  middle_.push_back((low + high) * 0.5);
  half_size_.push_back((high - low) * 0.5);
}

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

#include "src/scene/files/polygon.h"

#include <cmath>
#include <optional>

namespace ninebit {
namespace {

// Twice the signed area of a triangle in the plane of projection.
double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

// Projects along the largest axis of the polygon's normal, so that its winding becomes counter-clockwise.
std::vector<glm::dvec2> project(std::span<const glm::vec3> corners) {
  glm::dvec3 normal(0.0);
  const glm::dvec3 origin(corners[0]);
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    normal += glm::cross(glm::dvec3(corners[i]) - origin, glm::dvec3(corners[i + 1]) - origin);
  const glm::dvec3 size = glm::abs(normal);
  const glm::length_t drop = size.x > size.y && size.x > size.z ? 0 : (size.y > size.z ? 1 : 2);
  const glm::length_t u = (drop + 1) % 3;
  const glm::length_t v = (drop + 2) % 3;
  const double turn = normal[drop] < 0.0 ? -1.0 : 1.0;
  std::vector<glm::dvec2> flat;
  flat.reserve(corners.size());
  for (const glm::vec3& corner : corners) {
    const glm::dvec3 relative = glm::dvec3(corner) - origin;
    flat.emplace_back(relative[u], relative[v] * turn);
  }
  return flat;
}

// Whether the fan's triangles all have areas of the same sign.
bool fan_is_valid(const std::vector<glm::dvec2>& flat) {
  for (std::size_t i = 1; i + 1 < flat.size(); ++i) {
    if (area2(flat[0], flat[i], flat[i + 1]) < 0.0) return false;
  }
  return true;
}

// Finds ears of a polygon. A corner that is not an ear cannot become one as long as it has the same neighbours and the
// corner in its triangle is still there, so it is tested again only after one of these changes.
class EarSearch {
 public:
  explicit EarSearch(const std::vector<glm::dvec2>& flat) : flat_(flat), refusals_(flat.size()), gone_(flat.size()) {}

  // Whether the corner left[at] is an ear.
  bool is_ear(const std::vector<std::uint32_t>& left, std::size_t at) {
    const std::size_t count = left.size();
    const std::uint32_t before = left[(at + count - 1) % count];
    const std::uint32_t after = left[(at + 1) % count];
    Refusal& refusal = refusals_[left[at]];
    if (refusal.known && refusal.before == before && refusal.after == after && !gone_[refusal.witness]) return false;
    const std::optional<std::uint32_t> witness = in_the_way(left, at);
    if (witness) refusal = {true, before, after, *witness};
    return !witness;
  }

  void remove(std::uint32_t corner) { gone_[corner] = true; }

 private:
  struct Refusal {
    bool known = false;
    std::uint32_t before = 0, after = 0;  // its neighbours when it was tested
    std::uint32_t witness = 0;            // the reason: a corner within its triangle, or itself
  };

  // The reason why a corner is not an ear: a corner within its triangle, or itself if the triangle has no area.
  [[nodiscard]] std::optional<std::uint32_t> in_the_way(const std::vector<std::uint32_t>& left, std::size_t at) const {
    const std::size_t count = left.size();
    const glm::dvec2& a = flat_[left[(at + count - 1) % count]];
    const glm::dvec2& b = flat_[left[at]];
    const glm::dvec2& c = flat_[left[(at + 1) % count]];
    if (area2(a, b, c) <= 0.0) return left[at];
    const glm::dvec2 low = glm::min(glm::min(a, b), c);
    const glm::dvec2 high = glm::max(glm::max(a, b), c);
    for (const std::uint32_t corner : left) {
      const glm::dvec2& p = flat_[corner];
      if (p.x < low.x || p.x > high.x || p.y < low.y || p.y > high.y) continue;
      if (p == a || p == b || p == c) continue;
      if (area2(a, b, p) >= 0.0 && area2(b, c, p) >= 0.0 && area2(c, a, p) >= 0.0) return corner;
    }
    return std::nullopt;
  }

  const std::vector<glm::dvec2>& flat_;
  std::vector<Refusal> refusals_;
  std::vector<bool> gone_;
};

// Cuts ears until three corners are left, or none of them is an ear.
void cut_ears(const std::vector<glm::dvec2>& flat, std::vector<std::uint32_t>& left,
              std::vector<std::array<std::uint32_t, 3>>& triangles) {
  EarSearch ears(flat);
  // The search continues from the last ear instead of the start: a typical polygon then needs one pass of tests per
  // ear.
  std::size_t at = 1;
  std::size_t refused = 0;
  while (left.size() > 3 && refused < left.size()) {
    at %= left.size();
    if (!ears.is_ear(left, at)) {
      ++at;
      ++refused;
      continue;
    }
    const std::size_t size = left.size();
    triangles.push_back({left[(at + size - 1) % size], left[at], left[(at + 1) % size]});
    ears.remove(left[at]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
    refused = 0;
  }
}

}  // namespace

bool triangulate(std::span<const glm::vec3> corners, std::vector<std::array<std::uint32_t, 3>>& triangles,
                 std::uint64_t* effort) {
  const auto count = static_cast<std::uint32_t>(corners.size());
  std::vector<std::uint32_t> left(count);
  for (std::uint32_t i = 0; i < count; ++i) left[i] = i;
  if (count > 3) {
    const std::vector<glm::dvec2> flat = project(corners);
    if (!fan_is_valid(flat)) {
      if (count > kMostConcaveCorners) return false;
      if (effort != nullptr && count > kSmallPolygon) *effort += std::uint64_t{count} * count;
      cut_ears(flat, left, triangles);
    }
  }
  for (std::size_t i = 1; i + 1 < left.size(); ++i) triangles.push_back({left[0], left[i], left[i + 1]});
  return true;
}

}  // namespace ninebit

#include "src/shadow/index_order/borders.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

namespace ninebit {
namespace {

// A place where two patches meet.
struct PatchContact {
  std::uint32_t a = 0, b = 0;  // a < b
  double length = 0.0;         // of the shared edge; a corner has none
  double fold = -1.0;          // the sine of the angle by which one rises in front of the other; below 0: it falls

  [[nodiscard]] bool same_pair(const PatchContact& o) const { return a == o.a && b == o.b; }
  bool operator<(const PatchContact& o) const { return a < o.a || (a == o.a && b < o.b); }
};

class ContactFinder {
 public:
  ContactFinder(const SceneSurface& surface, const Patches& patches)
      : surface_(surface), patches_(patches), shared_(surface.places()) {}

  // One entry for each pair of patches that meet, sorted.
  std::vector<PatchContact> find() {
    for (std::uint32_t place = 0; place < surface_.places(); ++place) {
      const auto polygons = surface_.polygons_at(place);
      shared_[place] = std::any_of(polygons.begin(), polygons.end(), [&](std::uint32_t polygon) {
        return patches_.of_polygon(polygon) != patches_.of_polygon(polygons[0]);
      });
      if (shared_[place] && polygons.size() <= SceneSurface::kMaxValence) add_corner(place);
    }
    for (std::uint32_t polygon = 0; polygon < surface_.polygons(); ++polygon) add_edges(polygon);
    std::stable_sort(contacts_.begin(), contacts_.end());
    std::vector<PatchContact> merged;
    for (const PatchContact& m : contacts_) {
      if (merged.empty() || !merged.back().same_pair(m)) {
        merged.push_back(m);
      } else {
        merged.back().length += m.length;
        merged.back().fold = std::max(merged.back().fold, m.fold);
      }
    }
    return merged;
  }

 private:
  void add(std::uint32_t a, std::uint32_t b, double length, double fold) {
    contacts_.push_back({std::min(a, b), std::max(a, b), length, fold});
  }

  // How steeply `polygon` rises from a place in front of the plane of `base`.
  [[nodiscard]] double rise(std::uint32_t base, std::uint32_t polygon, std::uint32_t place) const {
    double steepest = -1.0;
    for (const std::uint32_t corner : surface_.corners(polygon)) {
      const glm::dvec3 way = surface_.position(corner) - surface_.position(place);
      const double length = glm::length(way);
      if (length > 0.0) steepest = std::max(steepest, glm::dot(surface_.normal(base), way) / length);
    }
    return steepest;
  }
  [[nodiscard]] double fold(std::uint32_t p, std::uint32_t q, std::uint32_t place) const {
    return std::max(rise(p, q, place), rise(q, p, place));
  }

  void add_corner(std::uint32_t place) {
    const auto polygons = surface_.polygons_at(place);
    const std::size_t before = contacts_.size();
    for (std::size_t i = 0; i < polygons.size(); ++i) {
      for (std::size_t j = 0; j < i; ++j) {
        const std::uint32_t a = patches_.of_polygon(polygons[i]), b = patches_.of_polygon(polygons[j]);
        if (a == b) continue;
        const PatchContact m{std::min(a, b), std::max(a, b), 0.0, fold(polygons[i], polygons[j], place)};
        const auto known = std::find_if(contacts_.begin() + static_cast<std::ptrdiff_t>(before), contacts_.end(),
                                        [&](const PatchContact& o) { return o.same_pair(m); });
        if (known == contacts_.end()) {
          contacts_.push_back(m);
        } else {
          known->fold = std::max(known->fold, m.fold);
        }
      }
    }
  }

  void add_edges(std::uint32_t polygon) {
    for (std::size_t edge = 0; edge < 3; ++edge) {
      const std::uint32_t from = surface_.corners(polygon)[edge], to = surface_.corners(polygon)[(edge + 1) % 3];
      if (!shared_[from] || !shared_[to]) continue;
      surface_.across_edge(polygon, edge, [&](std::uint32_t other) {
        const std::uint32_t a = patches_.of_polygon(polygon), b = patches_.of_polygon(other);
        if (other < polygon || a == b) return;
        add(a, b, glm::length(surface_.position(to) - surface_.position(from)), fold(polygon, other, from));
      });
    }
  }

  const SceneSurface& surface_;
  const Patches& patches_;
  std::vector<bool> shared_;  // places with polygons of several patches
  std::vector<PatchContact> contacts_;
};

}  // namespace

Borders Borders::find(const SceneSurface& surface, const Patches& patches, ShadowRelation& relation, double degrees) {
  std::vector<PatchContact> contacts = ContactFinder(surface, patches).find();
  const double gentle = std::sin(degrees * std::numbers::pi / 180.0);
  std::erase_if(contacts, [&](const PatchContact& m) { return m.fold > gentle && relation.may_shadow(m.a, m.b); });

  Borders borders;
  borders.first_.assign(patches.count() + std::size_t{1}, 0);
  for (const PatchContact& m : contacts) {
    ++borders.first_[m.a + 1];
    ++borders.first_[m.b + 1];
  }
  std::partial_sum(borders.first_.begin(), borders.first_.end(), borders.first_.begin());
  borders.borders_.resize(borders.first_.back());
  std::vector<std::size_t> next(borders.first_.begin(), borders.first_.end() - 1);
  const double corner = kCornerLength * surface.diagonal();
  // In this order each list comes out sorted: first the smaller neighbours, then the larger ones.
  for (const PatchContact& m : contacts) {
    borders.borders_[next[m.b]++] = {m.a, static_cast<float>(m.length + corner)};
  }
  for (const PatchContact& m : contacts) {
    borders.borders_[next[m.a]++] = {m.b, static_cast<float>(m.length + corner)};
  }
  return borders;
}

bool Borders::are_neighbours(std::uint32_t a, std::uint32_t b) const {
  const auto list = of(a);
  const auto found = std::lower_bound(list.begin(), list.end(), b,
                                      [](const Border& border, std::uint32_t patch) { return border.patch < patch; });
  return found != list.end() && found->patch == b;
}

}  // namespace ninebit

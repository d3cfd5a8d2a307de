// Patches: polygons of an object that share a code.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <utility>
#include <vector>

#include "ninebit/scene/scene.h"

namespace ninebit {

// The polygons of a scene as one surface: which of them meet, and the planes that they lie in.

// Vertices at the same position are one place. Doubles, computed from the scene's floats in a fixed order.
class SceneSurface {
 public:
  // The scene is valid.
  explicit SceneSurface(const Scene& scene);

  using Corners = std::array<std::uint32_t, 3>;
  [[nodiscard]] std::size_t polygons() const { return corners_.size(); }
  [[nodiscard]] std::size_t places() const { return position_.size(); }
  [[nodiscard]] const Corners& corners(std::uint32_t polygon) const { return corners_[polygon]; }
  [[nodiscard]] const glm::dvec3& position(std::uint32_t place) const { return position_[place]; }
  // The polygons with a corner at a place.
  [[nodiscard]] std::span<const std::uint32_t> polygons_at(std::uint32_t place) const {
    return std::span(at_place_).subspan(first_at_[place], first_at_[place + 1] - first_at_[place]);
  }
  // The unit normal; 0 for a polygon without area.
  [[nodiscard]] const glm::dvec3& normal(std::uint32_t polygon) const { return normal_[polygon]; }
  [[nodiscard]] double twice_area(std::uint32_t polygon) const { return twice_area_[polygon]; }
  [[nodiscard]] glm::dvec3 centroid(std::uint32_t polygon) const {
    const Corners& c = corners_[polygon];
    return (position_[c[0]] + position_[c[1]] + position_[c[2]]) / 3.0;
  }
  // How far a place lies in front of a polygon's plane; negative: behind it.
  [[nodiscard]] double height(std::uint32_t place, std::uint32_t polygon) const {
    return glm::dot(normal_[polygon], position_[place]) - offset_[polygon];
  }
  // n · x = offset is a polygon's plane.
  [[nodiscard]] double offset(std::uint32_t polygon) const { return offset_[polygon]; }
  // The diagonal of the box around all polygons.
  [[nodiscard]] double diagonal() const { return diagonal_; }

  // Calls each(polygon) for the other polygons that have both ends of an edge as corners. An edge between two places
  // with more than kMaxValence polygons each is left out, because a search there would take quadratic time.
  template <class Each>
  void across_edge(std::uint32_t polygon, std::size_t edge, const Each& each) const {
    const std::uint32_t known = across_[polygon * std::size_t{3} + edge];
    if (known == kNoPolygon) return;
    if (known != kSeveral) return each(known);
    search_edge(polygon, edge, each);
  }
  static constexpr std::size_t kMaxValence = 64;

 private:
  static constexpr std::uint32_t kNoPolygon = ~0U, kSeveral = ~1U;

  template <class Each>
  void search_edge(std::uint32_t polygon, std::size_t edge, const Each& each) const {
    std::uint32_t from = corners_[polygon][edge], to = corners_[polygon][(edge + 1) % 3];
    if (polygons_at(to).size() < polygons_at(from).size()) std::swap(from, to);
    if (polygons_at(from).size() > kMaxValence) return;
    for (const std::uint32_t other : polygons_at(from)) {
      const Corners& c = corners_[other];
      if (other != polygon && (c[0] == to || c[1] == to || c[2] == to)) each(other);
    }
  }
  void find_neighbours();

  std::vector<Corners> corners_;
  std::vector<std::uint32_t> across_;  // three per polygon: the only other polygon at an edge
  std::vector<glm::dvec3> position_;
  std::vector<glm::dvec3> normal_;
  std::vector<double> offset_, twice_area_;
  std::vector<std::uint32_t> first_at_, at_place_;
  double diagonal_ = 0.0;
};

// How far a patch's polygons may rise in front of one another's planes, as a part of the scene's diagonal: within a
// patch no shadow can be drawn. At 2048 texels across the scene this is one texel.
inline constexpr double kPatchRelief = 1.0 / 2048.0;
// A patch with more planes than this grows no further.
inline constexpr std::size_t kMaxPatchPlanes = 512;

class Patches {
 public:
  // Grows patches from polygon to polygon across shared edges, from the largest polygon on: within an object, while
  // normals differ by at most `degrees` from the first polygon's and nothing rises above kPatchRelief. Polygons without
  // area join any patch.
  [[nodiscard]] static Patches grow(const SceneSurface& surface, std::span<const std::uint32_t> object_of_polygon,
                                    double degrees);
  // One patch for each unit; units are numbered from 0 without gaps.
  [[nodiscard]] static Patches of_units(const SceneSurface& surface, std::span<const std::uint32_t> unit_of_polygon,
                                        std::uint32_t units);

  [[nodiscard]] std::uint32_t count() const { return static_cast<std::uint32_t>(center_.size()); }
  [[nodiscard]] std::uint32_t of_polygon(std::uint32_t polygon) const { return of_polygon_[polygon]; }
  // Polygons in whose planes all of the patch lies; polygons in the plane of another are left out.
  [[nodiscard]] std::span<const std::uint32_t> planes(std::uint32_t patch) const { return planes_.of(patch); }
  // The places of the polygons' corners.
  [[nodiscard]] std::span<const std::uint32_t> places(std::uint32_t patch) const { return places_.of(patch); }
  // The mean of the polygons' centroids, weighted by area.
  [[nodiscard]] const glm::dvec3& center(std::uint32_t patch) const { return center_[patch]; }
  // Half the size of the box around the patch, and the box's middle.
  [[nodiscard]] const glm::dvec3& half_size(std::uint32_t patch) const { return half_size_[patch]; }
  [[nodiscard]] const glm::dvec3& middle(std::uint32_t patch) const { return middle_[patch]; }

 private:
  class Grower;

  // Lists of numbers, one per patch.
  struct Lists {
    std::vector<std::uint32_t> first{0}, numbers;
    [[nodiscard]] std::span<const std::uint32_t> of(std::uint32_t i) const {
      return std::span(numbers).subspan(first[i], first[i + 1] - first[i]);
    }
    void end_list() { first.push_back(static_cast<std::uint32_t>(numbers.size())); }
  };

  // Completes a patch whose polygons, planes and places are listed.
  void finish_patch(const SceneSurface& surface, std::span<const std::uint32_t> polygons);

  std::vector<std::uint32_t> of_polygon_;
  Lists planes_, places_;
  std::vector<glm::dvec3> center_, half_size_, middle_;
};

}  // namespace ninebit

// Patches: polygons of an object that share a code.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "src/shadow/index_order/scene_surface.h"

namespace ninebit {

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

// The neighbours of each patch: patches that meet it and should compare equal.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/shadow/index_order/lost_differences.h"
#include "src/shadow/index_order/patches.h"

namespace ninebit {

struct Border {
  std::uint32_t patch = 0;  // the neighbour
  float length = 0.0F;      // what a broken border costs: the length of the shared edges, in world units
};

class Borders {
 public:
  // Two patches that share a corner are neighbours if the surface bends inward by at most `degrees` between them, or if
  // they cannot shadow one another. A corner without a shared edge counts as kCornerLength. Corners with more than
  // SceneSurface::kMaxValence polygons join only patches that share an edge there.
  [[nodiscard]] static Borders find(const SceneSurface& surface, const Patches& patches, ShadowRelation& relation,
                                    double degrees);

  // Sorted by patch.
  [[nodiscard]] std::span<const Border> of(std::uint32_t patch) const {
    return std::span(borders_).subspan(first_[patch], first_[patch + 1] - first_[patch]);
  }
  [[nodiscard]] bool are_neighbours(std::uint32_t a, std::uint32_t b) const;
  [[nodiscard]] std::uint64_t count() const { return borders_.size() / 2; }  // pairs of neighbours

 private:
  std::vector<std::size_t> first_;
  std::vector<Border> borders_;
};

// As a part of the scene's diagonal.
inline constexpr double kCornerLength = 1e-4;

}  // namespace ninebit

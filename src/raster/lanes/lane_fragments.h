// Fragments of one tile, gathered until there are enough for one run of the combiners.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/combiner/evaluate.h"
#include "src/raster/lanes/tile_planes.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// A batch of fragments, no two of which share a pixel.
struct LaneFragments {
  static constexpr std::size_t kSlack = 64;  // vectors are stored whole beyond the last fragment
  static constexpr std::size_t kRoom = kBatchSize + kSlack;
  template <class T>
  using Lanes = std::array<T, kRoom>;

  // Fragments of one primitive, from `first` on.
  struct Run {
    const SetupPrimitive* primitive = nullptr;
    const SetupCorners* corners = nullptr;
    const glm::mat3* weights = nullptr;  // see SetupBlock::weights_of
    std::size_t first = 0;

    // True if the run's weights, edge functions of at most 2^37 times 1/w, are 0 or so far from the ends of the float
    // range that no step of a quotient by their sum overflows or underflows.
    [[nodiscard]] bool is_plain() const {
      constexpr float kLeast = 0x1p-40F, kMost = 0x1p40F;
      return weights == nullptr && std::all_of(corners->inv_w.begin(), corners->inv_w.end(),
                                               [](float inv_w) { return inv_w >= kLeast && inv_w <= kMost; });
    }
  };

  // Fragments side by side in a row of the tile.
  struct Span {
    std::uint16_t place;  // of the first one's pixel in TilePlanes
    std::uint8_t count;
    std::uint16_t first;  // fragment
  };

  std::size_t count = 0;
  std::size_t runs = 0;
  std::size_t spans = 0;
  bool has_shares = false;                         // true if `weight` holds shares
  bool has_one_change = false;                     // true if their changes are the same for all fragments
  std::array<Span, kBatchSize> span;               // all fragments, in their order
  std::array<Run, kBatchSize + 1> run;             // and one more, whose `first` is `count`
  alignas(64) Lanes<std::uint32_t> place;          // of the pixel in TilePlanes
  alignas(64) Lanes<std::uint32_t> depth;          // codes
  alignas(64) std::array<Lanes<float>, 3> weight;  // of the vertices: first edge function / w, later their shares
  alignas(64) Lanes<std::uint32_t> coverage;       // of smoothed polygons and lines: coverage_byte

  // True if all runs are plain.
  [[nodiscard]] bool are_plain() const {
    return std::all_of(run.data(), run.data() + runs, [](const Run& r) { return r.is_plain(); });
  }
  void clear() {
    count = runs = spans = 0;
    has_shares = has_one_change = false;
  }
};

}  // namespace ninebit

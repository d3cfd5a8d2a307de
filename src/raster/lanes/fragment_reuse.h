// The reuse of fragments between the passes of a tile.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "src/raster/lanes/lane_fragments.h"
#include "src/raster/lanes/lane_pass.h"
#include "src/raster/surface/tile_size.h"

namespace ninebit {

// The policy, in the order of the passes over the same primitives: sets their roles and which of them note owners.
//
// - Where several passes follow one another that can_reuse, the first keeps its fragments and the others repeat them.
// - A pass that draws the nearest depth alone notes owners if the next one can_reuse.
void plan_reuse(std::span<LanePass> passes);

// The batches of fragments of one tile: the one that is being gathered, and those that are kept for later passes.
//
// Why reuse gives the same pixels: all passes draw the same primitives, so they generate the same fragments. Passes
// that can_reuse (LaneOperations::asks_equal_depth) draw those of equal depth and write no depth, and nothing that such
// a pass draws changes the outcome of a depth or stencil test within it. So the fragments that pass the depth test are
// the same in all of these passes. The stencil test may differ between them: the pass that keeps fragments gathers them
// whatever the stencil value, and each pass tests the stencil when it draws them. Batches are drawn in the order in
// which they were gathered, so fragments of one pixel keep their order, and the interpolated weights are those of the
// primitive, whatever the pass. A tile with more fragments than kMostKept batches hold repeats nothing: later passes
// gather again.
class FragmentReuse {
 public:
  static constexpr std::size_t kMostKept = 64;

  // Starts a pass: drops what is kept unless the pass repeats it.
  void begin_pass(FragmentRole role);

  // True if a pass of this role draws from kept(): it does not gather fragments.
  [[nodiscard]] bool repeats(FragmentRole role) const { return role == FragmentRole::repeats && has_kept_all_; }
  [[nodiscard]] std::span<const std::unique_ptr<LaneFragments>> kept() const { return {batches_.data(), kept_}; }

  // The batch that is being gathered.
  [[nodiscard]] LaneFragments& gathering() const { return *gathering_; }

  // A bit for each pixel of a row: whether one of them has a fragment in the batch; gives them one.
  [[nodiscard]] bool overlaps(std::size_t row, std::uint64_t bits) const { return (occupied_[row] & bits) != 0; }
  void occupy(std::size_t row, std::uint64_t bits) { occupied_[row] |= bits; }

  // Starts the next batch. `keeps`: the last one stays, if there is room for it; else it may be replaced.
  void begin_batch(bool keeps);

 private:
  std::vector<std::unique_ptr<LaneFragments>> batches_;
  std::size_t kept_ = 0;       // the first of the batches
  bool has_kept_all_ = false;  // false if there were too many
  LaneFragments* gathering_ = nullptr;
  std::array<std::uint64_t, kTileSize + 3> occupied_{};
};

}  // namespace ninebit

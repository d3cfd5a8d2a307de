// The primitives that left the depths of a tile.
#pragma once

#include <cstdint>

#include "src/raster/lanes/tile_planes.h"

namespace ninebit {

// Primitives have the numbers 0, 1, … in the order in which they are drawn in the tile, the same in every pass.
//
// A pass with LanePass::notes_owners keeps the nearest fragments and stores their primitives' numbers. As long as no
// depth changes after it, the fragments of equal depth in later passes are exactly the owners' fragments, so those
// passes compare numbers instead of computing depths. This holds unless a fragment ties with the stored depth: then
// more than one primitive has a fragment of equal depth, or the depth was there before, and the owners are no longer
// known. Single pixels are an exception: later passes compare their depths, so one that ties leaves the owners known.
struct PixelOwners {
  static constexpr std::uint32_t kNone = 0xFFFFFFFF;

  bool are_known = false;
  std::uint32_t next_number = 0;   // of the primitives that are drawn next
  alignas(64) TileWords number{};  // of the primitive that left each depth, or kNone

  // `writes_depth`: the pass writes depths. `notes`: it stores their owners.
  void begin_pass(bool writes_depth, bool notes) {
    next_number = 0;
    if (writes_depth) are_known = notes;
    if (notes) number.fill(kNone);
  }
};

}  // namespace ninebit

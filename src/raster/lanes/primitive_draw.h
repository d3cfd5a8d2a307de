// The state that all fragments of one primitive in a tile share.
#pragma once

#include <cstdint>

#include "src/raster/lanes/lane_pass.h"
#include "src/raster/lanes/tile_lanes.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// The ways of drawing a triangle's fragments.
enum class Drawing {
  nearest,  // LanePass::draws_nearest_alone
  noted,    // the same, and notes_owners
  flat,     // one colour, through the fragment operations
  gathers   // into the batch
};

constexpr bool is_nearest(Drawing drawing) {
  return drawing == Drawing::nearest || drawing == Drawing::noted;
}

struct PrimitiveDraw {
  LaneTile& tile;
  const LanePass& pass;
  const SetupPrimitive& primitive;
  const SetupBlock& block;
  const SetupCorners* corners;  // null for a flat result
  std::uint32_t color;          // of a flat result, as it is stored
  std::uint32_t number;         // see PixelOwners

  // Of a flat result: the whole alpha, which tests read.
  [[nodiscard]] std::uint32_t alpha() const {
    return pass.operations.store.is_exact ? color >> 24 : pass.context.flat_primary(primitive.primitive)[3];
  }
};

}  // namespace ninebit

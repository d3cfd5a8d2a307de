// Rows of a target's planes that a tile is read from and written to.
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/raster/surface.h"

namespace ninebit {

// A row of samples in each of the target's planes, with the distance to the next row.
struct TileRow {
  Plane<std::uint32_t> depth;
  Plane<std::uint8_t> stencil;
  std::array<Plane<std::uint8_t>, 4> color;

  void move_up() {
    depth.data += depth.stride;
    stencil.data += stencil.stride;
    for (Plane<std::uint8_t>& plane : color) plane.data += plane.stride;
  }
};

}  // namespace ninebit

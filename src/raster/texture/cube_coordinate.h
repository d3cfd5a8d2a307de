// cube_coordinate, where the samplers' loops can have it inline.
#pragma once

#include "ninebit/raster/texture.h"
#include "src/raster/rules/one_fragment.h"

namespace ninebit {

inline CubeCoordinate cube_coordinate_inline(float rx, float ry, float rz) {
  const auto place = one_fragment::cube_place(one_fragment::Numbers(), rx, ry, rz);
  return {static_cast<CubeFace>(place.face), place.s, place.t};
}

}  // namespace ninebit

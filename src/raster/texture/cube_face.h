// The major-axis table of ARB_texture_cube_map, where the samplers' loops can have it inline.
#pragma once

#include <cmath>

#include "ninebit/raster/texture.h"

namespace ninebit {

// A direction seen from its face; `ma` is not negative.
struct CubeProjection {
  CubeFace face = CubeFace::positive_x;
  float sc = 0.0F;
  float tc = 0.0F;
  float ma = 0.0F;
};

// Of a direction without NaN.
inline CubeProjection project_onto_cube(float rx, float ry, float rz) {
  const float ax = std::fabs(rx), ay = std::fabs(ry), az = std::fabs(rz);
  if (ay > ax || az > ax) {
    if (az > ay) {
      return rz >= 0.0F ? CubeProjection{CubeFace::positive_z, rx, -ry, az}
                        : CubeProjection{CubeFace::negative_z, -rx, -ry, az};
    }
    return ry >= 0.0F ? CubeProjection{CubeFace::positive_y, rx, rz, ay}
                      : CubeProjection{CubeFace::negative_y, rx, -rz, ay};
  }
  return rx >= 0.0F ? CubeProjection{CubeFace::positive_x, -rz, -ry, ax}
                    : CubeProjection{CubeFace::negative_x, rz, -ry, ax};
}

inline CubeCoordinate cube_coordinate_inline(float rx, float ry, float rz) {
  if (std::isnan(rx) || std::isnan(ry) || std::isnan(rz)) return {CubeFace::positive_x, 0.0F, 0.0F};
  const CubeProjection p = project_onto_cube(rx, ry, rz);
  if (p.ma == 0.0F) return {};
  const float s = (p.sc / p.ma + 1.0F) * 0.5F;
  const float t = (p.tc / p.ma + 1.0F) * 0.5F;
  // Infinity over infinity is NaN, which fails both comparisons.
  return {p.face, s >= 0.0F && s <= 1.0F ? s : 0.0F, t >= 0.0F && t <= 1.0F ? t : 0.0F};
}

}  // namespace ninebit

#include "ninebit/raster/texture.h"

#include <algorithm>
#include <cmath>

namespace ninebit {

const CubeFaceAxes& cube_face_axes(CubeFace face) {
  static constexpr std::array<CubeFaceAxes, 6> axes{{
      {{0, 0, -1}, {0, -1, 0}, {1, 0, 0}},
      {{0, 0, 1}, {0, -1, 0}, {-1, 0, 0}},
      {{1, 0, 0}, {0, 0, 1}, {0, 1, 0}},
      {{1, 0, 0}, {0, 0, -1}, {0, -1, 0}},
      {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}},
      {{-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
  }};
  return axes[static_cast<std::size_t>(face)];
}

CubeCoordinate cube_coordinate(float rx, float ry, float rz) {
  if (std::isnan(rx) || std::isnan(ry) || std::isnan(rz)) return {CubeFace::positive_x, 0.0F, 0.0F};
  const float ax = std::fabs(rx), ay = std::fabs(ry), az = std::fabs(rz);
  CubeFace face;
  float sc, tc, ma;
  if (ay > ax || az > ax) {
    if (az > ay) {
      face = rz >= 0.0F ? CubeFace::positive_z : CubeFace::negative_z;
      sc = rz >= 0.0F ? rx : -rx;
      tc = -ry;
      ma = az;
    } else {
      face = ry >= 0.0F ? CubeFace::positive_y : CubeFace::negative_y;
      sc = rx;
      tc = ry >= 0.0F ? rz : -rz;
      ma = ay;
    }
  } else {
    face = rx >= 0.0F ? CubeFace::positive_x : CubeFace::negative_x;
    sc = rx >= 0.0F ? -rz : rz;
    tc = -ry;
    ma = ax;
  }
  if (ma == 0.0F) return {};
  const float s = (sc / ma + 1.0F) * 0.5F;
  const float t = (tc / ma + 1.0F) * 0.5F;
  // Infinite components divide to NaN, which fails both comparisons.
  return {face, s >= 0.0F && s <= 1.0F ? s : 0.0F, t >= 0.0F && t <= 1.0F ? t : 0.0F};
}

CubeMap::Texel CubeMap::nearest(float rx, float ry, float rz) const {
  const CubeCoordinate c = cube_coordinate(rx, ry, rz);
  const auto n = static_cast<float>(size);
  return {c.face, std::min(static_cast<int>(c.s * n), size - 1), std::min(static_cast<int>(c.t * n), size - 1)};
}

}  // namespace ninebit

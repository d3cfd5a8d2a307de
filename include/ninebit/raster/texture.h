// Textures as the combiners' registers see them.
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/raster/surface.h"

namespace ninebit {

// The faces in the order of ARB_texture_cube_map.
enum class CubeFace : std::uint8_t { positive_x, negative_x, positive_y, negative_y, positive_z, negative_z };
inline constexpr std::array kCubeFaces{CubeFace::positive_x, CubeFace::negative_x, CubeFace::positive_y,
                                       CubeFace::negative_y, CubeFace::positive_z, CubeFace::negative_z};

// Where a direction meets the cube: the face and the position on it, both in [0, 1].
struct CubeCoordinate {
  CubeFace face = CubeFace::positive_x;
  float s = 0.5F;
  float t = 0.5F;
};

// The major-axis table of ARB_texture_cube_map. The extension leaves ties open; here x wins over y and y over z, and a
// zero counts as positive. The zero direction gives the middle of +X; NaN gives its first texel.
[[nodiscard]] CubeCoordinate cube_coordinate(float rx, float ry, float rz);

// The six axes of a face in the extension's table: s grows along `s`, t along `t`, the face looks along `major`.
struct CubeFaceAxes {
  std::array<int, 3> s;
  std::array<int, 3> t;
  std::array<int, 3> major;
};
[[nodiscard]] const CubeFaceAxes& cube_face_axes(CubeFace face);

// A cube map of RGB bytes, sampled NEAREST; alpha reads 255 (base internal format GL_RGB). Texel (0, 0) is at s = t =
// 0, the first sample of row 0. It views planes that somebody else owns, such as six surfaces that were drawn.
struct CubeMap {
  int size = 0;
  std::array<std::array<Plane<const std::uint8_t>, 3>, 6> faces;

  // The texel that a direction meets: its face and place.
  struct Texel {
    CubeFace face;
    int x;
    int y;
  };
  [[nodiscard]] Texel nearest(float rx, float ry, float rz) const;
};

}  // namespace ninebit

// Cube maps as pictures.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>

#include "ninebit/image/image_io.h"

namespace ninebit {

// Six faces of size × size texels as a cross of 4 × 3 faces: +Y on top, then -X +Z +X -Z, -Y below; texel t = 0 on top
// as the extension's faces have it. `color` returns the colour of a texel, numbered row by row, of a face in the order
// of CubeFace. Faces above 1,024 texels a side show only every second, fourth, … texel.
[[nodiscard]] Image8 cube_cross(
    int size, const std::function<std::array<std::uint8_t, 3>(std::size_t face, std::size_t texel)>& color);

}  // namespace ninebit

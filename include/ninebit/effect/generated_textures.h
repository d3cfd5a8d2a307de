// Textures that programs of the time made for themselves: normalization cube maps, ramps, attenuation, normal maps.
#pragma once

#include <cstdint>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/texture.h"

namespace NINEBIT_PUBLIC ninebit {

// A real number from -1 to 1 as a byte, as GL_EXPAND_NORMAL_NV reads it: 255 (x + 1) / 2, rounded to nearest, halves
// up. NaN becomes 0, and numbers outside of the range are clamped. 0 becomes 128, which is read back as 1/255.
[[nodiscard]] std::uint8_t range_compressed(double x);

// An rgb8 cube map of size × size texels a face. Each texel holds its own direction, normalized and range-compressed:
// whatever vector is looked up, the result has length one. size is a power of two from 1 to kMaxSurfaceSize.
[[nodiscard]] Result<Texture> normalization_cube_map(int size);

// An rgb8 texture of size × size texels: 8 × 8 squares (or size × size, if that is less), white and dark grey (51); the
// one at texel (0, 0) is white. size as above.
[[nodiscard]] Result<Texture> checkerboard(int size);

// A luminance8 texture of 256 × 1 texels; texel i is i.
[[nodiscard]] Result<Texture> gradient();

// A luminance8 texture of 128 × 128 texels: 1 - x² - y², not below 0, at texel centres, with x and y from -1 at s or t
// = 0 to 1 at 1. Twice this texture, for x and y and for z, gives a point light's attenuation.
[[nodiscard]] Result<Texture> attenuation();

// An rgb8 texture of normals, range-compressed, in place of heights. A height is the mean of a texel's stored colours,
// 0 to 1. A normal is (-dh/ds, dh/dt, 1) normalized: y points up in the picture, as in glTF. The slopes come from the
// texels on both sides, which repeat at the borders, times `steepness` (finite, above 0): 1 is a rise of one texel's
// width for a height of 1. Reads level 0. Reports a cube map, a texture of depths or floats, a texture without level 0,
// and a steepness out of range.
[[nodiscard]] Result<Texture> normal_map(const Texture& heights, double steepness);

// The same normals in two's complement, 127 times a component, rounded to nearest, halves up: rgb8, whose red, green
// and blue a sampler has to read as signed.
[[nodiscard]] Result<Texture> signed_normal_map(const Texture& heights, double steepness);

// Their x and y as HI and LO of hilo16 in two's complement, 32767 times a component, rounded likewise.
[[nodiscard]] Result<Texture> hilo_normal_map(const Texture& heights, double steepness);

// The heights as HI of hilo16, 65535 times, rounded likewise; LO is 0. Reports what normal_map() reports of a texture.
[[nodiscard]] Result<Texture> hilo_height_map(const Texture& heights);

// The slopes along s and t, clamped to [-1, 1], as ds and dt of dsdt8: 127 times, rounded likewise.
[[nodiscard]] Result<Texture> offset_map(const Texture& heights, double steepness);

// Level 0 of a 2D texture of bytes as a texture of another kind: as a 1D texture its first row, as a 3D one the squares
// that lie one below the other as layers, as a rectangle all of it. Reports other kinds and formats, and a height that
// is not a multiple of the width.
[[nodiscard]] Result<Texture> retargeted(const Texture& texture, TextureTarget target);

}  // namespace ninebit

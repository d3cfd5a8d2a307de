// The words of a hardware profile's fields and of their evidence. Headers that only pass a profile on include this one:
// a changed field then recompiles fewer files.
#pragma once

#include <cstdint>
#include <string_view>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Every hardware behaviour, a field each: hardware_profile.h.
struct HardwareProfile;

// How well a behaviour is known.
enum class Evidence : std::uint8_t {
  specified,  // the OpenGL extension says so
  seed,       // the article on index cube shadow mapping, tested by its author on a GeForce 2, implies it
  measured,   // read off real hardware (NV2A, the Xbox's GeForce3-class chip)
  inferred,   // follows from a measured rule or from a program that ran on the hardware
  assumed     // nothing decides it
};

// "specified", "seed", "measured", "inferred" or "assumed".
[[nodiscard]] std::string_view name_of(Evidence evidence);

// The numbers that the combiners compute in. With each of them registers start as codes and outputs end as codes.
enum class Arithmetic : std::uint8_t {
  integer,  // codes, as in hardware, by the fields of HardwareProfile
  exact,    // fractions without rounding; converted to a code only for the frame buffer
  float32   // 32-bit floats, as in emulators' shaders; converted to a code only for the frame buffer
};

// How a wide value is narrowed to the bits that a register can hold.
enum class Narrowing : std::uint8_t {
  toward_zero,       // the low bits of the magnitude are dropped
  nearest_halves_up  // to the nearest code, a half upward
};

// The point in a general combiner at which the low bits are dropped.
enum class NarrowingPoint : std::uint8_t {
  after_scale,  // products, sum, bias and scale are computed wide and narrowed once
  before_scale  // the biased sum is narrowed to a whole code, then scaled
};

// The alpha of the secondary colour.
enum class SecondaryAlpha : std::uint8_t { one, as_given };
// The slope of a polygon in its polygon offset (OpenGL 1.3, 3.5.5 allows both).
enum class OffsetSlope : std::uint8_t { larger, root };  // max(|dz/dx|, |dz/dy|), or the root of the sum of squares
// How the fraction of a polygon offset is treated, in steps of a 24-bit depth.
enum class OffsetFraction : std::uint8_t {
  kept,    // the sum of depth and offset is narrowed
  rounded  // the offset is rounded to nearest, halves up, before it is added
};
// How smooth colours are interpolated: perspective-correct like texture coordinates, or linearly in the window.
enum class ColorInterpolation : std::uint8_t { perspective, affine };
// The weights of a primitive's vertices in its smooth colours.
enum class ColorWeights : std::uint8_t {
  exact,      // shares, in floats
  eight_bits  // whole 256ths: the first and the third vertex's cut, the second has the rest
};
// The values that blending reads for the low bits that a surface of fewer bits does not store.
enum class SurfaceBlend : std::uint8_t {
  zeros,  // zeros, of the fragment's colour as well
  bytes   // those of the byte that stands for the stored number; the fragment's colour stays whole
};
// Where linear filters round.
enum class FilterRounding : std::uint8_t {
  once,       // the weighted sum of all texels
  each_blend  // each blend of two: along s, then along t, then between levels
};
// Which pixels a line draws.
enum class LineShape : std::uint8_t {
  diamonds,   // OpenGL 1.3, 3.4: those whose diamonds it leaves, side by side as often as its whole width says
  rectangles  // those whose centres a rectangle around it holds, which is up to 1.118 times too wide
};
// Which pixels a point draws.
enum class PointShape : std::uint8_t {
  whole_pixels,  // OpenGL 1.3, 3.3: a square of whole pixels, moved to whole pixels
  squares        // those whose centres a square around the point's own position holds, with a rule for its edges
};
// How a fog factor, or a texture-shader stage's number, from 0 to 1 becomes a byte.
enum class StageByte : std::uint8_t {
  twelve_bits,  // cut to 12 bits n, then 255 (n + 1) >> 12
  nearest       // times 255, to nearest, halves up
};
// The divisors of a dot product's signed bytes: for the mappings of Direct3D, of OpenGL, and the plain one.
enum class DotDivisors : std::uint8_t {
  odd,  // 127, 255, 127
  even  // 128, 256, 128
};
// Whose mapping the dot product has that DOT_PRODUCT_DIFFUSE_CUBE_MAP reads ahead of its stage.
enum class AheadMapping : std::uint8_t { own, of_diffuse };
// What a texture-shader stage's number below 0 is, before it becomes a byte.
enum class NegativeNumber : std::uint8_t {
  zero,  // 0
  size   // itself without its sign
};
// Which of CULL_FRAGMENT's coordinates count as negative at zero.
enum class CullZero : std::uint8_t {
  none,    // neither 0 nor -0
  by_sign  // -0
};
// How the colours of a DXT1 texture are kept.
enum class Dxt1Palette : std::uint8_t {
  rgb565,      // the palette in 5, 6 and 5 bits, then widened
  rgb888,      // the palette in bytes
  dithered565  // the palette in bytes, dithered to 5, 6 and 5 bits by the texel's place, then widened
};

}  // namespace ninebit

// Pictures whose sides are not powers of two, which textures of the time cannot have.
#pragma once

#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/texture.h"

namespace NINEBIT_PUBLIC ninebit {

// Scales an image of bytes or floats, whose sides are not powers of two, to the next ones. As gluScaleImage with
// GL_LINEAR, but in integers: target sample i of n lies at (2i + 1) source / (2n) - 1/2 of the source, rounded to 1/256
// of a sample, halves up, and clamped to the first and the last sample. Along x, then along y, a byte is
// (a (256 - w) + b w + 128) / 256, rounded down; floats are computed in the same order as a + (b - a) w / 256.
void resample_to_powers_of_two(TextureSamples& image);

}  // namespace ninebit

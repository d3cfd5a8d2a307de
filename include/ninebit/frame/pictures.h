// A rendering as pictures.
#pragma once

#include "ninebit/frame/rendering.h"
#include "ninebit/image/image_io.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A surface's colours, upright: red, green, blue and, of four channels, alpha.
[[nodiscard]] Image8 surface_picture(const Surface& surface, int channels);

// The frame's red, green and blue, upright.
[[nodiscard]] Image8 color_picture(const Rendering& rendering);

// The stencil buffer: white where it is not 0, in shadow.
[[nodiscard]] Image8 stencil_picture(const Rendering& rendering);

// The index cube map as a cross of 4 × 3 faces (+Y on top, then -X +Z +X -Z, -Y below), texel t = 0 on top as the
// extension's faces have it. Neighbouring indices get far-apart hues; the cleared map is black. Faces above 1,024
// texels a side show only every second, fourth, … texel.
[[nodiscard]] Image8 index_cross_picture(const Rendering& rendering);

// A picture whose pixels are the means of n × n pixels, each component by itself: (sum + n² / 2) / n², rounded down.
// The sides must be multiples of n. That GeForce 2's antialiasing rounded to nearest is assumed.
[[nodiscard]] Image8 averaged(const Image8& image, int n);

// A picture of a rendering that was drawn n times as wide and high as it is shown: averaged if it has the frame's size,
// else as it is.
[[nodiscard]] Image8 as_shown(Image8 image, const Rendering& rendering, int n);

}  // namespace ninebit

// A program on pictures of any size: the drawing has the size of its picture, which keeps its texels.
#pragma once

#include <string>
#include <vector>

#include "ninebit/effect/effect_renderer.h"
#include "src/tools/draw/draw_flags.h"

namespace ninebit::tools {

// Changes an effect that effect_of() made.
// - Unless --size is given, a drawing of the rectangle gets the size of the first picture that a unit reads.
// - A picture whose sides are not powers of two becomes a rectangle texture, and its unit's coordinates count texels.
//   In a drawing of the rectangle of its size the nearest texels are read by default.
// - It stays a 2D texture, which the readers resample, if the program has texture-shader stages, whose operations name
//   their target, or if it is read as rectangle textures cannot be: with mip-maps, repeating, around cylinders, with
//   borders. On a mesh it repeats by default. `warnings` says why.
// Pictures that cannot be read are left to the drawing, which reports them.
void keep_sizes(const DrawFlags& flags, const HardwareProfile& profile, const EffectReaders& readers, Effect& effect,
                std::vector<std::string>& warnings);

}  // namespace ninebit::tools

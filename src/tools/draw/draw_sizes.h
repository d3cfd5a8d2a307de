// A program on pictures of any size: the drawing has the size of its picture, which keeps its texels.
#pragma once

#include "ninebit/effect/effect_renderer.h"
#include "src/tools/draw/draw_flags.h"

namespace ninebit::tools {

// Of the effect that effect_of() made, if it draws the rectangle: gives the drawing the size of the first picture that
// a unit reads, unless --size is given. A picture whose sides are not powers of two becomes a rectangle texture, and
// its unit's coordinates count texels; in a drawing of its size the nearest ones are read by default. That is so unless
// the program has texture-shader stages, whose operations name their target, or a flag asks for what rectangle textures
// do not have: mip-maps, repeating, borders of texels. Then it stays a 2D texture, which the readers resample. Pictures
// that cannot be read are left to the drawing, which reports them.
void keep_sizes(const DrawFlags& flags, const HardwareProfile& profile, const EffectReaders& readers, Effect& effect);

}  // namespace ninebit::tools

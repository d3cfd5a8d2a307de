// A program on pictures, texel by texel.
#pragma once

#include <array>
#include <string>

#include "ninebit/combiner/state.h"
#include "ninebit/image/image_io.h"
#include "ninebit/numerics/result.h"
#include "src/tools/input/register_settings.h"

namespace ninebit::tools {

// The files of the texture units; empty: none.
using UnitPictures = std::array<std::string, 4>;

// The program's colour for each texel. There is at least one picture, and all must have the same size. Registers
// without a picture hold what --set gives them, or eval's defaults. Reports what read_texture reports, pictures of
// another size than the first, and those of floats or depths, which are no bytes. Requires a ProgressLine, which may
// stop it.
[[nodiscard]] Result<Image8> evaluate_pictures(const CombinerState& state, const HardwareProfile& profile,
                                               const UnitPictures& files, const RegisterSettings& set);

}  // namespace ninebit::tools

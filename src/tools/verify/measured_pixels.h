// Measured tables of depth formats, fog, wrap modes, colour keys and combiner quads.
#pragma once

#include <vector>

#include "src/tools/verify/measured_table.h"

namespace ninebit::tools {

// Their formats.
[[nodiscard]] std::vector<MeasuredFormat> make_pixel_formats();

}  // namespace ninebit::tools

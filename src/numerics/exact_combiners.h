// A profile's chip, with combiners that compute exactly.
#pragma once

#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {

// Returns the same chip with exact combiners: the codes and the narrowing are those of `ideal`; what the chip has, what
// registers hold at first, and the rasterizer stay. Pictures under both differ by the combiners' arithmetic alone.
[[nodiscard]] HardwareProfile with_exact_combiners(HardwareProfile profile);

}  // namespace ninebit

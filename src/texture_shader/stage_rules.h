// The rules of texture-shader stages for one fragment.
#pragma once

#include <cmath>
#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/stage_state.h"

namespace ninebit::one_fragment {

#define NINEBIT_STAGE_RULE inline
#include "src/texture_shader/stage_rules.inl"
#undef NINEBIT_STAGE_RULE

}  // namespace ninebit::one_fragment

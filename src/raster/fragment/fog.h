// Fog factors of fragments.
#pragma once

#include <cstdint>

#include "ninebit/numerics/profile_words.h"
#include "ninebit/raster/pipeline_state.h"

namespace ninebit {

// The byte of the factor at a fragment whose interpolated value is x: factors and the linear functions as
// byte_of_fog_factor (rule 25), the exponential ones to nearest (rule 49). NaN becomes 0.
[[nodiscard]] std::uint8_t fog_byte(const HardwareProfile& profile, const Fog& fog, float x);

}  // namespace ninebit

// The registers that fragments of a pack start with.
#pragma once

#include <cstdint>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::vectors {

// Rows with codes from 0 come first. NV20 class chips have as many rows with signed texels after them.
inline constexpr std::size_t kByteInputs = 512;

// Every code of every component is in the rows, the ends of the range are in each 16 of them.
[[nodiscard]] std::vector<RegisterFile> vector_inputs(const HardwareProfile& profile, std::uint64_t seed);

}  // namespace ninebit::vectors

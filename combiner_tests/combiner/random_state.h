// Random valid states and register contents, biased to the values where arithmetic goes wrong.
#pragma once

#include <vector>

#include "combiner_tests/support/random.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {

// The shipped profiles that compute with codes, which is what hardware does.
std::vector<HardwareProfile> integer_profiles();

// A shipped profile of integer arithmetic, one in four times with some rules replaced by their rivals.
HardwareProfile random_profile(Random& random);

// ideal or float-shader, as `base` says; one in eight with fewer bits to a byte.
HardwareProfile random_real_profile(Random& random, const HardwareProfile& base);

CombinerInput random_input(Random& random, PortionName portion, const HardwareProfile& profile);
PortionOutput random_output(Random& random, PortionName portion, const HardwareProfile& profile);
CombinerInput random_final_input(Random& random, Variable variable, const HardwareProfile& profile);

// A state that is valid for the profile.
CombinerState random_state(Random& random, const HardwareProfile& profile);

// A register code in [lowest, one].
int random_code(Random& random, const HardwareProfile& profile);

// All registers, zero and the constants too: what stands in those must not be read.
RegisterFile random_registers(Random& random, const HardwareProfile& profile);

}  // namespace ninebit::test

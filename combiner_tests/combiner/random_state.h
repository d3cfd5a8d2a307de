// Random valid states and register contents, biased to the values where arithmetic goes wrong.
#pragma once

#include <cstdint>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {

// SplitMix64: the same numbers from the same seed with every compiler and library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  // Case `index` of a run with `seed`.
  Random(std::uint64_t seed, std::uint64_t index) : state_(seed) { state_ = next() ^ (index * 0xD1342543DE82EF95U); }

  std::uint64_t next();
  // A whole number in [0, count), count > 0.
  int below(int count) { return static_cast<int>((next() >> 32) % static_cast<std::uint64_t>(count)); }
  bool one_in(int n) { return below(n) == 0; }

 private:
  std::uint64_t state_;
};

// The shipped profiles that compute with codes, which is what hardware does.
std::vector<HardwareProfile> integer_profiles();

// A shipped profile of integer arithmetic, one in four times with some rules replaced by their rivals.
HardwareProfile random_profile(Random& random);

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

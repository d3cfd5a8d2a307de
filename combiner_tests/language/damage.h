// Texts with random damage, which a parser must read as a valid program or refuse with good faults.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "combiner_tests/support/random.h"
#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {

struct Damage {
  std::uint64_t seed = 1;
  std::function<std::string(Random&)> whole;  // an undamaged text
  std::string_view bytes;                     // that the language knows; others come, too
  std::function<Parsed<CombinerState>(const SourceText&)> parse;
  int states = 0, refused = 0;  // the least of texts that are a state, and of those that are refused
  std::size_t kept = 0;         // bytes at the beginning that stay as they are
  int texts = 8000;
  int edits = 3;  // at most, in a text; 0: `whole` damages its texts itself
  const HardwareProfile& profile = profiles::nv2a;
};

// Makes random edits in each text (in a slow build in every eighth, which then counts eight times) and parses it. Fails
// the test at the first answer that is neither a state that GL accepts nor faults as fuzz/common.h wants them, or at a
// state that does not come back from the other forms, which every sixteenth one is asked. Skips where the fuzzers do
// the same.
void expect_states_or_faults(const Damage& damage);

}  // namespace ninebit::test

// Texts with random damage, which a parser must read as a valid program or refuse with good faults.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

#include "combiner_tests/support/random.h"
#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"

namespace ninebit::test {

struct Damage {
  std::uint64_t seed = 1;
  int texts = 20'000;
  std::function<std::string(Random&)> whole;  // an undamaged text
  std::size_t kept = 0;                       // bytes at its beginning that stay as they are
  std::string_view bytes;                     // that the language knows; others come, too
};

struct DamagedTexts {
  int states = 0, refused = 0;
};

// Makes one to three random edits in each text (in a slow build in every eighth, which then counts eight times), parses
// it, and fails the test at the first answer that is neither a state that GL accepts nor faults as fuzz/common.h wants
// them.
DamagedTexts parse_damaged(const Damage& damage, const HardwareProfile& profile,
                           Parsed<CombinerState> (*parse)(const SourceText&, const HardwareProfile&));

}  // namespace ninebit::test

// Alternative rules, one at a time, that may explain why a row differs.
#pragma once

#include <string>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "src/tools/verify/verify_table.h"

namespace ninebit::tools {

// A profile with one rule replaced.
struct Rival {
  std::string field;  // of the profile: "general_narrowing"
  std::string value;  // "toward-zero", as written in a profile's file
  std::string rules;  // their numbers in docs/numerics.md: "5, 8"; empty: no number
  HardwareProfile profile;
};

// The rivals of a profile with integer arithmetic: each rule of the arithmetic with its other value, then real numbers
// for the whole arithmetic. Other profiles have none.
[[nodiscard]] std::vector<Rival> rivals_of(const HardwareProfile& profile);

// The same with the rules that pixels follow beside the combiners', for any profile.
[[nodiscard]] std::vector<Rival> pixel_rivals_of(const HardwareProfile& profile);

// The computed codes for the row's expectations, in their order.
[[nodiscard]] std::vector<int> computed(const VerifyRow& row, const HardwareProfile& profile);

// Whether each code is allowed by its expectation.
[[nodiscard]] bool agrees(const VerifyRow& row, const std::vector<int>& codes);

}  // namespace ninebit::tools

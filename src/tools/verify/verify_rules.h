// Rules that might hold instead of a profile's own: what a difference is explained by.
#pragma once

#include <string>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "src/tools/verify/verify_table.h"

namespace ninebit::tools {

// A profile with one rule replaced.
struct Rival {
  std::string field;  // of the profile: "general_narrowing"
  std::string value;  // "toward-zero", as a profile's file would say it
  std::string rules;  // of docs/numerics.md: "5, 8"; empty: none has a number
  HardwareProfile profile;
};

// The rivals of a profile whose arithmetic is integer: each rule of the arithmetic by its other value, then real
// numbers for all of it. Of another profile, there are none.
[[nodiscard]] std::vector<Rival> rivals_of(const HardwareProfile& profile);

// The codes that stand where the row's expectations are, in their order.
[[nodiscard]] std::vector<int> computed(const VerifyRow& row, const HardwareProfile& profile);

// Whether all of them are allowed.
[[nodiscard]] bool agrees(const VerifyRow& row, const std::vector<int>& codes);

}  // namespace ninebit::tools

// The fields of a profile that the results of combiner programs depend on, with the values that each may have: what
// proofs go through, and what rows of a chip may decide.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A value that a field may have.
struct FieldValue {
  std::string word;                           // as a profile file writes it: "toward-zero", "-256"
  std::function<void(HardwareProfile&)> set;  // changes the value of a profile's field and leaves its evidence
};

// A field with integer arithmetic.
struct CombinerField {
  std::string_view name;           // as a profile file writes it
  std::string_view rules;          // the rules of docs/numerics.md that it stands in: "5, 8"; empty: none
  Evidence evidence;               // of the profile's value
  std::vector<FieldValue> values;  // the profile's own, then its rivals

  // Whether no specification, program of the time or measurement decides it: it is inferred or assumed.
  [[nodiscard]] bool is_open() const { return evidence == Evidence::inferred || evidence == Evidence::assumed; }
};

// The fields of the arithmetic, in the order of HardwareProfile. Empty for a profile whose arithmetic is not integer.
[[nodiscard]] std::vector<CombinerField> arithmetic_fields(const HardwareProfile& profile);

// The fields that say what registers hold before the first general combiner, in the order of HardwareProfile.
[[nodiscard]] std::vector<CombinerField> register_fields(const HardwareProfile& profile);

}  // namespace ninebit

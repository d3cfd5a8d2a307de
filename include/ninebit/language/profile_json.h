// Custom hardware profiles as JSON: a shipped profile with some fields replaced.
#pragma once

#include <memory>

#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A profile and the storage of its string views. Copies share the storage: a copy of `profile` is valid while any copy
// of its OwnedProfile lives.
struct OwnedProfile {
  HardwareProfile profile;           // its strings are views of `text`
  std::shared_ptr<const void> text;  // storage of the views; opaque
};

// Reads {"base": "geforce2", "name": "mine", "half": 127, "general_narrowing": "nearest-halves-up", …}: the name of a
// shipped profile, a new name, optionally "chip", and any fields of HardwareProfile by their names. A replaced field
// has the evidence `assumed` and the file's name (or "a custom profile") as its source.
//
// Values are whole numbers, true and false, or words; numerics/profile_fields.h has the words and the ranges of each.
//
// Faults: unknown keys and values, values of a wrong type, fields that the arithmetic does not read, and values out of
// range, also of the base where another field of the file changed the range.
[[nodiscard]] Parsed<OwnedProfile> parse_json_profile(const SourceText& source);

}  // namespace ninebit

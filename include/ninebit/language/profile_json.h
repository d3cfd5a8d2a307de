// A hardware profile of the caller's own: a shipped one with some fields replaced, as JSON.
#pragma once

#include <memory>

#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A profile and the text that its string views show. Copies share the text: a copy of `profile` is valid while any copy
// of its OwnedProfile lives.
struct OwnedProfile {
  HardwareProfile profile;           // its strings are views
  std::shared_ptr<const void> text;  // what the views show; not to be looked into
};

// Reads {"base": "geforce2", "name": "mine", "half": 127, "general_narrowing": "nearest-halves-up", …}: a shipped
// profile's name, a name that no shipped profile has, optionally "chip", and any fields of HardwareProfile by their
// names. A replaced field has the evidence `assumed` and the file's name (or "a profile of the caller's own") as its
// source.
//
// Values are whole numbers, true and false, or one of
//   arithmetic         integer, exact, float32            general_narrowing, final_narrowing  toward-zero,
//   narrowing_point    after-scale, before-scale                                              nearest-halves-up
//   secondary_alpha    one, as-given                      polygon_offset_slope                larger, root
//   dxt1_palette       rgb565, rgb888                     color_interpolation                 perspective, affine
//
// Faults: whatever is unknown, of another type or out of range: one = 255 >> byte_shift with byte_shift 0 to 4, lowest
// -one or -one - 1, half 0 to one, expand_offset one or one + 1, 1 to 8 general combiners, 1 to 4 texture units, bytes
// 0 to 255, 0 to 4 subpixel bits, 1 to 23 mantissa bits, 1 to 8 weight bits; a field that the arithmetic does not read.
[[nodiscard]] Parsed<OwnedProfile> parse_json_profile(const SourceText& source);

}  // namespace ninebit

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
// Values are whole numbers, true and false, or one of
//   arithmetic         integer, exact, float32            general_narrowing, final_narrowing  toward-zero,
//   narrowing_point    after-scale, before-scale          depth_narrowing, fog_narrowing,     nearest-halves-up
//   texture_filter_rounding  once, each-blend             texture_weight_narrowing,
//                                                         texture_bias_narrowing
//   color_weights      exact, 8-bits                      point_shape                         whole-pixels, squares
//   line_shape         diamonds, rectangles
//   secondary_alpha    one, as-given                      polygon_offset_slope                larger, root
//   dxt1_palette       rgb565, rgb888, dithered565        color_interpolation                 perspective, affine
//
// Faults: unknown keys and values, values of a wrong type, fields that the arithmetic does not read, and values out of
// range. The ranges:
//   byte_shift      0 to 4                general_combiners           1 to 8
//   one             255 >> byte_shift     texture_units               1 to 4
//   lowest          -one - 1 or -one      subpixel_bits               0 to 4
//   half            0 to one              vertex_color_mantissa_bits  1 to 23
//   expand_offset   one or one + 1        texture_weight_bits         1 to 8
//   lowest_output   lowest to -one        alpha bytes                 0 to 255
[[nodiscard]] Parsed<OwnedProfile> parse_json_profile(const SourceText& source);

}  // namespace ninebit

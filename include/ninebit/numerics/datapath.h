// The fields of a profile that the arithmetic reads, as plain integers: no strings, no evidence.
#pragma once

#include "ninebit/numerics/profile_words.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The fields of a HardwareProfile that the rules of combiner/arithmetic.inl read, under the same names;
// hardware_profile.h has datapath_of().
struct Datapath {
  Arithmetic arithmetic = Arithmetic::integer;  // if not integer, of the rest only `one` is read
  int one = 255;                                // the code of 1.0
  int lowest = -255;                            // the lowest code that a register can hold before the first stage
  int lowest_output = -255;                     // the lowest code that a general combiner writes
  int half = 128;           // the code of one half: in the bias, the half-bias mappings and the mux's threshold
  int expand_offset = 255;  // subtracted by the expanding mappings: 2v - expand_offset
  Narrowing general_narrowing = Narrowing::toward_zero;          // of a general combiner's outputs
  NarrowingPoint narrowing_point = NarrowingPoint::after_scale;  // before or after the scale
  Narrowing final_narrowing = Narrowing::nearest_halves_up;      // of the final combiner's products

  friend constexpr bool operator==(const Datapath&, const Datapath&) = default;
};

}  // namespace ninebit

// What the arithmetic needs of a profile, as plain integers: no strings, no evidence.
#pragma once

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// What the rules of arithmetic.inl read: the fields of that name of a HardwareProfile, without their evidence.
struct Datapath {
  Arithmetic arithmetic =
      Arithmetic::integer;  // in what numbers; with any but integer the rest is not read, save `one`
  int one = 255;            // the code of 1.0
  int lowest = -255;        // the lowest register value, as a code
  int half = 128;           // the code of one half: bias, half-bias mappings, the mux's threshold
  int expand_offset = 255;  // an expanding mapping gives 2v - this
  Narrowing general_narrowing = Narrowing::toward_zero;          // of a general combiner's outputs
  NarrowingPoint narrowing_point = NarrowingPoint::after_scale;  // before or after the scale
  Narrowing final_narrowing = Narrowing::nearest_halves_up;      // of the final combiner's products

  friend constexpr bool operator==(const Datapath&, const Datapath&) = default;
};

// The fields of a profile that the arithmetic reads.
[[nodiscard]] constexpr Datapath datapath_of(const HardwareProfile& profile) {
  return {profile.arithmetic,      profile.one,
          profile.lowest,          profile.half,
          profile.expand_offset,   profile.general_narrowing,
          profile.narrowing_point, profile.final_narrowing};
}

}  // namespace ninebit

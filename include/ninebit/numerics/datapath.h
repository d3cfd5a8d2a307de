// What the arithmetic needs of a profile, as plain integers: no strings, no evidence.
#pragma once

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

struct Datapath {
  Arithmetic arithmetic = Arithmetic::integer;
  int one = 255;
  int lowest = -255;
  int half = 128;
  int expand_offset = 255;
  Narrowing general_narrowing = Narrowing::toward_zero;
  NarrowingPoint narrowing_point = NarrowingPoint::after_scale;
  Narrowing final_narrowing = Narrowing::nearest_halves_up;

  friend constexpr bool operator==(const Datapath&, const Datapath&) = default;
};

[[nodiscard]] constexpr Datapath datapath_of(const HardwareProfile& profile) {
  return {profile.arithmetic,      profile.one,
          profile.lowest,          profile.half,
          profile.expand_offset,   profile.general_narrowing,
          profile.narrowing_point, profile.final_narrowing};
}

}  // namespace ninebit

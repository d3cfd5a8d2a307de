// The programs that the benchmarks measure.
#pragma once

#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"

namespace ninebit::bench {

struct MeasuredProgram {
  std::string_view name;
  std::string_view summary;  // one line
  CombinerState state;
  HardwareProfile profile;  // the given one or, if it has too few general combiners, nv2a
};

// In this order:
//   index    the article's comparison of two indices: two general combiners, alpha portions unused
//   heavy    two general combiners with live RGB and alpha: expanded inputs, dot product, mux, bias, scale of two; the
//            final combiner interpolates between E times F and the colour sum
//   eight    eight general combiners, all outputs of both portions written or summed, each with its own constants
//   default  OpenGL's default state: the colour sum and fog
// Reports a profile that refuses `index`.
[[nodiscard]] Result<std::vector<MeasuredProgram>> measured_programs(const HardwareProfile& profile);

}  // namespace ninebit::bench

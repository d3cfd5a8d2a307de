// The register-combiner programs of textured and masked surfaces.
#pragma once

#include <cstdint>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/result.h"

namespace ninebit {

// The colour that a surface program returns.
enum class SurfaceColor : std::uint8_t {
  primary_times_texture,  // primary × texture0, for the colour passes
  primary                 // for passes that draw an index, or no colour
};

// One general combiner: spare0 = the colour, spare0.alpha = texture0.alpha × alpha / 255. The final combiner passes
// spare0 on. Reports a profile that refuses the set-up.
[[nodiscard]] Result<CombinerState> surface_state(const HardwareProfile& profile, SurfaceColor color,
                                                  std::uint8_t alpha);
[[nodiscard]] Result<Program> surface_program(const HardwareProfile& profile, SurfaceColor color, std::uint8_t alpha);

}  // namespace ninebit

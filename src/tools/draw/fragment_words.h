// The words of the fragment state's flags.
#pragma once

#include <array>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/raster/pipeline_state.h"

namespace ninebit::tools {

// Reads "SOURCE,DESTINATION[,EQUATION]".
[[nodiscard]] Result<Blend> parse_blend(std::string_view text);
// Reads "FUNCTION,REFERENCE".
[[nodiscard]] Result<AlphaTest> parse_alpha_test(std::string_view text);
// Reads "FUNCTION" or "none".
[[nodiscard]] Result<DepthTest> parse_depth(std::string_view text);
// Reads the letters of the components that are written, such as "rgb", or "none".
[[nodiscard]] Result<std::array<bool, 4>> parse_color_mask(std::string_view text);

}  // namespace ninebit::tools

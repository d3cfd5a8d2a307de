// The colours of `draw`: --fog-color, --const0 and --const1.
#pragma once

#include <string>
#include <string_view>
#include <utility>

namespace ninebit::tools {

// The part of "[COMBINER:]R,G,B,A" before the colon, and the colour.
[[nodiscard]] std::pair<std::string_view, std::string> split_constant(std::string_view text);

// The fault of "[COMBINER:]R,G,B,A", or of "R,G,B"; empty: none.
[[nodiscard]] std::string check_constant(const std::string& text);
[[nodiscard]] std::string check_rgb(const std::string& text);

}  // namespace ninebit::tools

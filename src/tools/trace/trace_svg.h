// The picture of a trace, for slides: the stages as boxes that hold the lines of its text.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>

namespace ninebit::tools {

// An SVG file that needs no other file. `text` is what `ninebit trace` prints, with colours: blank lines separate its
// parts, and the combiners stand side by side. `bytes` is the colour of the result, if there is one.
[[nodiscard]] std::string trace_svg(const std::string& text, const std::optional<std::array<std::uint8_t, 4>>& bytes);

}  // namespace ninebit::tools

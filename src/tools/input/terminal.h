// The size of the reader's terminal, and text that fits it.
#pragma once

#include <string>
#include <string_view>

namespace ninebit::tools {

// Columns for lines of text on this standard stream: the environment variable COLUMNS if it is a whole number from 1
// to 10,000; else the terminal's width; else 80.
[[nodiscard]] int terminal_columns(int standard_stream);

// Code points of UTF-8 text.
[[nodiscard]] int width_of(std::string_view text);

// Breaks longer lines at spaces. Their rest is indented by 4 more than they are. A word that is too long stays whole.
[[nodiscard]] std::string wrapped(std::string_view text, int columns);

}  // namespace ninebit::tools

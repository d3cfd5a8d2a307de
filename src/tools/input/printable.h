// Makes foreign text safe for a terminal: names of files and objects, bytes of files, messages of libraries.
#pragma once

#include <string>
#include <string_view>

#include "src/system/quoting.h"

namespace ninebit::tools {

// The text on one line, for messages and for cells of tables. Backslashes are not escaped, so two different names can
// look the same: for people only.
[[nodiscard]] std::string printable(std::string_view text);

// The same, but a text of more than 2,000 bytes loses its middle: a message starts with its file and ends with its
// reason, and may quote a name of any length between them.
[[nodiscard]] std::string printable_briefly(std::string_view text);

// The same as printable() for a text of several lines; line breaks and tabs stay.
[[nodiscard]] std::string printable_lines(std::string_view text);

}  // namespace ninebit::tools

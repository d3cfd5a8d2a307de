// The C file of all kits, without the rows.
#pragma once

#include <string_view>

namespace ninebit::tools {

// kit.c beside this file. A line that begins with the comment "ROWS" stands for the rows.
extern const std::string_view kKitText;

}  // namespace ninebit::tools

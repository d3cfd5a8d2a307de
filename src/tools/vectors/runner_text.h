// The C file of all packs.
#pragma once

#include <string_view>

namespace ninebit::tools {

// runner.c beside this file.
extern const std::string_view kRunnerText;

}  // namespace ninebit::tools

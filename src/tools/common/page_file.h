// -o PAGE.html of the verbs that write one page.
#pragma once

#include <string>

#include "ninebit/numerics/result.h"
#include "src/page/diagram_page.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// Adds -o, --output.
CLI::Option* add_page_flag(CLI::App& verb, std::string& output);

// Writes the page under a temporary name and renames it.
[[nodiscard]] Status write_page(const std::string& path, const DiagramPage& page);

}  // namespace ninebit::tools

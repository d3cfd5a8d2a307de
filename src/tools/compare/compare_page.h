// The page of `ninebit compare`: one file without network or other files.
#pragma once

#include <string>

#include "src/tools/compare/compare_rows.h"

namespace ninebit::tools {

// The HTML text. Names of files and settings are data of its script, which shows them as text.
[[nodiscard]] std::string compare_page(const CompareFlags& flags, const Comparison& comparison);

}  // namespace ninebit::tools

// The page of `ninebit compare`: one file without network or other files.
#pragma once

#include <string>
#include <string_view>

#include "src/tools/compare/compare_points.h"

namespace ninebit::tools {

// The HTML text. Names of files and settings are data of its script, which shows them as text.
[[nodiscard]] std::string compare_page(const CompareFlags& flags, const Comparison& comparison);

// The texts that the page of `compare` contains, embedded in the program at build time.

extern const std::string_view kPictureSwipe;   // src/page/web/picture_swipe.js
extern const std::string_view kSortableTable;  // src/page/web/sortable_table.js
extern const std::string_view kCompareScript;  // compare.js beside this file
extern const std::string_view kCompareStyle;   // compare.css beside this file

}  // namespace ninebit::tools

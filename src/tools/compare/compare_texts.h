// The texts that the page of `compare` contains, embedded in the program at build time.
#pragma once

#include <string_view>

namespace ninebit::tools {

extern const std::string_view kPictureSwipe;   // src/page/web/picture_swipe.js
extern const std::string_view kSortableTable;  // src/page/web/sortable_table.js
extern const std::string_view kWrongPixels;    // src/page/web/wrong_pixels.js
extern const std::string_view kCompareScript;  // compare.js beside this file
extern const std::string_view kCompareStyle;   // compare.css beside this file

}  // namespace ninebit::tools

// Texts of reports, in pages and SVG files: markup is shown and not run, numbers are for people.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/study/report.h"

namespace ninebit {

// The text between tags or in a quoted attribute.
[[nodiscard]] std::string escaped(std::string_view text);

// A number with groups of three digits; reals have six significant digits.
[[nodiscard]] std::string readable(const StudyValue& value);

}  // namespace ninebit

// The data for the page's script: plots and heat maps as JSON.
#pragma once

#include <string>

#include "ninebit/study/report.h"

namespace ninebit {

// {"palette": […], "ramps": […], "plots": […], "maps": […]} without the character '<', so that nothing in it can end a
// <script> element. Points that a plot cannot show are left out. Reports a heat map whose size does not match its
// number of values.
[[nodiscard]] Result<std::string> page_data(const StudyReport& report);

}  // namespace ninebit

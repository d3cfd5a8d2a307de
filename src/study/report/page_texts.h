// The texts that every report's page holds, embedded when the program is built (page/embed.cmake).
#pragma once

#include <string_view>

namespace ninebit {

extern const std::string_view kChartScript;  // Chart.js, as the distribution's package libjs-chart.js has it
extern const std::string_view kPageScript;   // page/report.js
extern const std::string_view kPageStyle;    // page/report.css

}  // namespace ninebit

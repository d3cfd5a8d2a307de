// The texts that every report's page contains, embedded in the program at build time (page/embed.cmake).
#pragma once

#include <string_view>

namespace ninebit {

extern const std::string_view kChartScript;  // Chart.js, from the distribution's package libjs-chart.js
// The page's own script, in this order:
extern const std::string_view kValuesScript;  // page/values.js
extern const std::string_view kPlotsScript;   // page/plots.js
extern const std::string_view kPageScript;    // page/report.js
// The modules of pages whose pictures say what is wrong at a pixel:
extern const std::string_view kWrongPixels;     // src/page/web/wrong_pixels.js
extern const std::string_view kPictureProbe;    // src/page/web/picture_probe.js
extern const std::string_view kPicturesScript;  // page/pictures.js, for reports
extern const std::string_view kReportLook;  // page/look.css: colours and fonts, for every page with tables and pictures
extern const std::string_view kPageStyle;   // page/report.css
extern const std::string_view kPrintStyle;  // page/print.css, for every page with tables and pictures

}  // namespace ninebit

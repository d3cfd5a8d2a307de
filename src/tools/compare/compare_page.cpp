#include "src/tools/compare/compare_page.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

#include "src/study/report/page_data.h"
#include "src/study/report/page_texts.h"

namespace ninebit::tools {
namespace {

// The page's data.
std::string page_json(const CompareFlags& flags, const Comparison& comparison) {
  Json data = compare_json(flags, comparison);
  for (std::size_t i = 0; i < comparison.rows.size(); ++i) {
    const ComparedRow& row = comparison.rows[i];
    if (!row.color.empty()) data["rows"][i]["color"] = picture_url(row.color);
    if (!row.wrong.empty()) data["rows"][i]["wrong_pixels"] = picture_url(row.wrong);
    if (row.errors) {
      const std::vector<PictureTrace> traces(row.errors->worst.begin(), row.errors->worst.end());
      data["rows"][i]["traces"] = traces_json(traces);
    }
  }
  data["made_by"] = given_command();
  data["causes"] = cause_names();
  return script_text(data);
}

// A module without its lines of imports: on the page all modules are one.
std::string without_imports(std::string_view module) {
  std::string text;
  while (!module.empty()) {
    const std::size_t end = std::min(module.find('\n'), module.size() - 1) + 1;
    if (!module.starts_with("import ")) text += module.substr(0, end);
    module.remove_prefix(end);
  }
  return text;
}

}  // namespace

std::string compare_page(const CompareFlags& flags, const Comparison& comparison) {
  // The policy makes browsers refuse all external resources.
  std::string page =
      "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; script-src 'unsafe-inline'; "
      "style-src 'unsafe-inline'; img-src data:\">\n<link rel=\"icon\" href=\"data:,\">\n"
      "<title>Comparison – ninebit</title>\n<style>\n";
  page += kReportLook;
  page += kCompareStyle;
  page += kPrintStyle;
  page += "</style>\n</head>\n<body>\n<noscript>This page needs JavaScript. report.json has its figures.</noscript>\n";
  page += fmt::format("<script type=\"application/json\" id=\"data\">{}</script>\n<script type=\"module\">\n",
                      page_json(flags, comparison));
  page += kPictureSwipe;
  page += kSortableTable;
  page += kWrongPixels;
  page += kPictureProbe;
  page += without_imports(kCompareScript);
  return page + "</script>\n</body>\n</html>\n";
}

}  // namespace ninebit::tools

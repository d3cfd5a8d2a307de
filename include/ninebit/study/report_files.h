// A study's files: the report that people open, and the raw rows.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/report.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// The units' rows and the report's as one JSON object: {"command": "study index-steps", "version": …, "profile": …,
// "question": "ninebit study …", "rows": [{…}, …]}; rows of other tables follow "rows" under the table's name.
[[nodiscard]] std::string report_json(const StudyQuestion& question, std::string_view version,
                                      const StudyReport& report, std::span<const StudyRow> rows);

// The units' rows and the report's, each table as CSV with a header line: the table's name and its text, in the order
// of first appearance.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> report_csv(const StudyReport& report,
                                                                          std::span<const StudyRow> rows);

// The report as one self-contained HTML page that opens without a network. A click on a column's heading sorts its
// table; plots and heat maps show the value under the pointer.
[[nodiscard]] Result<std::string> report_html(const StudyQuestion& question, std::string_view version,
                                              const StudyReport& report, std::span<const StudyRow> rows);

// Writes report.html, rows.json, a CSV for each table, a PNG for each heat map and picture, and the report's files into
// the folder, all or none; the same rows give the same bytes. Returns the paths. Reports files that could not be
// written.
[[nodiscard]] Result<std::vector<std::filesystem::path>> write_report(const std::filesystem::path& folder,
                                                                      const StudyQuestion& question,
                                                                      std::string_view version,
                                                                      const StudyReport& report,
                                                                      std::span<const StudyRow> rows);

}  // namespace ninebit

// The tables of a sweep's report.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "src/study/shadows/shadow_sweep_report.h"

namespace ninebit {

ReportTable point_table(std::span<const StudyRow> rows) {
  ReportTable table{.title = "Points", .columns = {}, .rows = {}, .kept = "wrong"};
  std::vector<std::size_t> shown;
  std::vector<std::string> same;
  const auto& fields = rows.front().fields;
  for (std::size_t f = 0; f < fields.size(); ++f) {
    const StudyValue& value = fields[f].second;
    const auto has_value = [&](const StudyRow& row) { return row.fields[f].second == value; };
    if (fields[f].first == table.kept || rows.size() == 1 || !std::all_of(rows.begin(), rows.end(), has_value)) {
      shown.push_back(f);
      table.columns.push_back(fields[f].first);
    } else if (!std::holds_alternative<std::monostate>(value)) {
      same.push_back(fmt::format("{} {}", fields[f].first, text_of(value)));
    }
  }
  for (const StudyRow& row : rows) {
    std::vector<StudyValue>& values = table.rows.emplace_back();
    for (const std::size_t f : shown) values.push_back(row.fields[f].second);
  }
  table.caption = "wrong_share is the share of the pixels that show the scene.";
  if (!same.empty()) table.caption += fmt::format(" The same at all points: {}.", fmt::join(same, ", "));
  return table;
}

ReportTable value_table(const SweepView& view, const std::string& column) {
  const bool with_truncation = column == "index_step";
  ReportTable table{.title = fmt::format("Fewest wrong pixels by {}", column),
                    .columns = {column, "fewest wrong"},
                    .rows = {},
                    .caption = "Among all points with the value."};
  if (with_truncation) table.columns.emplace_back("most lost to truncation");
  std::vector<const StudyRow*> firsts;  // of each value
  for (const StudyRow* row : view.rows) {
    const auto has_value = [&](const StudyRow* other) { return (*other)[column] == (*row)[column]; };
    if (std::any_of(firsts.begin(), firsts.end(), has_value)) continue;
    firsts.push_back(row);
    std::uint64_t fewest = row->count("wrong"), most = 0;
    for (const StudyRow* other : view.rows) {
      if (!has_value(other)) continue;
      fewest = std::min(fewest, other->count("wrong"));
      most = std::max(most, other->count("truncation"));
    }
    std::vector<StudyValue>& values = table.rows.emplace_back();
    values = {(*row)[column], fewest};
    if (with_truncation) values.emplace_back(most);
  }
  return table;
}

}  // namespace ninebit

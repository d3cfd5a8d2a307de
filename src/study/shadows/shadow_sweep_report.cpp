#include "src/study/shadows/shadow_sweep_report.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace ninebit {

namespace {

bool was_drawn(const StudyRow& row) {
  return std::holds_alternative<std::monostate>(row["refused"]);
}

bool fewer_wrong(const StudyRow* a, const StudyRow* b) {
  return a->count("wrong") < b->count("wrong");
}

SweepView view_of(const SweptSettings& known, std::span<const SweepAxis> axes, std::span<const StudyRow> rows) {
  SweepView view{.rows = {}, .columns = {}, .causes = {}, .best = best_row(rows)};
  for (const StudyRow& row : rows) {
    if (was_drawn(row)) view.rows.push_back(&row);
  }
  for (const SweepAxis& axis : axes) {
    for (std::size_t i = 0; i < axis.setting->numbers; ++i) {
      const std::string column(axis.setting->axis.columns[i]);
      const auto differs = [&](const StudyRow* row) { return (*row)[column] != (*view.rows.front())[column]; };
      if (std::any_of(view.rows.begin(), view.rows.end(), differs)) view.columns.push_back(column);
    }
  }
  for (const ErrorCause cause : causes_of(known)) view.causes.emplace_back(name_of(cause));
  return view;
}

std::string wrong_in_words(const StudyRow& row) {
  std::vector<std::string> parts;
  if (row.count("false_lit") > 0) parts.push_back(fmt::format("{} falsely lit", row.count("false_lit")));
  if (row.count("false_shadowed") > 0) parts.push_back(fmt::format("{} falsely shadowed", row.count("false_shadowed")));
  return fmt::format("{} wrong pixels ({:.3g} %){}{}", row.count("wrong"), 100.0 * row.number("wrong_share"),
                     parts.empty() ? "" : ": ", fmt::join(parts, ", "));
}

std::string with(const std::string& label) {
  return label.empty() ? "" : fmt::format(" with {}", label);
}

std::string extremes_in_words(const SweepView& view) {
  const StudyRow* worst = *std::max_element(view.rows.begin(), view.rows.end(), fewer_wrong);
  std::string text = fmt::format("Fewest{}: {}.", with(view.label(*view.best)), wrong_in_words(*view.best));
  if (worst != view.best) text += fmt::format(" Most{}: {}.", with(view.label(*worst)), wrong_in_words(*worst));
  return text;
}

// Errors by map size, with all other columns as in the best row.
std::string map_sizes_in_words(const SweepView& view) {
  const std::vector<std::string> column{"map_size"};
  const auto beside = view.beside(*view.best, column);
  const auto smaller = [](const StudyRow* a, const StudyRow* b) {
    return a->number("map_size") < b->number("map_size");
  };
  const auto [low, high] = std::minmax_element(beside.begin(), beside.end(), smaller);
  const StudyRow &first = **low, &last = **high;
  const double doublings = std::log2(last.number("map_size") / first.number("map_size"));
  std::string text =
      fmt::format("From map_size {} to {}{} the wrong pixels go from {} to {}", first.text("map_size"),
                  last.text("map_size"), with(view.label(last, column)), first.count("wrong"), last.count("wrong"));
  if (first.count("wrong") > 0 && last.count("wrong") > 0) {
    text +=
        fmt::format(", ×{:.2f} per doubling", std::pow(last.number("wrong") / first.number("wrong"), 1.0 / doublings));
  }
  return text + '.';
}

// The fewest wrong pixels for each value of a column.
std::string values_in_words(const SweepView& view, const std::string& column) {
  std::vector<std::pair<std::string, std::uint64_t>> fewest;
  for (const StudyRow* row : view.rows) {
    const std::string value = row->text(column);
    const auto at = std::find_if(fewest.begin(), fewest.end(), [&](const auto& f) { return f.first == value; });
    if (at == fewest.end()) {
      fewest.emplace_back(value, row->count("wrong"));
    } else {
      at->second = std::min(at->second, row->count("wrong"));
    }
  }
  std::vector<std::string> parts;
  for (const auto& [value, wrong] : fewest) parts.push_back(fmt::format("{}: {}", value, wrong));
  return fmt::format("Fewest wrong pixels by {}: {}.", column, fmt::join(parts, ", "));
}

// The most pixels that each step loses to truncation.
std::string truncation_in_words(const SweepView& view) {
  std::vector<std::pair<std::string, std::uint64_t>> most;
  for (const StudyRow* row : view.rows) {
    const std::string step = row->text("index_step");
    const auto at = std::find_if(most.begin(), most.end(), [&](const auto& m) { return m.first == step; });
    if (at == most.end()) {
      most.emplace_back(step, row->count("truncation"));
    } else {
      at->second = std::max(at->second, row->count("truncation"));
    }
  }
  std::vector<std::string> parts;
  for (const auto& [step, pixels] : most) parts.push_back(fmt::format("{}: {}", step, pixels));
  return fmt::format("Most pixels lost to truncation by index_step: {}.", fmt::join(parts, ", "));
}

std::string offset_of(const StudyRow& row) {
  return fmt::format("{},{}", row.text(kOffsetColumns[0]), row.text(kOffsetColumns[1]));
}

// For one combination of the other columns: the row with the best offset, and the row without an offset, if present.
struct OffsetChoice {
  const StudyRow* best;
  const StudyRow* none = nullptr;
};

std::vector<OffsetChoice> best_offsets(const SweepView& view) {
  std::vector<OffsetChoice> choices;
  std::set<std::string> seen;
  for (const StudyRow* row : view.rows) {
    if (!seen.insert(view.label(*row, kOffsetColumns)).second) continue;
    const auto beside = view.beside(*row, kOffsetColumns);
    OffsetChoice choice{.best = *std::min_element(beside.begin(), beside.end(), fewer_wrong)};
    for (const StudyRow* other : beside) {
      if (other->number(kOffsetColumns[0]) == 0.0 && other->number(kOffsetColumns[1]) == 0.0) choice.none = other;
    }
    choices.push_back(choice);
  }
  return choices;
}

std::string difference(const StudyRow& row, const StudyRow& none, const char* column) {
  return fmt::format("{:+}",
                     static_cast<std::int64_t>(row.count(column)) - static_cast<std::int64_t>(none.count(column)));
}

// A note if the best value is at the end of its axis, because a larger one may be better.
std::string at_the_end(const SweepView& view, const StudyRow& best) {
  std::string text;
  for (const auto& [column, name] : {std::pair{kOffsetColumns[0], "factors"}, std::pair{kOffsetColumns[1], "units"}}) {
    const auto larger = [&, in = column](const StudyRow* row) { return row->number(in) > best.number(in); };
    if (view.changes(column) && std::none_of(view.rows.begin(), view.rows.end(), larger)) {
      text += fmt::format(" Larger {} were not tried.", name);
    }
  }
  return text;
}

std::string offset_in_words(const SweepView& view, const OffsetChoice& choice) {
  const StudyRow& best = *choice.best;
  std::string text = fmt::format("Best polygon offset{}: {}, with {}.", with(view.label(best, kOffsetColumns)),
                                 offset_of(best), wrong_in_words(best));
  if (choice.none != nullptr && choice.none != choice.best) {
    text += fmt::format(
        " Without one there are {}; so the offset changes falsely shadowed pixels by {}, at the cost of "
        "{} falsely lit.",
        wrong_in_words(*choice.none), difference(best, *choice.none, "false_shadowed"),
        difference(best, *choice.none, "false_lit"));
  }
  return text + at_the_end(view, best);
}

ReportTable offset_table(const SweepView& view, const std::vector<OffsetChoice>& choices) {
  ReportTable table{.title = "Best polygon offsets",
                    .columns = {"for", "factor", "units", "wrong", "false_lit", "false_shadowed", "wrong without",
                                "false_lit without", "false_shadowed without"},
                    .rows = {}};
  for (const auto& [best, none] : choices) {
    std::vector<StudyValue> values{view.label(*best, kOffsetColumns), (*best)[kOffsetColumns[0]],
                                   (*best)[kOffsetColumns[1]]};
    for (const StudyRow* row : {best, none}) {
      for (const char* column : {"wrong", "false_lit", "false_shadowed"}) {
        values.push_back(row == nullptr ? StudyValue() : (*row)[column]);
      }
    }
    table.rows.push_back(std::move(values));
  }
  table.caption = "The tried offset with the fewest wrong pixels, compared with no offset.";
  return table;
}

// How many points were drawn with their indices in the order of the file instead; empty: none.
std::string orders_in_words(const SweepView& view) {
  std::size_t count = 0;
  std::string first;
  for (const StudyRow* row : view.rows) {
    const std::string reason = row->text("index_order_reason");
    if (reason.empty()) continue;
    if (count == 0) first = reason;
    ++count;
  }
  if (count == 0) return {};
  return fmt::format("{} of {} points were drawn with index_order file instead of neighbour; the first of them: {}.",
                     count, view.rows.size(), first);
}

}  // namespace

const std::vector<std::string> kOffsetColumns{"polygon_offset_factor", "polygon_offset_units"};

const StudyRow* best_row(std::span<const StudyRow> rows) {
  const StudyRow* best = nullptr;
  for (const StudyRow& row : rows) {
    if (was_drawn(row) && (best == nullptr || fewer_wrong(&row, best))) best = &row;
  }
  return best;
}

const StudyRow* worst_row(std::span<const StudyRow> rows) {
  const StudyRow* worst = nullptr;
  for (const StudyRow& row : rows) {
    if (was_drawn(row) && (worst == nullptr || fewer_wrong(worst, &row))) worst = &row;
  }
  return worst;
}

bool SweepView::changes(std::string_view column) const {
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

std::string SweepView::label(const StudyRow& row, std::span<const std::string> left_out) const {
  std::vector<std::string> parts;
  for (const std::string& column : columns) {
    if (std::find(left_out.begin(), left_out.end(), column) != left_out.end()) continue;
    parts.push_back(fmt::format("{} {}", column, row.text(column)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::vector<const StudyRow*> SweepView::beside(const StudyRow& row, std::span<const std::string> columns_of) const {
  const std::string own = label(row, columns_of);
  std::vector<const StudyRow*> found;
  for (const StudyRow* other : rows) {
    if (label(*other, columns_of) == own) found.push_back(other);
  }
  return found;
}

StudyReport shadow_sweep_report(const SweptSettings& known, std::span<const SweepAxis> axes,
                                std::span<const StudyRow> rows, std::size_t done, std::size_t units) {
  StudyReport report{.title = fmt::format("Shadows of {}", known.technique), .answers = {}};
  if (done < units) report.answers.push_back(fmt::format("{} of {} points were drawn so far.", done, units));
  if (rows.empty()) return report;
  const SweepView view = view_of(known, axes, rows);
  report.answers.push_back(extremes_in_words(view));
  report.tables.push_back(point_table(rows));
  if (view.changes("map_size")) report.answers.push_back(map_sizes_in_words(view));
  if (view.changes(kOffsetColumns[0]) || view.changes(kOffsetColumns[1])) {
    const auto choices = best_offsets(view);
    const auto least = std::min_element(choices.begin(), choices.end(),
                                        [](const auto& a, const auto& b) { return fewer_wrong(a.best, b.best); });
    report.answers.push_back(offset_in_words(view, *least));
    report.tables.push_back(offset_table(view, choices));
  }
  report.headlines = report.answers;
  for (const std::string& column : view.columns) {
    const bool told = column == "map_size" || column == kOffsetColumns[0] || column == kOffsetColumns[1];
    if (told) continue;
    report.answers.push_back(values_in_words(view, column));
    report.summary.push_back(value_table(view, column));
  }
  if (view.changes("index_step")) report.answers.push_back(truncation_in_words(view));
  std::vector<std::string> notes;
  if (const std::string orders = orders_in_words(view); !orders.empty()) notes.push_back(orders);
  if (view.rows.size() < rows.size()) {
    const auto refused = std::find_if(rows.begin(), rows.end(), [](const StudyRow& row) { return !was_drawn(row); });
    notes.push_back(fmt::format("{} of {} points cannot be drawn; the first of them: {}.",
                                rows.size() - view.rows.size(), rows.size(), refused->text("refused")));
  }
  report.answers.insert(report.answers.end(), notes.begin(), notes.end());
  report.headlines.insert(report.headlines.end(), notes.begin(), notes.end());
  report.plots = sweep_plots(view);
  report.heat_maps = offset_maps(view);
  return report;
}

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

#include "src/tools/verify/measured_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "src/tools/verify/measured_rows.h"

namespace ninebit::tools {
namespace {

using namespace columns_of_tables;

constexpr double kLargestReal = 3.4e38;  // as a float it is finite

template <class T>
bool reads(std::string_view text, T& value, int base = 10) {
  if constexpr (std::is_floating_point_v<T>) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
  } else {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    return error == std::errc{} && end == text.data() + text.size();
  }
}

// The expected form of a wrong field; empty: it is right.
std::string read_cell(const Column& column, std::string_view field, MeasuredRow::Cell& cell) {
  cell.text = field;
  if (column.kind == Kind::note || column.kind == Kind::word) return "";
  const bool is_extent = column.kind == Kind::extent;
  if (field.empty() && (column.kind == Kind::measured || is_extent || column.may_be_empty)) return "";
  if (column.kind == Kind::real) {
    const std::string_view number = field.ends_with(')') ? trimmed(field.substr(0, field.find('('))) : field;
    // NaN is not within.
    return reads(number, cell.real) && std::abs(cell.real) <= kLargestReal ? "" : "a number within ±3.4e38";
  }
  if (column.kind == Kind::digits) {
    if (field.starts_with("0x")) field.remove_prefix(2);
    return field.size() <= 8 && reads(field, cell.whole, 16) ? "" : "up to eight hexadecimal digits";
  }
  if (column.kind == Kind::word_hex) {
    return field.size() <= 4 && reads(field, cell.whole, 16) && cell.whole >= 0 ? "" : "up to four hexadecimal digits";
  }
  if (column.kind == Kind::match) return field == "0" || field == "1" ? "" : "0 or 1";
  if (column.kind == Kind::measured) {
    int value = 0;
    for (const std::string_view piece : pieces(field, '|')) {
      if (!reads(piece, value)) return "whole numbers of 32 bits separated by |, or empty";
    }
    return "";
  }
  if (column.kind == Kind::runs) return pixel_runs(field) ? "" : "runs of pixels, such as 3-5 7-7, or empty";
  if (column.kind == Kind::counts || column.kind == Kind::most) {
    return pixel_counts(field) ? "" : "whole numbers with counts of pixels, such as 16:8121;0:144879";
  }
  if (is_extent) return reads(field, cell.whole) ? "" : "a whole number, or empty";
  if (reads(field, cell.whole) && cell.whole >= column.low && cell.whole <= column.high) return "";
  return fmt::format("a whole number from {} to {}", column.low, column.high);
}

using Stated = StatedValue;

// The value that a text begins with; empty: something else stands there.
std::optional<MeasuredRow::Cell> stated_at(const Stated& what, std::string_view text) {
  MeasuredRow::Cell cell;
  const char* const end = text.data() + text.size();
  if (what.kind == Stated::Kind::real) {
    if (std::from_chars(text.data(), end, cell.real).ec != std::errc{}) return std::nullopt;
    cell.whole = static_cast<std::int64_t>(cell.real);
    cell.list = {cell.real};
    return cell;
  }
  if (what.kind == Stated::Kind::digits) {
    if (std::from_chars(text.data(), end, cell.whole, 16).ec != std::errc{}) return std::nullopt;
    cell.list = {static_cast<double>(cell.whole)};
    return cell;
  }
  if (what.kind == Stated::Kind::rows) {
    for (const std::string_view row : pieces(text, ';')) {
      for (const std::string_view piece : pieces(row, ' ')) {
        if (!reads(piece, cell.list.emplace_back())) return std::nullopt;
      }
    }
    return cell.list.size() == what.count ? std::optional(std::move(cell)) : std::nullopt;
  }
  // Text behind the last number is a remark.
  const auto needs_more = [&] { return what.count == 0 || cell.list.size() < what.count; };
  while (needs_more() && text.starts_with('(') && text.find(')') != std::string_view::npos) {
    for (const std::string_view piece : pieces(text.substr(1, text.find(')') - 1), ',')) {
      if (!reads(piece, cell.list.emplace_back())) return std::nullopt;
    }
    text = trimmed(text.substr(text.find(')') + 1));
  }
  const std::size_t count = cell.list.size();
  const bool fits = what.count != 0 ? count == what.count : count >= 4 && count % 2 == 0;
  return fits ? std::optional(std::move(cell)) : std::nullopt;
}

// All values that a comment states.
std::vector<MeasuredRow::Cell> stated_in(const Stated& what, std::string_view comment) {
  std::vector<MeasuredRow::Cell> found;
  const auto add = [&](std::string_view text) {
    if (auto cell = stated_at(what, text)) found.push_back(*std::move(cell));
  };
  const std::string_view text = trimmed(comment.substr(1));
  if (text.starts_with(what.name) && text.substr(what.name.size()).starts_with(':')) {
    add(trimmed(text.substr(what.name.size() + 1)));
  }
  for (std::size_t at = text.find(what.before); at != std::string_view::npos; at = text.find(what.before, at + 1)) {
    add(text.substr(at + what.before.size()));
  }
  return found;
}

}  // namespace

std::vector<std::string_view> pieces(std::string_view text, char separator) {
  std::vector<std::string_view> found;
  while (true) {
    const std::size_t end = text.find(separator);
    found.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return found;
    text.remove_prefix(end + 1);
  }
}

std::vector<std::string_view> quoted_pieces(std::string_view text) {
  std::vector<std::string_view> found;
  while (true) {
    const bool is_quoted = text.starts_with('"') && text.find('"', 1) != std::string_view::npos;
    const std::size_t close = is_quoted ? text.find('"', 1) : 0, end = text.find(',', close);
    found.push_back(is_quoted ? text.substr(1, close - 1) : trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return found;
    text.remove_prefix(end + 1);
  }
}

std::optional<int> number_of(std::string_view text) {
  int value = 0;
  return reads(text, value) ? std::optional(value) : std::nullopt;
}

std::optional<std::vector<PixelRun>> pixel_runs(std::string_view text) {
  std::vector<PixelRun> runs;
  if (text.empty()) return runs;
  for (const std::string_view piece : pieces(text, ' ')) {
    PixelRun run;
    const std::size_t dash = piece.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    if (!reads(piece.substr(0, dash), run.first) || !reads(piece.substr(dash + 1), run.last)) return std::nullopt;
    runs.push_back(run);
  }
  return runs;
}

std::optional<std::vector<PixelCount>> pixel_counts(std::string_view text) {
  std::vector<PixelCount> counts;
  for (const std::string_view piece : pieces(text, ';')) {
    PixelCount count;
    const std::size_t colon = piece.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    if (!reads(piece.substr(0, colon), count.value) || !reads(piece.substr(colon + 1), count.pixels))
      return std::nullopt;
    if (count.value < 0 || count.value > std::numeric_limits<int>::max() || count.pixels < 1) return std::nullopt;
    counts.push_back(count);
  }
  return counts;
}

bool is_of_the_picture(const MeasuredColumn& column) {
  return column.kind == Kind::measured || column.kind == Kind::word_hex || column.kind == Kind::extent ||
         column.kind == Kind::runs || column.kind == Kind::most;
}

std::vector<int> allowed_values(const MeasuredColumn& column, const std::string& text) {
  if (column.kind == Kind::runs) return {0};
  if (column.kind == Kind::extent && text.empty()) return {kNothingDrawn};
  if (column.kind == Kind::word_hex) {
    int word = 0;
    return reads(std::string_view(text), word, 16) ? std::vector{word} : std::vector<int>();
  }
  if (column.kind == Kind::most) {
    PixelCount most{};
    const auto counts = pixel_counts(text);
    for (const PixelCount& count : *counts) {
      if (count.value != 0 && count.pixels > most.pixels) most = count;
    }
    return {static_cast<int>(most.value)};
  }
  std::vector<int> allowed;
  for (const std::string_view piece : pieces(text, '|')) {
    int value = 0;
    if (reads(piece, value)) allowed.push_back(value);
  }
  return allowed;
}

Status read_stated(const std::vector<StatedValue>& stated, const std::vector<std::string>& comments,
                   const std::string& file, int line, MeasuredRow& row) {
  for (const StatedValue& what : stated) {
    std::vector<MeasuredRow::Cell> found;
    for (const std::string& comment : comments) {
      for (MeasuredRow::Cell& cell : stated_in(what, comment)) found.push_back(std::move(cell));
    }
    if (found.empty() && what.may_be_missing) continue;
    const auto differs = [&](const MeasuredRow::Cell& one) { return one.list != found[0].list; };
    const bool is_one = !found.empty() && std::none_of(found.begin(), found.end(), differs);
    const auto is_outside = [&](double number) { return !(number >= what.low && number <= what.high); };
    if (is_one && std::none_of(found[0].list.begin(), found[0].list.end(), is_outside)) {
      row.set(what.name, std::move(found[0]));
      continue;
    }
    const std::string why = found.empty() ? fmt::format("the comments do not state {}", what.name)
                            : is_one      ? fmt::format("{} must be from {:g} to {:g}", what.name, what.low, what.high)
                                          : fmt::format("the comments state different values of {}", what.name);
    return csv_fault(file, line, 1,
                     fmt::format("{}; expected a comment such as # {}: {}", why, what.name, what.example));
  }
  return {};
}

Status read_measured(const std::vector<MeasuredColumn>& columns, const std::vector<std::string_view>& fields,
                     const std::string& file, int line, MeasuredRow& row) {
  if (fields.size() != columns.size()) {
    return csv_fault(file, line, 1, fmt::format("the row has {} fields, the header {}", fields.size(), columns.size()));
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    MeasuredRow::Cell cell;
    const std::string expected = read_cell(columns[i], fields[i], cell);
    if (!expected.empty()) {
      return csv_fault(file, line, static_cast<std::size_t>(fields[i].data() - fields[0].data()) + 1,
                       fmt::format("{} must be {}, not '{}'", columns[i].name, expected, shown(fields[i])));
    }
    row.set(columns[i].name, std::move(cell));
  }
  return {};
}

Result<std::map<std::string, MeasuredRow>> read_beside(const std::string& file, const MeasuredFormat& format) {
  auto input = InputFile::open(file);
  if (!input) return input.error();
  CsvLines lines(std::move(*input));
  const std::string header = header_of(format.columns_beside);
  std::map<std::string, MeasuredRow> rows;
  for (bool is_header = true;;) {
    auto line = lines.next();
    if (!line) return line.error();
    if (!*line) return rows;
    const std::string_view text = (*line)->text;
    if (text.starts_with('#')) continue;
    if (is_header) {
      if (text != header) return csv_fault(file, (*line)->number, 1, "expected the header " + header);
      is_header = false;
      continue;
    }
    MeasuredRow row;
    if (Status read = read_measured(format.columns_beside, pieces(text, ','), file, (*line)->number, row); !read) {
      return read.error();
    }
    std::string key = row.text(format.key);
    rows.insert_or_assign(std::move(key), std::move(row));
  }
}

std::string header_of(const std::vector<MeasuredColumn>& all) {
  std::string header;
  for (const MeasuredColumn& column : all) header += (header.empty() ? "" : ",") + std::string(column.name);
  return header;
}

namespace {

const std::vector<MeasuredFormat>& formats() {
  static const std::vector<MeasuredFormat> all = [] {
    std::vector<MeasuredFormat> joined = make_row_formats();
    for (const auto& more : {make_line_formats(), make_combiner_formats(), make_stage_formats(), make_surface_formats(),
                             make_pixel_formats()}) {
      joined.insert(joined.end(), more.begin(), more.end());
    }
    return joined;
  }();
  return all;
}

}  // namespace

std::string measured_places() {
  std::string places;
  for (const MeasuredFormat& format : formats()) places += (places.empty() ? "" : ", ") + std::string(format.place);
  return places;
}

const MeasuredFormat* measured_format(std::string_view header) {
  const auto found = std::find_if(formats().begin(), formats().end(),
                                  [&](const MeasuredFormat& format) { return header_of(format.columns) == header; });
  return found == formats().end() ? nullptr : &*found;
}

}  // namespace ninebit::tools

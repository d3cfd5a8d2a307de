#include "src/tools/input/csv_lines.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/tools/input/file_kind.h"

namespace ninebit::tools {
namespace {

constexpr std::size_t kBeginning = 4096;

}  // namespace

Diagnostic table_fault(const CsvLines& lines, const Diagnostic& fault) {
  if (fault.fault != Fault::invalid_input) return fault;
  std::string message = wrong_kind(kind_of_file(lines.beginning()), FileRole::table);
  return message.empty() ? fault : Diagnostic{.message = std::move(message), .file = lines.name()};
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return text.substr(text.size());
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

Diagnostic csv_fault(const std::string& file, int line, std::size_t column, std::string message) {
  return {.message = std::move(message), .file = fmt::format("{}:{}:{}", file, line, column)};
}

Result<std::optional<std::string_view>> CsvLines::next_raw() {
  carried_.clear();
  while (true) {
    const std::size_t end = piece_.find('\n');
    const std::string_view part = piece_.substr(0, end);
    if (carried_.size() + part.size() > kLongestCsvLine) {
      return csv_fault(name(), number_ + 1, 1, fmt::format("the line is longer than {} bytes", kLongestCsvLine));
    }
    if (end != std::string_view::npos) {
      piece_.remove_prefix(end + 1);
      ++number_;
      if (carried_.empty()) return std::optional(part);
      carried_.append(part);
      return std::optional(std::string_view(carried_));
    }
    carried_.append(part);
    piece_ = {};
    if (!ended_) {
      auto more = input_.read();
      if (!more) return more.error();
      piece_ = *more;
      if (number_ == 0) beginning_ += piece_.substr(0, kBeginning - std::min(kBeginning, beginning_.size()));
      ended_ = piece_.empty();
      continue;
    }
    if (carried_.empty()) return std::optional<std::string_view>();
    ++number_;
    return std::optional(std::string_view(carried_));
  }
}

std::string shown(std::string_view field) {
  constexpr std::size_t kMost = 40;
  std::string out;
  for (const char c : field.substr(0, kMost)) out += c >= ' ' && c <= '~' ? c : '?';
  return field.size() > kMost ? out + "..." : out;
}

Result<std::optional<CsvLine>> CsvLines::next() {
  while (true) {
    auto raw = next_raw();
    if (!raw) return raw.error();
    if (!*raw) return std::optional<CsvLine>();
    std::string_view text = **raw;
    if (number_ == 1 && text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
    if (text.ends_with('\r')) text.remove_suffix(1);
    const bool blank = text.find_first_not_of(" \t") == std::string_view::npos;
    if (!blank) return std::optional(CsvLine{text, number_});
  }
}

}  // namespace ninebit::tools

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

Diagnostic csv_fault(const std::string& file, int line, std::size_t column, std::string message) {
  return {.message = std::move(message), .file = fmt::format("{}:{}:{}", file, line, column)};
}

Result<std::optional<std::string_view>> CsvLines::next_raw() {
  while (true) {
    const auto line = ended_ ? lines_.last() : lines_.next();
    if (lines_.too_long()) {
      const auto number = static_cast<int>(lines_.number() + (line ? 0 : 1));
      return csv_fault(name(), number, 1, fmt::format("the line is longer than {} bytes", kLongestCsvLine));
    }
    if (line || ended_) return line;
    auto more = input_.read();
    if (!more) return more.error();
    if (lines_.number() == 0) beginning_ += more->substr(0, kBeginning - std::min(kBeginning, beginning_.size()));
    ended_ = more->empty();
    if (!ended_) lines_.add(*more);
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
    std::string_view text = without_return(**raw);
    if (lines_.number() == 1) text = without_mark(text);
    if (!trimmed(text).empty()) return std::optional(CsvLine{text, static_cast<int>(lines_.number())});
  }
}

}  // namespace ninebit::tools

#include "src/tools/input/host.h"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <optional>

#include "src/system/process.h"

namespace ninebit::tools {
namespace {

Host* current = nullptr;

}  // namespace

Host* host() noexcept {
  return current;
}

void set_host(Host* host) noexcept {
  current = host;
}

namespace {

constexpr int kUsualColumns = 80;

// `rest`: the column of what does not fit; none: 4 more than the line's own.
void append_wrapped(std::string& out, std::string_view line, int columns, std::optional<int> column = {}) {
  if (width_of(line) <= columns) {
    out += line;
    return;
  }
  const std::size_t indent = std::min(line.find_first_not_of(' '), line.size());
  const std::string rest(column ? static_cast<std::size_t>(*column) : indent + 4, ' ');
  out += line.substr(0, indent);
  line.remove_prefix(indent);
  int at = static_cast<int>(indent);
  bool first = true;  // in its output line
  while (!line.empty()) {
    const std::size_t spaces = std::min(line.find_first_not_of(' '), line.size());
    const std::size_t end = std::min(line.find(' ', spaces), line.size());
    const std::string_view word = line.substr(spaces, end - spaces);
    if (!first && at + static_cast<int>(spaces) + width_of(word) > columns) {
      out += '\n' + rest;
      at = static_cast<int>(rest.size());
    } else {
      out += line.substr(0, spaces);
      at += static_cast<int>(spaces);
    }
    out += word;
    at += width_of(word);
    first = false;
    line.remove_prefix(end);
  }
}

}  // namespace

int terminal_columns(int standard_stream) {
  constexpr int kMost = 10000;
  const char* const given = std::getenv("COLUMNS");
  const std::string_view text = given != nullptr ? given : "";
  int columns = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), columns);
  if (error == std::errc() && end == text.data() + text.size() && columns > 0 && columns <= kMost) return columns;
  return posix::terminal_columns(standard_stream).value_or(kUsualColumns);
}

int width_of(std::string_view text) {
  return static_cast<int>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80;  // the others continue a code point
  }));
}

std::string wrapped(std::string_view text, int columns) {
  std::string out;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    append_wrapped(out, text.substr(0, end), columns);
    if (end < text.size()) out += '\n';
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return out;
}

std::string wrapped_for_terminal(std::string_view text, int rest) {
  if (!posix::is_terminal(posix::kStandardOutput) && std::getenv("COLUMNS") == nullptr) return std::string(text);
  const int columns = terminal_columns(posix::kStandardOutput);
  std::string out;
  for (; !text.empty(); text.remove_prefix(std::min(text.find('\n'), text.size() - 1) + 1)) {
    const std::string_view line = text.substr(0, text.find('\n'));
    if (line.starts_with("  ninebit ")) {
      out += line;
    } else if (line.starts_with("  ") && rest + 20 <= columns) {
      append_wrapped(out, line, columns, rest);
    } else {
      append_wrapped(out, line, columns);
    }
    if (line.size() < text.size()) out += '\n';
  }
  return out;
}

}  // namespace ninebit::tools

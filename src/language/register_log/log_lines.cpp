// Formats: xemu hw/xbox/nv2a/trace-events and pgraph.c; abaire/xbdm_gdb_bridge frame_capture.cpp; abaire/nv2apretty;
// JayFoxRox/nv2a-trace and abaire/nv2a-trace; envytools demmt/pushbuf.c.
#include <algorithm>
#include <charconv>

#include "src/language/register_log/log_layout.h"
#include "src/language/register_log/log_methods.h"
#include "src/language/source/source_faults.h"
#include "src/system/lines.h"

namespace ninebit::reglog {
namespace {

constexpr std::string_view kBlanks = " \t\n\v\f\r";

bool ends_word(char c) {
  return detail::is_blank(c) || std::string_view(",;()<>{}=|\"'").find(c) != std::string_view::npos;
}

void split_words(std::string_view line, std::vector<LogToken>& into) {
  for (std::size_t at = 0; at < line.size() && into.size() < kMostTokens;) {
    const char c = line[at];
    const bool opens_tag = c == '<' && at + 1 < line.size() && (line[at + 1] == '/' || detail::is_letter(line[at + 1]));
    if (opens_tag) {
      const std::size_t end = line.find('>', at);
      if (end != std::string_view::npos) {
        at = end + 1;
        continue;
      }
    }
    if (ends_word(c)) {
      ++at;
      continue;
    }
    std::size_t end = at;
    while (end < line.size() && !ends_word(line[end])) ++end;
    std::string_view word = line.substr(at, end - at);
    while (word.size() > 1 && word.back() == ':') word.remove_suffix(1);
    into.push_back({word, 1 + static_cast<int>(at)});
    at = end;
  }
}

void split_fields(std::string_view line, char separator, std::vector<LogToken>& into) {
  for (std::size_t at = 0; at <= line.size() && into.size() < kMostTokens;) {
    std::size_t start = at;
    while (start < line.size() && line[start] == ' ') ++start;
    const bool quoted = start < line.size() && line[start] == '"';
    const std::size_t close = quoted ? std::min(line.find('"', start + 1), line.size()) : at;
    const std::size_t end = std::min(line.find(separator, close), line.size());
    if (quoted) {
      into.push_back({trimmed(line.substr(start + 1, close - start - 1), kBlanks), 2 + static_cast<int>(start)});
    } else {
      const std::string_view field = trimmed(line.substr(at, end - at), kBlanks);
      const std::size_t begin = field.empty() ? at : static_cast<std::size_t>(field.data() - line.data());
      into.push_back({field, 1 + static_cast<int>(begin)});
    }
    at = end + 1;
  }
}

}  // namespace

void split_line(std::string_view line, char separator, std::vector<LogToken>& into) {
  into.clear();
  if (separator == 0) {
    split_words(line, into);
  } else {
    split_fields(line, separator, into);
  }
}

bool has_hex_prefix(std::string_view token) {
  return token.size() > 2 && token[0] == '0' && (token[1] == 'x' || token[1] == 'X');
}

bool is_hex_digits(std::string_view token) {
  return !token.empty() && std::all_of(token.begin(), token.end(), detail::is_hex_digit);
}

std::optional<std::uint32_t> number_in(std::string_view token, bool hexadecimal) {
  int base = hexadecimal ? 16 : 10;
  if (has_hex_prefix(token)) {
    token.remove_prefix(2);
    base = 16;
  }
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(token.data(), token.data() + token.size(), value, base);
  if (token.empty() || error != std::errc{} || end != token.data() + token.size()) return std::nullopt;
  return value;
}

bool is_log_name(std::string_view token) {
  return !token.empty() && detail::is_letter(token.front()) &&
         std::all_of(token.begin(), token.end(), [](char c) { return detail::is_word(c) || c == '[' || c == ']'; });
}

namespace {

// A number with 0x in a text, and where it ends.
struct FoundNumber {
  std::optional<std::uint32_t> value{};
  std::size_t begin = 0, end = 0;
};

// The first number with 0x at or after an offset that does not continue a word; no value if there is none.
FoundNumber hex_number_after(std::string_view text, std::size_t from) {
  for (std::size_t at = from; (at = text.find("0x", at)) != std::string_view::npos; at += 2) {
    if (at > 0 && detail::is_word(text[at - 1])) continue;
    std::size_t end = at + 2;
    while (end < text.size() && detail::is_word(text[end])) ++end;
    return {number_in(text.substr(at, end - at), true), at, end};
  }
  return {std::nullopt, text.size(), text.size()};
}

// "* 11" after a name: equal writes that are not listed. Xemu counts from 0.
std::optional<std::uint32_t> repetitions(std::string_view rest) {
  const std::size_t star = rest.rfind(" * ");
  if (star == std::string_view::npos) return std::nullopt;
  std::string_view digits = rest.substr(star + 3);
  while (!digits.empty() && detail::is_blank(digits.back())) digits.remove_suffix(1);
  const auto count = number_in(digits, false);
  constexpr std::uint32_t kMost = 0x7fffffff;
  return count && *count < kMost ? std::optional(*count + 1) : std::nullopt;
}

// CLASS -> METHOD NAME DATA, after the word "method".
std::optional<LogWrite> read_arrow(std::string_view line) {
  const std::size_t arrow = line.find("->");
  if (arrow == std::string_view::npos) return std::nullopt;
  const std::string_view before = line.substr(0, arrow);
  if (before.find("method") == std::string_view::npos) return std::nullopt;
  std::size_t last = before.rfind("0x");
  if (last == std::string_view::npos) return std::nullopt;
  const FoundNumber object = hex_number_after(before, last);
  const FoundNumber method = hex_number_after(line, arrow + 2);
  if (!object.value || !method.value) return std::nullopt;
  LogWrite write;
  write.method = *method.value;
  write.object_class = object.value;
  write.column = 1 + static_cast<int>(method.begin);
  const std::string_view rest = line.substr(method.end);
  if (before.find("_abbrev") != std::string_view::npos) {
    const auto count = repetitions(rest);
    if (!count) return std::nullopt;
    write.count = *count;
    write.data = 0;  // indices, which only their number matters of
    return write;
  }
  write.data = hex_number_after(rest, 0).value;
  return write;
}

// The value of NAME="…" in a line.
std::optional<std::uint32_t> attribute(std::string_view line, std::string_view name) {
  const std::size_t at = line.find(name);
  return at == std::string_view::npos ? std::nullopt : hex_number_after(line, at + name.size()).value;
}

std::optional<LogWrite> read_command(std::string_view line) {
  if (line.find("<command ") == std::string_view::npos) return std::nullopt;
  const auto method = attribute(line, " op=\"");
  if (!method) return std::nullopt;
  LogWrite write;
  write.method = *method;
  write.object_class = attribute(line, " class=\"");
  write.data = attribute(line, " value=\"");
  write.column = 1 + static_cast<int>(line.find(" op=\"") + 5);
  return write;
}

// "PB: DATA   OBJECT.METHOD = MEANING"; the data stand first, because the meaning may be in words.
std::optional<LogWrite> read_demmt(std::string_view line) {
  const std::size_t start = line.find("PB: 0x");
  if (start == std::string_view::npos) return std::nullopt;
  const FoundNumber data = hex_number_after(line, start);
  std::size_t at = std::min(line.find_first_not_of(' ', data.end), line.size());
  const std::size_t begin = at;
  while (at < line.size() && detail::is_word(line[at])) ++at;
  const std::string_view object = line.substr(begin, at - begin);
  if (object.empty() || at >= line.size() || line[at] != '.') return std::nullopt;
  const std::size_t end = line.find(" = ", at);
  if (end == std::string_view::npos || !data.value) return std::nullopt;
  LogWrite write;
  write.data = data.value;
  write.column = 2 + static_cast<int>(at);
  write.name = line.substr(at + 1, end - at - 1);
  const bool kelvin = object == "NV20_3D" || object == "NV25_3D" || object == "OBJ97" || object == "OBJ597";
  const bool celsius = object == "NV10_3D" || object == "NV11_3D" || object == "NV15_3D" || object == "NV17_3D" ||
                       object == "OBJ56" || object == "OBJ96" || object == "OBJ98" || object == "OBJ99";
  write.foreign = !kelvin && !celsius;
  write.object_class = kelvin ? 0x97 : celsius ? 0x56 : 0;
  if (const auto number = number_in(write.name, false); number && has_hex_prefix(write.name)) {
    write.method = *number;
    write.name = {};
  }
  return write;
}

}  // namespace

std::optional<LogWrite> read_known_line(std::string_view line) {
  if (auto write = read_arrow(line)) return write;
  if (auto write = read_command(line)) return write;
  return read_demmt(line);
}

}  // namespace ninebit::reglog

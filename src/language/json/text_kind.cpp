#include "src/language/json/text_kind.h"

#include <algorithm>
#include <cctype>
#include <cstddef>

#include "src/system/lines.h"

namespace ninebit {
std::string_view without_space(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  return text;
}

std::string_view without_heading(std::string_view text) {
  text = without_mark(text);
  while (true) {
    text = without_space(text);
    if (text.starts_with("/*")) {
      const std::size_t end = text.find("*/", 2);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 2);
    } else if (text.starts_with("//") || text.starts_with('#')) {
      text.remove_prefix(std::min(text.find('\n'), text.size()));
    } else {
      return text;
    }
  }
}

bool is_json(std::string_view text) {
  if (!text.starts_with('{') && !text.starts_with('[')) return false;
  const std::string_view inside = without_space(text.substr(1));
  if (inside.empty() || inside.front() == '"') return true;
  if (text.front() == '{') {
    // A key without quotes is a fault of JSON.
    const auto is_name = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '\''; };
    const auto key = static_cast<std::size_t>(std::find_if_not(inside.begin(), inside.end(), is_name) - inside.begin());
    const bool has_key = key > 0 && without_space(inside.substr(key)).starts_with(':');
    return inside.front() == '}' || has_key;
  }
  if (inside.front() == '[' || inside.front() == '{') return true;
  const std::string_view values = inside.substr(0, inside.find(']'));
  const auto is_plain = [](unsigned char c) {
    return std::isdigit(c) != 0 || std::isspace(c) != 0 ||
           std::string_view("+-.,eE").find(static_cast<char>(c)) != std::string_view::npos;
  };
  const bool plain = std::all_of(values.begin(), values.end(), is_plain);
  return plain && (values.size() == inside.size() || without_space(inside.substr(values.size() + 1)).empty());
}

bool is_assignment(std::string_view text) {
  const auto skip_name = [&](std::size_t i) {
    while (i < text.size() && (std::isalnum(static_cast<unsigned char>(text[i])) != 0 || text[i] == '_')) ++i;
    return i;
  };
  std::size_t i = skip_name(0);
  if (i == 0) return false;
  if (i < text.size() && (text[i] == '[' || text[i] == '(')) {
    const char close = text[i] == '[' ? ']' : ')';
    i = skip_name(i + 1);
    if (i == text.size() || text[i++] != close) return false;
  }
  text = without_space(text.substr(i));
  if (!text.starts_with('=')) return false;
  text = without_space(text.substr(1));
  return text.empty() || std::isdigit(static_cast<unsigned char>(text.front())) != 0;
}

std::optional<std::string> without_line_prefixes(std::string_view text) {
  if (!without_space(text).starts_with('[') || is_json(without_space(text))) return std::nullopt;
  std::string out(text);
  bool has_content = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string_view line = text.substr(begin, end - begin), content = without_space(line);
    const std::size_t close = content.find_first_of("[]\"{}", 1);
    if (!content.empty()) {
      if (!content.starts_with('[') || close <= 1 || close == std::string_view::npos || content[close] != ']')
        return {};
      const std::string_view behind = content.substr(close + 1);
      if (!behind.empty() && without_space(behind).size() == behind.size()) return {};
      has_content = has_content || !without_space(behind).empty();
      std::fill_n(out.begin() + static_cast<std::ptrdiff_t>(end - content.size()), close + 1, ' ');
    }
    begin = end + 1;
  }
  return has_content ? std::optional(std::move(out)) : std::nullopt;
}

std::string_view json_kind(std::string_view text) {
  constexpr std::string_view kKey = "\"ninebit\"";
  const std::size_t key = text.find(kKey);
  if (key == std::string_view::npos) return {};
  std::string_view rest = without_space(text.substr(key + kKey.size()));
  if (rest.starts_with(':')) rest = without_space(rest.substr(1));
  if (!rest.starts_with('"')) return "?";
  rest.remove_prefix(1);
  return rest.substr(0, rest.find('"'));
}

}  // namespace ninebit

#include "src/study/report/report_text.h"

#include <fmt/format.h>

#include <cstddef>
#include <variant>

namespace ninebit {

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  }
  return out;
}

std::string readable(const StudyValue& value) {
  if (const auto* real = std::get_if<double>(&value)) return fmt::format("{:.6g}", *real);
  std::string text = text_of(value);
  const std::size_t first = text.starts_with('-') ? 1 : 0;
  if (text.size() - first <= 4) return text;
  for (std::size_t end = text.size(); end > first + 3; end -= 3) text.insert(end - 3, "\u202f");
  return text;
}

}  // namespace ninebit

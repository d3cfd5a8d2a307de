#include "ninebit/language/source_text.h"

#include <algorithm>

namespace ninebit {

std::string TextFault::text() const {
  std::string out = file;
  if (!out.empty()) out += ':';
  out += std::to_string(line);
  out += ':';
  out += std::to_string(column);
  out += ": ";
  if (gl_error != GlError::no_error) {
    out += name_of(gl_error);
    out += ": ";
  }
  out += message;
  return out;
}

std::string ParseError::text() const {
  std::string out;
  for (const TextFault& fault : faults) out += (out.empty() ? "" : "\n") + fault.text();
  return out;
}

TextPlace SourceText::place(std::size_t offset) const {
  const TextPlace inside = place_of(written.empty() ? text : written, offset);
  return {begin.line + inside.line - 1, inside.line == 1 ? begin.column + inside.column - 1 : inside.column};
}

TextPlace place_of(std::string_view text, std::size_t offset) {
  const std::string_view before = text.substr(0, offset);
  const std::size_t start = before.rfind('\n') + 1;  // npos + 1 is the text's beginning
  return {1 + static_cast<int>(std::count(before.begin(), before.end(), '\n')),
          1 + static_cast<int>(before.size() - start)};
}

}  // namespace ninebit

#include "src/language/source/source_faults.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

#include "ninebit/language/source_text.h"
#include "src/system/quoting.h"

namespace ninebit::detail {

void SourceFaults::add(std::size_t offset, std::string message, GlError gl_error) {
  if (!full()) found_.push_back({offset, std::move(message), gl_error});
}

void SourceFaults::add(TextFault fault) {
  if (!full()) placed_.push_back(std::move(fault));
}

std::vector<TextFault> SourceFaults::take() {
  std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) { return a.offset < b.offset; });
  std::vector<TextFault> faults;
  const std::string_view written = source_.written.empty() ? source_.text : source_.written;
  TextPlace place = source_.begin;
  std::size_t from = 0;
  for (Found& found : found_) {
    place = SourceText{written.substr(from), {}, {}, place}.place(found.offset - from);
    from = found.offset;
    faults.push_back({std::string(source_.file), place.line, place.column, std::move(found.message), found.gl_error});
  }
  found_.clear();
  if (placed_.empty()) return faults;
  faults.insert(faults.end(), std::make_move_iterator(placed_.begin()), std::make_move_iterator(placed_.end()));
  placed_.clear();
  std::stable_sort(faults.begin(), faults.end(), [](const TextFault& a, const TextFault& b) {
    return std::tie(a.line, a.column) < std::tie(b.line, b.column);
  });
  return faults;
}

bool too_long(const SourceText& source, SourceFaults& faults) {
  if (source.text.size() <= kMaxSourceBytes) return false;
  faults.add(0, "the text has " + std::to_string(source.text.size()) + " bytes; the limit is " +
                    std::to_string(kMaxSourceBytes));
  return true;
}

std::string quoted(std::string_view text) {
  return quoted_briefly(text, '\'', 40);
}

std::string not_needed(const Definition& definition) {
  return "the definition of " + quoted(definition.name) + " was not needed";
}

bool skip_blanks(std::string_view text, std::size_t& at, const Blanks& blanks, SourceFaults& faults) {
  while (at < text.size()) {
    const char c = text[at], after_slash = c == '/' && at + 1 < text.size() ? text[at + 1] : ' ';
    if (is_blank(c)) {
      ++at;
    } else if (!blanks.heading.empty() && c == blanks.heading.front() && text.substr(at).starts_with(blanks.heading)) {
      at += blanks.heading.size();
    } else if (after_slash == '/' || (blanks.hash_comments && c == '#')) {
      at = std::min(text.find('\n', at), text.size());
    } else if (after_slash == '*') {
      const std::size_t end = text.find("*/", at + 2);
      if (end == std::string_view::npos) {
        faults.add(at, "unterminated comment; expected */");
        at = text.size();
        return false;
      }
      at = end + 2;
    } else {
      return true;
    }
  }
  return true;
}

}  // namespace ninebit::detail

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

std::vector<TextFault> TextFaults::take() {
  std::stable_sort(faults_.begin(), faults_.end(), [](const TextFault& left, const TextFault& right) {
    return std::tie(left.line, left.column) < std::tie(right.line, right.column);
  });
  return std::exchange(faults_, {});
}

bool too_long(std::string_view text, TextFaults& faults) {
  if (text.size() <= kMaxSourceBytes) return false;
  faults.add({},
             "the text has " + std::to_string(text.size()) + " bytes; the limit is " + std::to_string(kMaxSourceBytes));
  return true;
}

}  // namespace ninebit

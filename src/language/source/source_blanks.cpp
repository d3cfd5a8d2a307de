#include "src/language/source/source_blanks.h"

#include <algorithm>

namespace ninebit::detail {

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

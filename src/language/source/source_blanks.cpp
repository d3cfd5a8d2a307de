#include "src/language/source/source_blanks.h"

#include <algorithm>

namespace ninebit::detail {

bool skip_blanks(std::string_view text, std::size_t& at, const Blanks& blanks, SourceFaults& faults) {
  while (at < text.size()) {
    const std::string_view rest = text.substr(at);
    if (is_blank(rest.front())) {
      ++at;
    } else if (!blanks.heading.empty() && rest.starts_with(blanks.heading)) {
      at += blanks.heading.size();
    } else if (rest.starts_with("//") || (blanks.hash_comments && rest.front() == '#')) {
      at = std::min(text.find('\n', at), text.size());
    } else if (rest.starts_with("/*")) {
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

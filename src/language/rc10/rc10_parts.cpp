#include "src/language/rc10/rc10_parts.h"

#include <algorithm>
#include <vector>

#include "src/language/rc10/rc10_lexer.h"
#include "src/language/source/foreign_language.h"

namespace ninebit::detail {
namespace {

// The offsets of "!!" and a letter outside of comments.
std::vector<std::size_t> headers_in(std::string_view text) {
  std::vector<std::size_t> found;
  SourceFaults unterminated({text, {}});  // the parser reports that, too
  std::size_t at = 0;
  while (skip_blanks(text, at, {.hash_comments = true, .heading = {}}, unterminated) && at < text.size()) {
    const bool is_header = text.substr(at).starts_with("!!") && at + 2 < text.size() && is_word(text[at + 2]);
    if (is_header) found.push_back(at);
    at += is_header ? 2 : 1;
  }
  return found;
}

std::string_view header_at(std::string_view text) {
  constexpr std::size_t kLongest = 24;
  text = text.substr(0, kLongest);
  const auto is_header = [](char c) { return is_word(c) || c == '.' || c == '!'; };
  return text.substr(0, static_cast<std::size_t>(std::find_if_not(text.begin(), text.end(), is_header) - text.begin()));
}

}  // namespace

std::optional<std::string> only_rc10(std::string_view text, SourceFaults& faults, SourceFaults& notes) {
  const std::vector<std::size_t> headers = headers_in(text);
  const auto is_rc10 = [&](std::size_t at) { return text.substr(at).starts_with(kRc10Header); };
  if (headers.empty() || std::all_of(headers.begin(), headers.end(), is_rc10)) return std::nullopt;
  std::string kept(text);
  for (std::size_t i = 0; i < headers.size() && !faults.full(); ++i) {
    if (is_rc10(headers[i])) continue;
    const std::size_t end = i + 1 < headers.size() ? headers[i + 1] : text.size();
    const std::string_view header = header_at(text.substr(headers[i]));
    const std::string_view language = language_of_header(header);
    if (language.empty()) {
      faults.add(headers[i], "unknown part " + quoted(header) + "; expected !!RC1.0 or !!TS1.0");
    } else {
      notes.add(headers[i],
                "skipped " + std::string(language) + " (" + std::string(header) + "): it is not for combiners");
    }
    const auto first = kept.begin() + static_cast<std::ptrdiff_t>(headers[i]);
    std::replace_if(
        first, kept.begin() + static_cast<std::ptrdiff_t>(end), [](char c) { return c != '\n'; }, ' ');
  }
  return kept;
}

}  // namespace ninebit::detail

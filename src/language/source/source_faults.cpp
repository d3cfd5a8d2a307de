#include "src/language/source/source_faults.h"

#include <algorithm>
#include <utility>

namespace ninebit::detail {

void SourceFaults::add(std::size_t offset, std::string message, GlError gl_error) {
  if (!full()) found_.push_back({offset, std::move(message), gl_error});
}

std::vector<TextFault> SourceFaults::take() {
  std::stable_sort(found_.begin(), found_.end(), [](const Found& a, const Found& b) { return a.offset < b.offset; });
  std::vector<TextFault> faults;
  TextPlace place;
  std::size_t from = 0;
  for (Found& found : found_) {
    const TextPlace step = place_of(source_.text.substr(from), found.offset - from);
    place = {place.line + step.line - 1, step.line == 1 ? place.column + step.column - 1 : step.column};
    from = found.offset;
    faults.push_back({std::string(source_.file), place.line, place.column, std::move(found.message), found.gl_error});
  }
  found_.clear();
  return faults;
}

bool too_long(const SourceText& source, SourceFaults& faults) {
  if (source.text.size() <= kMaxSourceBytes) return false;
  faults.add(0, "the text has " + std::to_string(source.text.size()) + " bytes; the limit is " +
                    std::to_string(kMaxSourceBytes));
  return true;
}

std::string quoted(std::string_view text) {
  constexpr std::size_t kLongest = 40;
  constexpr char kHex[] = "0123456789abcdef";
  std::string out = "'";
  for (const char c : text.substr(0, kLongest)) {
    if (c >= ' ' && c <= '~') {
      out += c;
      continue;
    }
    const auto byte = static_cast<unsigned char>(c);
    out += "\\x";
    out += kHex[byte >> 4];
    out += kHex[byte & 15];
  }
  if (text.size() > kLongest) out += "…";
  return out + "'";
}

}  // namespace ninebit::detail

#include "src/language/source/source_faults.h"

#include <algorithm>
#include <iterator>
#include <tuple>
#include <utility>

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

std::string not_needed(const Definition& definition) {
  return "the definition of " + quoted(definition.name) + " was not needed";
}

}  // namespace ninebit::detail

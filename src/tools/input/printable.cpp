#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

std::string made_printable(std::string_view text, bool lines) {
  std::string out;
  while (!text.empty()) {
    const PrintablePiece piece = first_printable_piece(text, lines);
    out += text.substr(0, piece.plain);
    for (const char byte : text.substr(piece.plain, piece.foreign)) {
      const EscapedByte instead = escaped(byte);
      out.append(instead.text, instead.size);
    }
    text.remove_prefix(piece.plain + piece.foreign);
  }
  return out;
}

}  // namespace

std::string printable(std::string_view text) {
  return made_printable(text, false);
}

std::string printable_briefly(std::string_view text) {
  constexpr std::size_t kMost = 2'000, kFirstPart = 1'200;
  const std::string all = printable(text);
  if (all.size() <= kMost) return all;
  const auto is_inside_character = [&](std::size_t i) { return (static_cast<unsigned char>(all[i]) & 0xC0U) == 0x80U; };
  std::size_t begin = kFirstPart, end = all.size() - (kMost - kFirstPart);
  while (is_inside_character(begin)) --begin;
  while (end < all.size() && is_inside_character(end)) ++end;
  return all.substr(0, begin) + " … " + all.substr(end);
}

std::string printable_lines(std::string_view text) {
  return made_printable(text, true);
}

}  // namespace ninebit::tools

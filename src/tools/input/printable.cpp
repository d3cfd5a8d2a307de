#include "src/tools/input/printable.h"

#include <algorithm>
#include <cstdint>

namespace ninebit::tools {
namespace {

struct Character {
  std::uint32_t code = 0;
  std::size_t size = 0;  // bytes; 0: not UTF-8
};

Character character_at(std::string_view text) noexcept {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const unsigned lead = byte(0);
  if (lead < 0x80) return {lead, 1};
  const std::size_t size = lead >= 0xF0 ? 4 : lead >= 0xE0 ? 3 : 2;
  if (lead < 0xC2 || lead > 0xF4 || text.size() < size) return {};
  std::uint32_t code = lead & (0x7FU >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return {};
    code = code << 6 | (byte(i) & 0x3FU);
  }
  constexpr std::uint32_t kLeast[] = {0, 0, 0x80, 0x800, 0x10000};
  const bool surrogate = code >= 0xD800 && code <= 0xDFFF;
  if (code < kLeast[size] || code > 0x10FFFF || surrogate) return {};
  return {code, size};
}

bool must_not_reach_a_terminal(std::uint32_t code) noexcept {
  const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  const bool separator = code == 0x2028 || code == 0x2029;
  const bool direction = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) || code == 0x200E ||
                         code == 0x200F || code == 0x61C;
  return control || separator || direction;
}

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

PrintablePiece first_printable_piece(std::string_view text, bool lines) noexcept {
  PrintablePiece piece;
  while (piece.plain < text.size()) {
    const Character c = character_at(text.substr(piece.plain));
    const bool kept = lines && (c.code == '\n' || c.code == '\t');
    if (c.size == 0 || (must_not_reach_a_terminal(c.code) && !kept)) {
      piece.foreign = std::max<std::size_t>(c.size, 1);
      break;
    }
    piece.plain += c.size;
  }
  return piece;
}

EscapedByte escaped(char byte) noexcept {
  constexpr char kHex[] = "0123456789abcdef";
  if (byte == '\n') return {{'\\', 'n'}, 2};
  if (byte == '\t') return {{'\\', 't'}, 2};
  const auto code = static_cast<unsigned char>(byte);
  return {{'\\', 'x', kHex[code >> 4], kHex[code & 15]}, 4};
}

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

// Foreign text in messages, on terminals, in commands and in markup: which bytes are shown as they are, and how the
// others are escaped.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace ninebit {

// One character of a text.
struct Character {
  std::uint32_t code = 0;
  std::size_t size = 0;  // bytes; 0: not UTF-8
};

[[nodiscard]] inline Character character_at(std::string_view text) noexcept {
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

[[nodiscard]] inline bool must_not_reach_a_terminal(std::uint32_t code) noexcept {
  const bool control = code < 0x20 || (code >= 0x7F && code < 0xA0);
  const bool separator = code == 0x2028 || code == 0x2029;
  const bool direction = (code >= 0x202A && code <= 0x202E) || (code >= 0x2066 && code <= 0x2069) || code == 0x200E ||
                         code == 0x200F || code == 0x61C;
  return control || separator || direction;
}

// The number of bytes at the start of `text` that may go to a terminal, and of the bytes after them that must be
// escaped; both 0 if the text is empty. Control characters, invalid UTF-8 and characters that change the direction of a
// line are escaped; with `lines`, '\n' and '\t' are not.
struct PrintablePiece {
  std::size_t plain = 0;
  std::size_t foreign = 0;
};
[[nodiscard]] inline PrintablePiece first_printable_piece(std::string_view text, bool lines) noexcept {
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

// The escape of one byte: "\n", "\t", "\x1b".
struct EscapedByte {
  char text[4];
  std::size_t size;
};
[[nodiscard]] inline EscapedByte escaped(char byte) noexcept {
  constexpr char kHex[] = "0123456789abcdef";
  if (byte == '\n') return {{'\\', 'n'}, 2};
  if (byte == '\t') return {{'\\', 't'}, 2};
  const auto code = static_cast<unsigned char>(byte);
  return {{'\\', 'x', kHex[code >> 4], kHex[code & 15]}, 4};
}

// A name between quotation marks for a message: printable characters as they are, the others escaped, and at most
// `longest` bytes of it.
[[nodiscard]] inline std::string quoted_briefly(std::string_view text, char mark, std::size_t longest) {
  std::string out(1, mark);
  std::string_view rest = text;
  while (!rest.empty()) {
    const Character c = character_at(rest);
    const std::size_t size = std::max<std::size_t>(c.size, 1);
    if (text.size() - rest.size() + size > longest) break;
    const bool plain = c.size != 0 && !must_not_reach_a_terminal(c.code);
    for (const char byte : rest.substr(0, size)) {
      const EscapedByte instead = escaped(byte);
      out.append(plain ? &byte : instead.text, plain ? 1 : instead.size);
    }
    rest.remove_prefix(size);
  }
  return out + (rest.empty() ? "" : "…") + mark;
}

// A word of a command that a user may copy into a shell, in quotes if a shell would change it.
[[nodiscard]] inline std::string shell_word(std::string_view word) {
  constexpr std::string_view kPlain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=.,:/@%";
  if (!word.empty() && word.find_first_not_of(kPlain) == std::string_view::npos) return std::string(word);
  std::string text = "'";
  for (const char c : word) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

// The text between tags, or in an attribute between double quotes; with `apostrophes`, between single ones, too.
[[nodiscard]] inline std::string escaped_markup(std::string_view text, bool apostrophes = false) {
  std::string out;
  for (const char c : text) {
    const std::string_view reference = c == '&'                   ? "&amp;"
                                       : c == '<'                 ? "&lt;"
                                       : c == '>'                 ? "&gt;"
                                       : c == '"'                 ? "&quot;"
                                       : c == '\'' && apostrophes ? "&#39;"
                                                                  : "";
    if (reference.empty()) {
      out += c;
    } else {
      out += reference;
    }
  }
  return out;
}

// JSON text as the content of a script element: `<` is escaped, so that no name can end the element.
[[nodiscard]] inline std::string script_json(std::string_view json) {
  std::string out;
  for (const char c : json) {
    if (c == '<') {
      out += "\\u003c";  // in JSON, '<' occurs only in strings
    } else {
      out += c;
    }
  }
  return out;
}

}  // namespace ninebit

// Makes foreign text safe for a terminal: names of files and objects, bytes of files, messages of libraries.
#pragma once

#include <string>
#include <string_view>

namespace ninebit::tools {

// The number of bytes at the start of `text` that may go to a terminal, and of the bytes after them that must be
// escaped; both 0 if the text is empty. Control characters, invalid UTF-8 and characters that change the direction of a
// line are escaped; with `lines`, '\n' and '\t' are not.
struct PrintablePiece {
  std::size_t plain = 0;
  std::size_t foreign = 0;
};
[[nodiscard]] PrintablePiece first_printable_piece(std::string_view text, bool lines) noexcept;

// The escape of one byte: "\n", "\t", "\x1b".
struct EscapedByte {
  char text[4];
  std::size_t size;
};
[[nodiscard]] EscapedByte escaped(char byte) noexcept;

// The text on one line, for messages and for cells of tables. Backslashes are not escaped, so two different names can
// look the same: for people only.
[[nodiscard]] std::string printable(std::string_view text);

// The same, but a text of more than 2,000 bytes loses its middle: a message starts with its file and ends with its
// reason, and may quote a name of any length between them.
[[nodiscard]] std::string printable_briefly(std::string_view text);

// The same as printable() for a text of several lines; line breaks and tabs stay.
[[nodiscard]] std::string printable_lines(std::string_view text);

}  // namespace ninebit::tools

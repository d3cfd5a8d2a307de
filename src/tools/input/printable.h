// Foreign text made fit for a terminal: names of files and objects, bytes of files, messages of libraries.
#pragma once

#include <string>
#include <string_view>

namespace ninebit::tools {

// What a terminal may be given as it is, at the beginning of `text`, and how many bytes then must not reach it. Both 0:
// the text is empty. Control characters, what is not UTF-8, and characters that reverse the direction of a line must
// not; with `lines`, '\n' and '\t' may.
struct PrintablePiece {
  std::size_t plain = 0;
  std::size_t foreign = 0;
};
[[nodiscard]] PrintablePiece first_printable_piece(std::string_view text, bool lines) noexcept;

// One byte as it is written instead: "\n", "\t", "\x1b".
struct EscapedByte {
  char text[4];
  std::size_t size;
};
[[nodiscard]] EscapedByte escaped(char byte) noexcept;

// The text on one line, for messages and for cells of tables. A backslash stays one, so this is for people: two names
// may look alike.
[[nodiscard]] std::string printable(std::string_view text);

// The same, without the middle of what has more than 2,000 bytes: a message begins with its file and ends with its
// reason, and may quote a name of any length between them.
[[nodiscard]] std::string printable_briefly(std::string_view text);

// The same as printable() for a text of several lines, whose breaks stay.
[[nodiscard]] std::string printable_lines(std::string_view text);

}  // namespace ninebit::tools

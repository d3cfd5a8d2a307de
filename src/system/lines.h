// Reads lines: of a text, and of a file that arrives in pieces. Models' files, where \r alone ends a line as well, have
// scene/files/text_scan.h.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace ninebit {

inline constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";  // a text may begin with it

// The bytes of the mark that the text begins with, 3 or 0.
[[nodiscard]] inline std::size_t mark_size(std::string_view text) {
  return text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
}

[[nodiscard]] inline std::string_view without_mark(std::string_view text) {
  return text.substr(mark_size(text));
}

// The line without a \r at its end.
[[nodiscard]] inline std::string_view without_return(std::string_view line) {
  if (line.ends_with('\r')) line.remove_suffix(1);
  return line;
}

// Takes the first line off the text and returns it without its end: \n, \r\n, or a \r that ends the text. An empty
// text has no lines.
inline std::string_view take_line(std::string_view& text) {
  const std::string_view line = text.substr(0, text.find('\n'));
  text.remove_prefix(std::min(line.size() + 1, text.size()));
  return without_return(line);
}

// The text without `blanks` at both ends.
[[nodiscard]] inline std::string_view trimmed(std::string_view text, std::string_view blanks = " \t") {
  const std::size_t first = text.find_first_not_of(blanks);
  if (first == std::string_view::npos) return text.substr(text.size());
  return text.substr(first, text.find_last_not_of(blanks) - first + 1);
}

// The lines of a text that arrives in pieces, in constant memory. A line is a view of its piece, or is gathered where
// pieces cut it.
class LinePieces {
 public:
  explicit LinePieces(std::size_t longest) : longest_(longest) {}

  // Call it once next() has nothing more; the piece must stay valid until then.
  void add(std::string_view piece) { piece_ = piece; }

  // The next line that has its end, without \n but with a \r before it; valid until the next call. Empty where the line
  // is longer than `longest`.
  [[nodiscard]] std::optional<std::string_view> next() {
    if (ended_) begin_line();
    const std::size_t end = piece_.find('\n');
    const std::string_view part = piece_.substr(0, end);
    ended_ = end != std::string_view::npos;
    piece_.remove_prefix(ended_ ? end + 1 : piece_.size());
    too_long_ = too_long_ || begun_.size() + part.size() > longest_;
    if (too_long_) begun_.clear();
    if (ended_) ++number_;
    if (ended_ && begun_.empty()) return too_long_ ? std::string_view() : part;
    if (!too_long_) begun_ += part;
    return ended_ ? std::optional<std::string_view>(begun_) : std::nullopt;
  }

  // After the last piece: the line that has no end; nothing where the text ends with one, or is empty.
  [[nodiscard]] std::optional<std::string_view> last() {
    if (ended_ || (begun_.empty() && !too_long_)) return std::nullopt;
    ended_ = true;
    ++number_;
    return begun_;
  }

  // Whether the line that was returned, or else the one that has begun, is longer than `longest`.
  [[nodiscard]] bool too_long() const { return too_long_; }
  // Counts the lines that were returned: the number of the last one, from 1.
  [[nodiscard]] std::uint64_t number() const { return number_; }

 private:
  void begin_line() {
    begun_.clear();
    ended_ = too_long_ = false;
  }

  std::size_t longest_;
  std::string_view piece_;  // the rest of the last one
  std::string begun_;       // of the current line, from earlier pieces
  std::uint64_t number_ = 0;
  bool ended_ = false;  // the current line was returned
  bool too_long_ = false;
};

}  // namespace ninebit

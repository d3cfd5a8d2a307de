// Shared by the hand-written parsers: faults collected by their place, and text quoted for messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/source_text.h"

namespace ninebit::detail {

// Collects faults by byte offset; faults beyond kMaxTextFaults are dropped.
class SourceFaults {
 public:
  explicit SourceFaults(const SourceText& source) : source_(source) {}

  void add(std::size_t offset, std::string message, GlError gl_error = GlError::no_error);
  // Adds a fault of another reader, which has its place.
  void add(TextFault fault);
  [[nodiscard]] std::size_t count() const { return found_.size() + placed_.size(); }
  [[nodiscard]] bool empty() const { return count() == 0; }
  [[nodiscard]] bool full() const { return count() >= kMaxTextFaults; }

  // Returns all faults in the order of the text, with lines and columns, in one pass over the text.
  [[nodiscard]] std::vector<TextFault> take();

 private:
  struct Found {
    std::size_t offset;
    std::string message;
    GlError gl_error;
  };
  SourceText source_;
  std::vector<Found> found_;
  std::vector<TextFault> placed_;
};

// Adds a fault and returns true if the text is longer than kMaxSourceBytes.
[[nodiscard]] bool too_long(const SourceText& source, SourceFaults& faults);

// The beginning of the text in single quotes, with bytes that are not printable ASCII as \xNN.
[[nodiscard]] std::string quoted(std::string_view text);

// The note about a definition that a text did not use.
[[nodiscard]] std::string not_needed(const Definition& definition);

[[nodiscard]] constexpr bool is_digit(char c) {
  return c >= '0' && c <= '9';
}
// Whether a character belongs to a name, in any locale: A to Z, a to z, 0 to 9, underscore.
[[nodiscard]] constexpr bool is_word(char c) {
  return is_digit(c) || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_';
}
[[nodiscard]] constexpr bool is_blank(char c) {
  return c == ' ' || (c >= '\t' && c <= '\r');
}

}  // namespace ninebit::detail

// Shared by the hand-written parsers: faults collected by their place, and text quoted for messages.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/language/source_text.h"
#include "src/system/characters.h"

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

// The beginning of the text in single quotes, with bytes that are not printable UTF-8 as \xNN.
[[nodiscard]] std::string quoted(std::string_view text);

// The note about a definition that a text did not use.
[[nodiscard]] std::string not_needed(const Definition& definition);

// Skips white space and comments between two tokens, for the hand-written lexers.

// White space and the comments of C and C++ are always skipped. A language may also have these.
struct Blanks {
  bool hash_comments = false;  // from # to the end of the line
  std::string_view heading{};  // a word that is skipped like white space
};

// Moves `at` to the next token or the end of the text. An unterminated comment is a fault and ends the text; the result
// is then false.
[[nodiscard]] bool skip_blanks(std::string_view text, std::size_t& at, const Blanks& blanks, SourceFaults& faults);

}  // namespace ninebit::detail

// Collects the faults of a text up to the limit that all parsers share.

// Exported because the JSON forms are in a shared library of their own and use these.
namespace NINEBIT_PUBLIC ninebit {

class TextFaults {
 public:
  explicit TextFaults(std::string_view file) : file_(file) {}

  // Has no effect once there are kMaxTextFaults.
  void add(TextPlace place, std::string message, GlError gl_error = GlError::no_error) {
    if (full()) return;
    faults_.push_back({std::string(file_), place.line, place.column, std::move(message), gl_error});
  }
  // Adds the faults of another reader of the same text.
  void add(const std::vector<TextFault>& faults) {
    for (const TextFault& fault : faults) add({fault.line, fault.column}, fault.message, fault.gl_error);
  }

  [[nodiscard]] bool empty() const { return faults_.empty(); }
  [[nodiscard]] bool full() const { return faults_.size() >= kMaxTextFaults; }

  // Returns the faults in the order of the text; the collector is empty afterwards.
  [[nodiscard]] std::vector<TextFault> take();

 private:
  std::string_view file_;
  std::vector<TextFault> faults_;
};

// Adds a fault and returns true if the text is longer than kMaxSourceBytes.
[[nodiscard]] bool too_long(std::string_view text, TextFaults& faults);

}  // namespace ninebit

// What all parsers share: the text with its name, places in it, and results that carry every error.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/combiner/validate.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A text to be parsed; both views must outlive the call.
struct SourceText {
  std::string_view text;  // UTF-8, at most kMaxSourceBytes
  std::string_view file;  // for messages; empty: none
};

// A fault in a text. Lines and columns are 1-based; a column counts bytes.
struct TextFault {
  std::string file{};     // as SourceText has it
  int line = 0;           // from 1
  int column = 0;         // from 1
  std::string message{};  // one sentence: what is wrong and what was expected
  // What GL raises where the program that stands here is loaded; no_error: GL is not asked, or sees nothing wrong.
  GlError gl_error = GlError::no_error;

  // "FILE:LINE:COLUMN: MESSAGE", the message after "GL_INVALID_…: " where GL raises an error.
  [[nodiscard]] std::string text() const;
};

// A value, or all that is wrong with its text (at most kMaxTextFaults; never empty without a value).
inline constexpr std::size_t kMaxTextFaults = 100;
template <class T>
struct Parsed {
  std::optional<T> value;                                       // empty: there are faults
  std::vector<TextFault> faults;                                // empty where there is a value
  explicit operator bool() const { return value.has_value(); }  // whether there is a value
};

// The longest text that is parsed; a longer one is a fault before it is looked at.
inline constexpr std::size_t kMaxSourceBytes = std::size_t{16} << 20;

// The place of a byte of a text.
struct TextPlace {
  int line = 1;    // from 1
  int column = 1;  // from 1, in bytes
};
// The place of the byte at `offset`, which may be the text's end.
[[nodiscard]] TextPlace place_of(std::string_view text, std::size_t offset);

}  // namespace ninebit

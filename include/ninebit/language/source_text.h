// Shared by all parsers: a text with its name, places in a text, and results with every fault.
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

// The place of a byte of a text.
struct TextPlace {
  int line = 1;    // from 1
  int column = 1;  // from 1, in bytes
};
// The place of the byte at `offset`, which may be the text's end.
[[nodiscard]] TextPlace place_of(std::string_view text, std::size_t offset);

// A text to be parsed; the views must outlive the call.
struct SourceText {
  std::string_view text;  // UTF-8, at most kMaxSourceBytes
  std::string_view file;  // for messages; empty: none
  // For a text that stands in another one, such as a program in string literals: the bytes as they are written there,
  // as many as `text` has, and the place of the first. Empty: the text stands alone.
  std::string_view written{};
  TextPlace begin{};

  // The place of a byte in the file.
  [[nodiscard]] TextPlace place(std::size_t offset) const;
};

// A fault in a text. Lines and columns are 1-based; a column counts bytes.
struct TextFault {
  std::string file{};     // SourceText::file
  int line = 0;           // from 1
  int column = 0;         // from 1
  std::string message{};  // one sentence: what is wrong and what was expected
  // The error that GL raises for this fault when the program is loaded; no_error: GL is not called, or accepts it.
  GlError gl_error = GlError::no_error;

  // "FILE:LINE:COLUMN: MESSAGE", with "GL_INVALID_…: " before the message if GL raises an error.
  [[nodiscard]] std::string text() const;
};

// A value, or the faults of its text (at least one, at most kMaxTextFaults).
inline constexpr std::size_t kMaxTextFaults = 100;
template <class T>
struct Parsed {
  std::optional<T> value;                                       // empty: there are faults
  std::vector<TextFault> faults;                                // empty if there is a value
  std::vector<TextFault> notes{};                               // what was skipped or assumed, with or without a value
  explicit operator bool() const { return value.has_value(); }  // whether there is a value
};

// The longest text that is parsed, in bytes; a longer one is a fault and is not read.
inline constexpr std::size_t kMaxSourceBytes = std::size_t{16} << 20;

}  // namespace ninebit

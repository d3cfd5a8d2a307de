// Shared by all parsers: a text with its name, places in a text, and results with every fault.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/combiner/validate.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
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

// The text of a file that a source or a pixel shader includes by its name in quotation marks; empty: it is not there. A
// source goes on then, and what the file declares is not known; of a shader that is a fault.
using SourceInclude = std::function<std::optional<std::string>(std::string_view)>;

// A value that a text does not give.
struct Definition {
  // In a source, a macro, a parameter, a member, a variable of another file or a call's result, as the source writes
  // it, without blanks: "unit", "state.shader", "getUnit()"; -> may stand for a point. In a pixel shader, a macro.
  std::string name{};
  // In a source, a number, an enumerant, an expression of them, or several separated by commas: "1,0,0,1". In a pixel
  // shader, what the macro stands for.
  std::string value{};
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

// The number of faults after which those of the same text are dropped.
inline constexpr std::size_t kMaxTextFaults = 100;
// Why a text was not parsed: all its faults.
struct ParseError {
  std::vector<TextFault> faults{};  // at least one, at most kMaxTextFaults

  // TextFault::text() of each, one a line, without a newline at the end.
  [[nodiscard]] std::string text() const;
};

// A parser's return value: a Result whose error is a ParseError, with notes.
template <class T>
class [[nodiscard]] Parsed : public Result<T, ParseError> {
 public:
  // The value of a text without faults.
  Parsed(T value, std::vector<TextFault> notes_of_text = {})
      : Result<T, ParseError>(std::move(value)), notes(std::move(notes_of_text)) {}
  // The faults of a text, at least one.
  Parsed(std::vector<TextFault> faults, std::vector<TextFault> notes_of_text = {})
      : Result<T, ParseError>(ParseError{std::move(faults)}), notes(std::move(notes_of_text)) {}

  // The faults of error(); empty if there is a value.
  [[nodiscard]] const std::vector<TextFault>& faults() const {
    static const std::vector<TextFault> none;
    return this->ok() ? none : this->error().faults;
  }

  std::vector<TextFault> notes;  // what was skipped or assumed, with or without a value
};

// The longest text that is parsed, in bytes; a longer one is a fault and is not read.
inline constexpr std::size_t kMaxSourceBytes = std::size_t{16} << 20;

}  // namespace ninebit

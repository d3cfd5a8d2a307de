// How the library reports: by a value, never by a print, an exit or an exception of its own.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// What kind of fault a Diagnostic describes; the program turns it into its exit code.
enum class Fault {
  invalid_input,  // unreadable, malformed or senseless input (exit code 3)
  cannot_write,   // an output could not be written (exit code 4)
  cancelled       // the caller asked for the work to stop
};

// One fault, in one sentence that says what is wrong and what was expected.
struct Diagnostic {
  std::string message{};               // no trailing newline, no "error:" prefix
  std::string file{};                  // the file at fault, as the caller named it; empty: none
  int line = 0;                        // 1-based; 0: unknown or not a text file
  Fault fault = Fault::invalid_input;  // its kind

  // "FILE:LINE: MESSAGE", with the parts that are known.
  [[nodiscard]] std::string text() const {
    std::string out = file;
    if (!file.empty() && line > 0) {
      out += ':';
      out += std::to_string(line);
    }
    if (!file.empty()) out += ": ";
    return out + message;
  }
};

// A value, or the Diagnostic that says why there is none. value() on a failed result, or error() on a good one, is a
// programming error (std::bad_variant_access from the standard library).
template <class T>
class [[nodiscard]] Result {
 public:
  // A good result.
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  // A failed one.
  Result(Diagnostic error) : content_(std::in_place_index<1>, std::move(error)) {}

  // Whether there is a value.
  [[nodiscard]] bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  // The value; only of a good result.
  [[nodiscard]] const T& value() const& { return std::get<0>(content_); }
  [[nodiscard]] T& value() & { return std::get<0>(content_); }
  [[nodiscard]] T&& value() && { return std::get<0>(std::move(content_)); }
  // Why there is no value; only of a failed result.
  [[nodiscard]] const Diagnostic& error() const { return std::get<1>(content_); }

  // The value as value() gives it.
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }

 private:
  std::variant<T, Diagnostic> content_;
};

// The same for an operation without a value: empty means that it was done.
class [[nodiscard]] Status {
 public:
  // Done.
  Status() = default;
  // Not done.
  Status(Diagnostic error) : error_(std::move(error)) {}

  // Whether it was done.
  [[nodiscard]] bool ok() const { return !error_.has_value(); }
  explicit operator bool() const { return ok(); }
  // Why it was not done; only where ok() is false.
  [[nodiscard]] const Diagnostic& error() const { return error_.value(); }

 private:
  std::optional<Diagnostic> error_;
};

}  // namespace ninebit

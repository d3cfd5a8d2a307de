// How the library reports errors: by value. It never prints, exits or throws an exception of its own.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <variant>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The kind of a fault. The program maps it to its exit code.
enum class Fault {
  invalid_input,  // unreadable, malformed or meaningless input (exit code 3)
  cannot_write,   // an output could not be written (exit code 4)
  cancelled       // the caller asked for the work to stop
};

// One fault: a sentence that says what is wrong and what was expected, and its place.
struct Diagnostic {
  std::string message{};               // no trailing newline, no "error:" prefix
  std::string file{};                  // the faulty file, as the caller named it; empty: none
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

// A value, or the error of the failure, whose text() says it in words. value() of a failed result and error() of a good
// one are programming errors: the standard library throws std::bad_variant_access.
template <class T, class Error = Diagnostic>
class [[nodiscard]] Result {
 public:
  // A good result.
  Result(T value) : content_(std::in_place_index<0>, std::move(value)) {}
  // A failed one.
  Result(Error error) : content_(std::in_place_index<1>, std::move(error)) {}

  // Whether there is a value.
  [[nodiscard]] bool ok() const { return content_.index() == 0; }
  explicit operator bool() const { return ok(); }

  // Returns the value of a good result.
  [[nodiscard]] const T& value() const& { return std::get<0>(content_); }
  [[nodiscard]] T& value() & { return std::get<0>(content_); }
  [[nodiscard]] T&& value() && { return std::get<0>(std::move(content_)); }
  // Returns the error of a failed result.
  [[nodiscard]] const Error& error() const { return std::get<1>(content_); }

  // The value as value() gives it.
  const T* operator->() const { return &value(); }
  T* operator->() { return &value(); }
  const T& operator*() const& { return value(); }
  T& operator*() & { return value(); }

 private:
  std::variant<T, Error> content_;
};

// The same for an operation without a value.
class [[nodiscard]] Status {
 public:
  // Success.
  Status() = default;
  // Failure.
  Status(Diagnostic error) : error_(std::move(error)) {}

  // Whether the operation succeeded.
  [[nodiscard]] bool ok() const { return !error_.has_value(); }
  explicit operator bool() const { return ok(); }
  // Returns the Diagnostic of a failure, if ok() is false.
  [[nodiscard]] const Diagnostic& error() const { return error_.value(); }

 private:
  std::optional<Diagnostic> error_;
};

}  // namespace ninebit

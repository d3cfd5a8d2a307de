// Values of a source's expressions: known numbers, arrays and texts, or the names of what would make them known.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/gl_calls/gl_calls_execute.h"

namespace ninebit::code {

// The most elements of an array.
inline constexpr std::size_t kMostElements = 4096;

struct Value {
  enum class Kind : std::uint8_t {
    unknown,
    integer,
    real,
    list,         // an array, a struct or a vector's numbers
    text,         // string literals: the bytes [begin, end) of the source
    entry_point,  // the name of a function of OpenGL: true, and not NULL
    symbol        // a name that a definition gives as a value; equal to that name alone
  };
  Kind kind = Kind::unknown;
  std::int64_t integer = 0;
  double real = 0;  // of an integer, too
  std::vector<Value> list{};
  std::string_view type{};           // of a list: its struct; of a number: empty
  int low = 0;                       // of a list: its first index
  std::uint32_t begin = 0, end = 0;  // of a text
  std::string
      symbol{};  // of a symbol; of an unknown value: the one name that it is; of a text from macros: its literals
  std::vector<std::string> needs{};  // of an unknown value: names to define; none: no definition helps
  std::vector<std::string>
      origins{};  // of a known value: variables that are not constant and gave it their first values

  [[nodiscard]] bool is_known() const { return kind != Kind::unknown; }
  [[nodiscard]] bool is_number() const { return kind == Kind::integer || kind == Kind::real; }
};

[[nodiscard]] Value integer_value(std::int64_t value);
[[nodiscard]] Value real_value(double value);
// A value that is known if `name` is defined.
[[nodiscard]] Value needed_value(const std::string& name);
// A value that is known if both are.
[[nodiscard]] Value unknown_of(const Value& a, const Value& b);

// Adds names that are not there yet, up to a few.
void add_needs(std::vector<std::string>& to, const std::vector<std::string>& more);

// C's operators on known numbers; unknown where C leaves them undefined.
[[nodiscard]] Value apply_unary(std::string_view op, const Value& operand);
[[nodiscard]] Value apply_binary(std::string_view op, const Value& left, const Value& right);

// Whether a value is the elements of an array of structs, so that a member of it is one of the first.
[[nodiscard]] bool points_to_struct(const Value& value);

// Whether a value is true in a condition; needs a known number, text, entry point or symbol.
[[nodiscard]] bool is_true(const Value& value);

// A number as a type's last word makes it; others as they are.
[[nodiscard]] Value converted(const Value& value, std::string_view type);

// A value as an argument of a call, in its own form; false: it is not known, or not a number or an array of them.
[[nodiscard]] bool to_argument(const Value& value, detail::GlArgument& out);

}  // namespace ninebit::code

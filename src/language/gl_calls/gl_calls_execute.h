// Runs one GL call of a text on a context, and reports why GL refused it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>
#include <vector>

#include "ninebit/language/gl_nv.h"
#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {

enum class GlElement { any, integer, real };

// The kind of an array's elements by the name of their type; empty: not a type of GL calls.
[[nodiscard]] std::optional<GlElement> element_type(std::string_view name);

// An argument as written: a number or an array of numbers.
struct GlArgument {
  std::size_t offset = 0;
  std::string_view text;
  bool is_array = false;
  bool is_integer = true;              // numbers: not floating-point
  std::int64_t integer = 0;            // numbers: the value if is_integer
  double real = 0.0;                   // numbers: the value, integer or not
  GlElement element = GlElement::any;  // arrays: the declared type
  std::size_t count = 0;               // arrays: number of elements
  std::vector<GlArgument> values;      // arrays: the first four elements
};

// Reads a C number: decimal, hexadecimal, octal or floating-point; false if it is not a number or its type cannot hold
// it.
[[nodiscard]] bool read_gl_number(std::string_view text, GlArgument& out);

// Converts the arguments as C would, or as the bindings of other languages do, runs the call, and reports the faults of
// both; `offset` is that of the call.
void execute_gl_call(const GlSignature& call, std::vector<GlArgument> arguments, std::size_t offset,
                     gl::Context& context, SourceFaults& faults);

}  // namespace ninebit::detail

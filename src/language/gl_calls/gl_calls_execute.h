// Runs one GL call of a text on a context, and says why GL refused it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "ninebit/language/gl_nv.h"
#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {

enum class GlElement { any, integer, real };

// An argument as it is written: a number or an array of them.
struct GlArgument {
  std::size_t offset = 0;
  std::string_view text;
  bool is_array = false;
  bool is_integer = true;              // of a number
  std::int64_t integer = 0;            // a number, when is_integer
  double real = 0.0;                   // a number, always
  GlElement element = GlElement::any;  // of an array: what its declaration says
  std::size_t count = 0;               // of an array: its elements,
  std::vector<GlArgument> values;      // and the first four of them
};

// Fills in the value of a number as C writes it, decimal, hexadecimal, octal or floating; false: it is none, or its
// type cannot hold it.
[[nodiscard]] bool read_gl_number(std::string_view text, GlArgument& out);

// Converts the arguments as C would, runs the call, and reports what is wrong with either; `offset` is the call's.
void execute_gl_call(const GlSignature& call, const std::vector<GlArgument>& arguments, std::size_t offset,
                     gl::Context& context, SourceFaults& faults);

}  // namespace ninebit::detail

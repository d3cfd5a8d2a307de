// The question whether two programs differ, as text in SMT-LIB 2, the language of solvers such as Z3.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The value of a component of a register before the first general combiner, or of a constant that is not set: an input,
// which may be any byte, or a code.
struct SmtSource {
  std::string input;   // the input's name, "tex0.r"; empty: a code
  int byte_shift = 0;  // number of low bits that the register drops of the byte
  int code = 0;        // without an input
};

// A program and what its registers hold at the start.
struct SmtProgram {
  const Program* program = nullptr;                              // its arithmetic is integer
  std::array<std::array<SmtSource, 4>, kRegisterCount> start{};  // by register and component
  std::array<std::array<SmtSource, 4>, kConstantNames> unset{};  // of constants that are not set, by name and component
};

// The question as a script.
struct SmtQuestion {
  bool trivial = false;             // both sides are the same formula: no solver is needed, and there is no text
  std::string text;                 // declares, asserts that the outputs differ, and asks: (check-sat), (get-value …)
  std::vector<std::string> inputs;  // the inputs that it names, in the order of the values that it asks for
};

// Asks for bytes of inputs for which the colours' component (kRed to kAlpha) differs as a code. Values are bit vectors
// that are just wide enough, so nothing overflows; a quotient is the number that its defining inequality allows.
// Returns a Diagnostic for a program whose arithmetic is not integer, and for codes beyond the datapath's range.
[[nodiscard]] Result<SmtQuestion> emit_smt_lib(const SmtProgram& a, const SmtProgram& b, int component);

}  // namespace ninebit

// Many fragments whose codes lie in memory as the caller has them: in planes, in pictures, in arrays with any distance
// between their elements. They are read and written in place, and only those that the program reads.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The type of an element: a code of 16 bits, or a byte with a code from 0 to 255.
enum class ElementType : std::uint8_t { code, byte };

// A register's component in all fragments.
struct InputArray {
  const void* first = nullptr;           // the first fragment's element; nullptr: see FragmentArrays::otherwise
  std::ptrdiff_t stride = 0;             // bytes from a fragment's element to the next one's; 0: one for all
  ElementType type = ElementType::code;  // of each element
};

// Where a component of all results goes.
struct OutputArray {
  void* first = nullptr;                 // nullptr: it is not wanted
  std::ptrdiff_t stride = 0;             // bytes, as above; not 0
  ElementType type = ElementType::code;  // of each element
};

// The inputs and outputs of `count` fragments.
struct FragmentArrays {
  std::size_t count = 0;                                          // fragments in every array
  std::array<std::array<InputArray, 4>, kRegisterCount> input{};  // by Register and component
  RegisterFile otherwise{};                                       // the codes of components without an array
  std::array<OutputArray, 4> color{};                             // the final combiner's
  // The registers after the last general combiner, for a program that was compiled with BatchOutputs::registers.
  std::array<std::array<OutputArray, 4>, kRegisterCount> after{};

  // A register is a picture: four bytes a fragment, red first. `reg` is one of the first kRegisterCount.
  void read_rgba8(Register reg, const std::uint8_t* picture);
  // The colours become a picture, whose bytes are their codes.
  void write_rgba8(std::uint8_t* picture);
};

// An input that no register can hold.
struct CodeOutOfRange {
  Register reg = Register::zero;  // that was to hold it
  int component = kRed;           // kRed to kAlpha
  int code = 0;                   // what stands there
};

// The first register's and component's code outside of [lowest, one] of the program, whether the program reads it or
// not; nothing if there is none. evaluate() expects that there is none.
[[nodiscard]] std::optional<CodeOutOfRange> find_code_out_of_range(const Program& program,
                                                                   const FragmentArrays& arrays);

// Evaluates the fragments begin <= i < end, with the bits of evaluate_fragment(). Ranges may run in any number of
// threads at once. Constants are read from the arrays if they vary in the program, otherwise the program's are used.
// An output may be the memory of an input if a fragment's result lies where that fragment's inputs are. Nothing is
// written outside of the results, and nothing read outside of the arrays.
void evaluate(const BatchProgram& program, const FragmentArrays& arrays, std::size_t begin, std::size_t end);

}  // namespace ninebit

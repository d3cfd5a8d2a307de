// Random small programs in C that set constant colours, in what the reader of sources models and a little beyond.
#pragma once

#include <string>

#include "combiner_tests/support/random.h"

namespace ninebit::test {

// What a compiler needs before the programs: OpenGL's types, stubs that keep the colours, and functions that the reader
// does not know: `program_unknown` returns other numbers for other seeds.
[[nodiscard]] std::string programs_prologue();

// A program whose entry is `void run_INDEX(void)`. The colours that it sets are in the slots of programs_prologue():
// 0 and 1 the constants, 2 to 17 those of stages.
[[nodiscard]] std::string random_program(Random& random, int index);

}  // namespace ninebit::test

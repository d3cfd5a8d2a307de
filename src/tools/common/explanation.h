// An explanation as the program prints it.
#pragma once

#include <string>

#include "ninebit/language/explain.h"
#include "ninebit/language/program_text.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// The answer of `ninebit explain --json`. `program`: what stands beside the combiners, their stages and words.
[[nodiscard]] Json explanation_json(const Explanation& explanation, const TextProgram& program,
                                    const std::string& profile);

// The same for people.
[[nodiscard]] std::string explanation_text(const Explanation& explanation, const TextProgram& program);

}  // namespace ninebit::tools

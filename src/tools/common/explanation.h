// An explanation as the program prints it.
#pragma once

#include <string>
#include <vector>

#include "ninebit/language/explain.h"
#include "ninebit/language/register_words.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// The answer of `ninebit explain --json`. `other_words`: the words beside the combiners'.
[[nodiscard]] Json explanation_json(const Explanation& explanation, const std::vector<RegisterWord>& other_words,
                                    const std::string& profile);

// The same for people.
[[nodiscard]] std::string explanation_text(const Explanation& explanation,
                                           const std::vector<RegisterWord>& other_words);

}  // namespace ninebit::tools

// Programs for the verbs that read one.
#pragma once

#include <string>

#include "combiner_tests/tools/support.h"
#include "ninebit/combiner/state.h"

namespace tools_test {

// The article's index comparison as the GL calls of its listing, and the state that they make.
extern const char* const kArticleCalls;
[[nodiscard]] ninebit::CombinerState article_state();

// Writes the state as JSON; gives the file's path.
std::string write_program(const TempFolder& folder, const std::string& name, const ninebit::CombinerState& state);

// stdout's lines, without their ends.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace tools_test

// Programs for the verbs that read one.
#pragma once

#include <string>

#include "combiner_tests/tools/support.h"
#include "ninebit/combiner/state.h"

namespace tools_test {

// The article's index comparison: the file with the GL calls of its listing, its text, and the state that they make.
inline const std::string kArticle = NINEBIT_SOURCE_DIR "/docs/programs/index_compare.gl";
[[nodiscard]] std::string article_calls();
[[nodiscard]] ninebit::CombinerState article_state();

// Writes the state as JSON; gives the file's path.
std::string write_program(const TempFolder& folder, const std::string& name, const ninebit::CombinerState& state);

}  // namespace tools_test

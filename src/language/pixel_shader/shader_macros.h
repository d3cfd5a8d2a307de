// The preprocessor of pixel shaders: #define without parameters, conditions, and what is skipped.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "src/language/pixel_shader/shader_lexer.h"

namespace ninebit::detail {

// A shader's tokens after the preprocessor.
struct ShaderTokens {
  std::vector<ShaderToken> tokens;  // with names replaced; a replaced token has its name's place
  bool includes = false;            // whether other files were to be included, which may define names
  bool is_whole = true;             // whether each condition has a value
  std::set<std::string> used{};     // definitions that were looked at
};

// Executes the preprocessor's lines. A note names each #include, which is skipped; a condition that depends on a name
// without a value is a fault. `definitions`, which must outlive the tokens, replace those of the text.
[[nodiscard]] ShaderTokens preprocess_shader(std::vector<ShaderToken> tokens,
                                             const std::vector<Definition>& definitions, SourceFaults& faults,
                                             SourceFaults& notes);

}  // namespace ninebit::detail

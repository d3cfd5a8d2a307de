// The preprocessor of pixel shaders: #define without parameters, conditions, and what is skipped.
#pragma once

#include <vector>

#include "src/language/pixel_shader/shader_lexer.h"

namespace ninebit::detail {

// What is left of a shader's tokens after the preprocessor.
struct ShaderTokens {
  std::vector<ShaderToken> tokens;  // with names replaced; a replaced token has its name's place
  bool includes = false;            // whether other files were to be included, which may define names
};

// Executes the preprocessor's lines. A note names each #include, which is skipped.
[[nodiscard]] ShaderTokens preprocess_shader(std::vector<ShaderToken> tokens, SourceFaults& faults,
                                             SourceFaults& notes);

}  // namespace ninebit::detail

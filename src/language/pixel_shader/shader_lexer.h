// The tokens of pixel shaders in assembly.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/source/source_faults.h"

namespace ninebit::detail {

struct ShaderToken {
  enum class Kind {
    end_of_line,
    version,      // ps.1.1, ps_1_1, xps.1.1, !!PS1.0
    word,         // mul_x2, r0_bx2; without a component suffix
    number,       // without a sign; f may end it
    punctuation,  // one of + - , . [ ] ( ) # ! and the like
    end
  };
  Kind kind = Kind::end;
  std::size_t offset = 0;
  std::string_view text{};

  [[nodiscard]] bool is(char c) const { return kind == Kind::punctuation && text.front() == c; }
};

// The most tokens of a text, as it is written and with names replaced.
inline constexpr std::size_t kMostShaderTokens = std::size_t{1} << 20;

// A token's text in lower case: the language does not distinguish.
[[nodiscard]] std::string lower_case(std::string_view text);

// The length of a version such as ps.1.1 or !!PS1.0 at the beginning of a text; 0: there is none.
[[nodiscard]] std::size_t shader_version_length(std::string_view text);

// All tokens, without comments; a line that ends with a backslash goes on in the next one. An unterminated comment is a
// fault, and so is a text of more than kMostShaderTokens.
[[nodiscard]] std::vector<ShaderToken> lex_shader(std::string_view text, SourceFaults& faults);

}  // namespace ninebit::detail

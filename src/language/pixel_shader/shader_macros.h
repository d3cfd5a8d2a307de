// The tokens of pixel shaders in assembly, with their preprocessor executed.
#pragma once

#include <cstddef>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/source_text.h"
#include "src/language/c_like/c_macros.h"
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

// The most tokens of a text with names replaced.
inline constexpr std::size_t kMostShaderTokens = std::size_t{1} << 20;

// The length of a version such as ps.1.1 or !!PS1.0 at the beginning of a text; 0: there is none.
[[nodiscard]] std::size_t shader_version_length(std::string_view text);

// A shader's tokens after the preprocessor.
struct ShaderTokens {
  std::vector<ShaderToken> tokens{};  // with names replaced; a replaced token has its name's place
  bool includes = false;              // whether other files were to be included, which may define names
  bool is_whole = true;               // whether each condition has a value
  std::set<std::string> used{};       // definitions that were looked at
  // The memory that the tokens' texts are views of.
  std::shared_ptr<const std::string> written{};
  std::shared_ptr<const code::Macros> macros{};
};

// Splits a text into tokens and executes the preprocessor's lines: C's, with comments from ; to the end of the line.
// Without `include`, a note names each #include, which is skipped. Faults are a file that is not there, an unterminated
// comment, lines of the preprocessor that are not complete or not known, a condition that depends on a name without a
// value, and more than kMostShaderTokens. `definitions`, which must outlive the tokens, replace those of the text.
[[nodiscard]] ShaderTokens preprocess_shader(std::string_view text, const std::vector<Definition>& definitions,
                                             const SourceInclude& include, SourceFaults& faults, SourceFaults& notes);

}  // namespace ninebit::detail

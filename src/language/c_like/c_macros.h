// Macros, and their expansion as C does it: arguments first, then the body, and no macro inside of itself.
#pragma once

#include <cstddef>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/c_like/c_lexer.h"

namespace ninebit::code {

struct Macro {
  bool has_parameters = false;
  bool is_variadic = false;
  bool is_given = false;  // by the caller: the text does not change it
  bool is_used = false;   // was expanded, asked for or defined again
  std::vector<std::string_view> parameters{};
  std::vector<Token> body{};
};

struct Macros {
  std::map<std::string_view, Macro> all{};
  std::function<bool(std::string_view, const Macro&)> is_reserved{};  // whether a name is never expanded
  std::deque<std::string> kept{};                                     // texts of tokens that were made
  std::size_t made = 0;                                               // tokens so far
};

// The most tokens that macros make of a text, and that one macro takes or gives.
inline constexpr std::size_t kMostTokens = std::size_t{1} << 22, kMostTokensOfMacro = std::size_t{1} << 20;

// Gives the tokens of a source of raw tokens with macros expanded.
class MacroExpander {
 public:
  MacroExpander(Macros& macros, std::function<Token()> next, std::size_t depth = 0)
      : macros_(macros), next_(std::move(next)), depth_(depth) {}

  // The next token; Kind::end at the end, and for good once macros made more than kMostTokens tokens.
  Token take();
  [[nodiscard]] bool too_many() const { return macros_.made > kMostTokens; }

 private:
  // Tokens of a macro that are still to be given; the macro is not expanded again meanwhile.
  struct Expansion {
    const Macro* macro = nullptr;
    std::vector<Token> tokens{};
    std::size_t at = 0;
  };
  using Arguments = std::vector<std::vector<Token>>;

  Token raw();
  bool expand(Token& name);
  [[nodiscard]] bool is_active(const Macro& macro) const;
  std::optional<Arguments> arguments(const Macro& macro);
  [[nodiscard]] std::vector<Token> expanded(const std::vector<Token>& tokens);
  [[nodiscard]] std::vector<Token> substituted(const Macro& macro, const Arguments& arguments, const Token& name);
  Token quoted_tokens(const std::vector<Token>& tokens, const Token& name);
  void paste(std::vector<Token>& out, const std::vector<Token>& more);

  Macros& macros_;
  std::function<Token()> next_;
  std::size_t depth_;
  std::vector<Expansion> expansions_{};
  std::deque<Token> held_{};  // raw tokens that were looked at
};

// The tokens of a line with macros expanded.
[[nodiscard]] std::vector<Token> expand_tokens(Macros& macros, const std::vector<Token>& tokens, std::size_t depth = 0);

}  // namespace ninebit::code

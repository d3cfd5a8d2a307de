// Macros of a source file, and their expansion.
#pragma once

#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/source_code/code_token.h"

namespace ninebit::code {

struct Macro {
  bool has_parameters = false;
  bool is_variadic = false;
  std::vector<std::string_view> parameters{};
  std::vector<Token> body{};
};

// The most tokens that a macro takes or gives.
inline constexpr std::size_t kMostTokensOfArguments = std::size_t{1} << 20;

// Gives the tokens of a source of raw tokens with macros expanded.
class MacroExpander {
 public:
  // `next` gives the file's tokens; `pasted` keeps the texts of new ones.
  MacroExpander(std::function<Token()> next, std::deque<std::string>& pasted)
      : next_(std::move(next)), pasted_(pasted) {}

  void define(std::string_view name, Macro macro) { macros_[name] = std::move(macro); }
  void undefine(std::string_view name) { macros_.erase(name); }
  [[nodiscard]] bool is_defined(std::string_view name) const { return macros_.count(name) != 0; }
  // nullptr: no macro has this name.
  [[nodiscard]] const Macro* find(std::string_view name) const;

  // The next token. Kind::end at the end of the file, and for good once macros made more than `most` tokens.
  Token take(std::size_t most);
  [[nodiscard]] bool too_many() const { return too_many_; }

 private:
  // Tokens of a macro that are still to be given; the macro is not expanded again meanwhile.
  struct Expansion {
    const Macro* macro = nullptr;
    std::vector<Token> tokens{};
    std::size_t at = 0;
  };
  using Arguments = std::vector<std::vector<Token>>;

  Token raw();
  Token peek_raw();
  bool expand(const Token& name);
  std::optional<Arguments> arguments(const Macro& macro);
  [[nodiscard]] std::vector<Token> substituted(const Macro& macro, const Arguments& arguments, const Token& name);
  Token quoted_tokens(const std::vector<Token>& tokens, const Token& name);
  void paste(std::vector<Token>& out, const std::vector<Token>& more);

  std::function<Token()> next_;
  std::deque<std::string>& pasted_;
  std::map<std::string_view, Macro> macros_{};
  std::vector<Expansion> expansions_{};
  std::optional<Token> peeked_{};
  std::size_t made_ = 0;
  bool too_many_ = false;
};

}  // namespace ninebit::code

// The preprocessor of C: macros, conditions, included files; and the constant expressions of #if and #elif.
#pragma once

#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/c_like/c_lexer.h"
#include "src/language/c_like/c_macros.h"

namespace ninebit::code {

struct ConditionValue {
  bool holds = false;     // with names as 0, as in C
  std::string unknown{};  // a name on which the value depends; empty: none
  std::string fault{};    // why the value cannot be computed, which then does not hold; empty: it can
};

// The value of an expression whose macros are expanded.
[[nodiscard]] ConditionValue condition_value(const std::vector<Token>& expression,
                                             const std::function<bool(std::string_view)>& is_defined);

// The answer of a condition. Names that mean nothing are 0, as C has it; then it is not sure.
struct Answer {
  bool value = false;
  bool is_sure = true;
  std::string unknown{};  // a name without a value that decides; empty: none
  std::string fault{};    // why the condition has no value; empty: it has
};

struct PreprocessorOptions {
  // The value of a name that no macro has; empty: it has none. It counts as defined in conditions alone.
  std::function<std::optional<std::string_view>(std::string_view)> value_of{};
  // Whether the part behind a condition is read, and none before it was: the directive, its line, what it says.
  std::function<bool(const Token&, const std::vector<Token>&, Answer)> reads{};
  // The text of an included file; null: it is not there.
  std::function<const std::string*(std::string_view)> include{};
  // An #include that is not read: the directive of the text itself, the name as it is written.
  std::function<void(const Token&, const std::string&)> skipped{};
  // Reports a fault of a directive with its place in the text itself. Without this function faults are ignored.
  std::function<void(const Token&, const std::string&)> fault{};
  // Files that include each other without an end, or too many; as `fault`, and never ignored. No other file is read
  // then.
  std::function<void(const Token&, const std::string&)> endless{};
};

class Preprocessor {
 public:
  Preprocessor(std::string_view text, Macros& macros, PreprocessorOptions options);

  // The next token with macros expanded; Kind::end at the end.
  Token take() { return expander_.take(); }
  [[nodiscard]] bool too_many() const { return expander_.too_many(); }
  // Reports a condition that is still open at the end.
  void finish();

 private:
  struct OpenGroup {
    Token hash{};           // of the line that opens it
    std::size_t depth = 1;  // of its text: 1 is the text itself
    bool outer = true;      // whether the part around it is read
    bool reads = false;     // the current branch
    bool taken = false;     // a branch was read
    bool has_else = false;
  };
  struct Text {
    Lexer lexer;
    std::optional<Token> held{};     // the first token of the next line
    std::optional<Token> include{};  // of an included text: the directive of the text itself
    std::string_view name{};         // of an included text
  };

  Token next();
  void end_text();
  void directive();
  void obey(const Token& directive, const std::vector<Token>& line);
  void fault(const Token& at, const std::string& message) const;
  bool names_macro(const Token& directive, const std::vector<Token>& line);
  void define(const std::vector<Token>& line);
  void include(const Token& directive, const std::vector<Token>& line);
  [[nodiscard]] Token outer(const Token& at) const { return texts_.back().include.value_or(at); }
  [[nodiscard]] Answer answer(const Token& directive, const std::vector<Token>& line);
  [[nodiscard]] bool reads() const { return open_.empty() || open_.back().reads; }

  Macros& macros_;
  PreprocessorOptions options_;
  std::vector<Text> texts_;  // the file, and those included now
  std::vector<OpenGroup> open_;
  std::size_t included_ = 0, included_bytes_ = 0;
  bool too_many_included_ = false;   // it was reported, and no more files are read
  std::set<std::string_view> once_;  // files that are not read again
  Token hash_{};                     // of the directive that is obeyed
  MacroExpander expander_;
};

}  // namespace ninebit::code

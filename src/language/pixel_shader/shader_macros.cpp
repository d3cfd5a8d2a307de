#include "src/language/pixel_shader/shader_macros.h"

#include <algorithm>
#include <array>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>

#include "src/language/source/condition.h"
#include "src/language/source/nearest_name.h"

namespace ninebit::detail {
namespace {

using MacroTokenKind = ShaderToken::Kind;

constexpr std::array<std::string_view, 12> kDirectives{"define", "undef", "include", "pragma", "if",   "ifdef",
                                                       "ifndef", "elif",  "else",    "endif",  "line", "error"};
constexpr std::size_t kDeepest = 32;  // names in names, conditions in conditions

class ShaderPreprocessor {
 public:
  ShaderPreprocessor(std::vector<ShaderToken> tokens, const std::vector<Definition>& definitions, SourceFaults& faults,
                     SourceFaults& notes)
      : tokens_(std::move(tokens)), faults_(faults), notes_(notes) {
    for (const Definition& one : definitions) {
      SourceFaults wrong({one.value, {}});
      std::vector<ShaderToken> body = lex_shader(one.value, wrong);
      for (const TextFault& fault : wrong.take()) {
        faults_.add(0, "the definition of " + quoted(one.name) + ": " + fault.message);
      }
      std::erase_if(body, [](const ShaderToken& token) {
        return token.kind == MacroTokenKind::end_of_line || token.kind == MacroTokenKind::end;
      });
      macros_.insert_or_assign(one.name, ShaderMacro{std::move(body), true});
    }
  }

  ShaderTokens run() {
    bool line_begins = true;
    while (at_ < tokens_.size() && !faults_.full()) {
      const ShaderToken& token = tokens_[at_];
      if (line_begins && token.is('#')) {
        directive(line());
      } else if (token.kind == MacroTokenKind::end || reads()) {
        line_begins = token.kind == MacroTokenKind::end_of_line;
        replaced(token);
        ++at_;
        continue;
      } else {
        line();
      }
      line_begins = true;
    }
    if (!conditions_.empty()) faults_.add(conditions_.back().offset, "unterminated condition; expected #endif");
    return std::move(out_);
  }

 private:
  struct ShaderMacro {
    std::vector<ShaderToken> body{};
    bool is_given = false;  // by the caller: the text does not change it
  };
  struct Condition {
    std::size_t offset = 0;
    bool reads = false;     // whether this branch is read
    bool done = false;      // whether a branch was read, or none may be
    bool has_else = false;  // whether this branch is the last
  };

  [[nodiscard]] bool reads() const {
    return std::all_of(conditions_.begin(), conditions_.end(), [](const Condition& c) { return c.reads; });
  }

  // Takes the rest of a line, with its end.
  std::span<const ShaderToken> line() {
    const std::size_t begin = at_;
    while (tokens_[at_].kind != MacroTokenKind::end_of_line && tokens_[at_].kind != MacroTokenKind::end) ++at_;
    const std::span<const ShaderToken> all(tokens_);
    const std::size_t end = at_;
    if (tokens_[at_].kind == MacroTokenKind::end_of_line) ++at_;
    return all.subspan(begin, end - begin);
  }

  void directive(std::span<const ShaderToken> line) {
    if (line.size() < 2 || line[1].kind != MacroTokenKind::word) return;  // a lone # does nothing
    const std::string name = lower_case(line[1].text);
    const auto rest = line.subspan(2);
    if (name == "if" || name == "ifdef" || name == "ifndef") {
      begin_condition(line[0].offset, name, rest);
    } else if (name == "elif" || name == "else" || name == "endif") {
      continue_condition(line[0].offset, name, rest);
    } else if (!reads()) {
      return;
    } else if (name == "define") {
      define(line[1], rest);
    } else if (name == "undef") {
      undefine(line[1], rest);
    } else if (name == "include") {
      out_.includes = true;
      notes_.add(line[0].offset, "skipped " + text_of(rest) + "; its names are not known");
    } else if (std::find(kDirectives.begin(), kDirectives.end(), name) == kDirectives.end()) {
      faults_.add(line[1].offset,
                  "'#" + name + "' is not a line of the preprocessor" + did_you_mean(name, kDirectives));
    } else if (name == "error") {
      faults_.add(line[0].offset, "the text ends itself with #error");
    }
  }

  // The text between two tokens of a line.
  static std::string text_of(std::span<const ShaderToken> tokens) {
    if (tokens.empty()) return "a file";
    const char* const begin = tokens.front().text.data();
    const ShaderToken& last = tokens.back();
    return quoted({begin, static_cast<std::size_t>(last.text.data() + last.text.size() - begin)});
  }

  void define(const ShaderToken& word, std::span<const ShaderToken> rest) {
    if (rest.empty() || rest[0].kind != MacroTokenKind::word) {
      faults_.add(word.offset, "expected a name after #define");
      return;
    }
    const std::size_t end = rest[0].offset + rest[0].text.size();
    if (rest.size() > 1 && rest[1].is('(') && rest[1].offset == end) {
      faults_.add(rest[0].offset, quoted(rest[0].text) + " has parameters; only names without them are read");
      return;
    }
    if (!is_given(rest[0].text)) macros_[rest[0].text] = {{rest.begin() + 1, rest.end()}};
  }

  void undefine(const ShaderToken& word, std::span<const ShaderToken> rest) {
    if (rest.empty() || rest[0].kind != MacroTokenKind::word) {
      faults_.add(word.offset, "expected a name after #undef");
    } else if (!is_given(rest[0].text)) {
      macros_.erase(rest[0].text);
    }
  }

  // The macro of a name, or nullptr.
  const ShaderMacro* macro_of(std::string_view name) {
    const auto found = macros_.find(name);
    if (found == macros_.end()) return nullptr;
    if (found->second.is_given) out_.used.emplace(name);
    return &found->second;
  }

  bool is_given(std::string_view name) {
    const ShaderMacro* const macro = macro_of(name);
    return macro != nullptr && macro->is_given;
  }

  void begin_condition(std::size_t offset, const std::string& name, std::span<const ShaderToken> rest) {
    if (conditions_.size() == kDeepest) {
      faults_.add(offset, "conditions are nested more than " + std::to_string(kDeepest) + " deep");
      return;
    }
    Condition condition{.offset = offset};
    if (!reads()) {
      condition.done = true;
    } else if (name == "if") {
      condition.reads = condition.done = holds(offset, name, rest);
    } else if (rest.empty() || rest[0].kind != MacroTokenKind::word) {
      faults_.add(offset, "expected a name after #" + name);
    } else {
      const bool defined = macro_of(rest[0].text) != nullptr;
      condition.reads = condition.done = defined == (name == "ifdef");
    }
    conditions_.push_back(condition);
  }

  void continue_condition(std::size_t offset, const std::string& name, std::span<const ShaderToken> rest) {
    if (conditions_.empty()) {
      faults_.add(offset, "'#" + name + "' without #if");
      return;
    }
    if (name == "endif") {
      conditions_.pop_back();
      return;
    }
    Condition& condition = conditions_.back();
    if (condition.has_else) faults_.add(offset, "'#" + name + "' after #else");
    condition.has_else = name == "else";
    const bool was_done = condition.done;
    condition.reads = false;
    if (!was_done && reads_around()) condition.reads = condition.done = name == "else" || holds(offset, name, rest);
  }

  [[nodiscard]] bool reads_around() const {
    return std::all_of(conditions_.begin(), conditions_.end() - 1, [](const Condition& c) { return c.reads; });
  }

  // Tokens as a text, with blanks only where the source has them; the language has no case in `defined`.
  static std::string written(std::span<const ShaderToken> tokens) {
    std::string out;
    const char* end = nullptr;
    for (const ShaderToken& token : tokens) {
      if (end != nullptr && token.text.data() != end) out += ' ';
      const std::string lower = lower_case(token.text);
      out += lower == "defined" ? lower : token.text;
      end = token.text.data() + token.text.size();
    }
    return out;
  }

  // The value of #if or #elif. A name without a value on which it depends is a fault, once.
  bool holds(std::size_t offset, const std::string& name, std::span<const ShaderToken> rest) {
    const ConditionValue value = condition_value(
        written(rest), {.is_defined = [&](std::string_view of) { return macro_of(of) != nullptr; },
                        .body_of =
                            [&](std::string_view of) {
                              const ShaderMacro* const macro = macro_of(of);
                              return macro != nullptr ? std::optional(written(macro->body)) : std::nullopt;
                            }});
    if (!value.fault.empty()) {
      faults_.add(offset, "#" + name + ": " + value.fault);
    } else if (!value.unknown.empty() && asked_.insert(value.unknown).second) {
      out_.is_whole = false;
      faults_.add(offset, quoted(value.unknown) + " is not defined, and #" + name + " " + written(rest) +
                              " depends on it; give it as in --define '" + value.unknown + "=…', or by #define");
    }
    return value.holds;
  }

  // Adds a token, or what its name stands for; names in it are replaced, too, but not a name in itself.
  void replaced(const ShaderToken& token) {
    struct Open {
      std::string_view name;
      std::span<const ShaderToken> body;
      std::size_t next = 0;
    };
    const auto opened = [&](const ShaderToken& of) -> std::optional<Open> {
      const ShaderMacro* const macro = of.kind == MacroTokenKind::word ? macro_of(of.text) : nullptr;
      return macro != nullptr ? std::optional(Open{of.text, macro->body}) : std::nullopt;
    };
    const auto first = opened(token);
    if (!first) return add(token, token.offset);
    std::vector<Open> open{*first};
    while (!open.empty() && ++steps_ < kMostShaderTokens) {
      Open& top = open.back();
      if (top.next == top.body.size()) {
        open.pop_back();
        continue;
      }
      const ShaderToken& inner = top.body[top.next++];
      const auto more = opened(inner);
      const bool is_open =
          more && std::any_of(open.begin(), open.end(), [&](const Open& o) { return o.name == more->name; });
      if (!more || is_open || open.size() == kDeepest) {
        add(inner, token.offset);
      } else {
        open.push_back(*more);
      }
    }
  }

  void add(ShaderToken token, std::size_t offset) {
    if (++steps_ >= kMostShaderTokens && token.kind != MacroTokenKind::end) {
      if (!overflowed_) faults_.add(offset, "the text is longer than " + std::to_string(kMostShaderTokens) + " words");
      overflowed_ = true;
      return;
    }
    token.offset = offset;
    out_.tokens.push_back(token);
  }

  std::vector<ShaderToken> tokens_;
  SourceFaults& faults_;
  SourceFaults& notes_;
  std::size_t at_ = 0;
  std::map<std::string_view, ShaderMacro> macros_;
  std::vector<Condition> conditions_;
  std::set<std::string> asked_;  // names without a value that were reported
  ShaderTokens out_;
  std::size_t steps_ = 0;  // of replacing; names may stand for nothing
  bool overflowed_ = false;
};

}  // namespace

ShaderTokens preprocess_shader(std::vector<ShaderToken> tokens, const std::vector<Definition>& definitions,
                               SourceFaults& faults, SourceFaults& notes) {
  ShaderTokens out = ShaderPreprocessor(std::move(tokens), definitions, faults, notes).run();
  if (out.tokens.empty() || out.tokens.back().kind != MacroTokenKind::end) {
    const std::size_t offset = out.tokens.empty() ? 0 : out.tokens.back().offset;
    out.tokens.push_back({MacroTokenKind::end_of_line, offset, {}});
    out.tokens.push_back({MacroTokenKind::end, offset, {}});
  }
  return out;
}

}  // namespace ninebit::detail

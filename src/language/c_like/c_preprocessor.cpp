#include "src/language/c_like/c_preprocessor.h"

#include <algorithm>
#include <array>
#include <utility>

#include "ninebit/language/source_text.h"
#include "src/language/c_like/c_condition.h"
#include "src/language/source/source_faults.h"
#include "src/system/nearest_name.h"

namespace ninebit::code {

Preprocessor::Preprocessor(std::string_view text, Macros& macros, PreprocessorOptions options)
    : macros_(macros), options_(std::move(options)), expander_(macros, [this] { return next(); }) {
  texts_.push_back({.lexer = Lexer(text)});
}

// The next token that is neither in a directive nor in a part that is left out.
Token Preprocessor::next() {
  while (true) {
    Text& text = texts_.back();
    Token token = text.held ? *text.held : text.lexer.next();
    text.held.reset();
    if (token.kind == Token::Kind::end) {
      if (texts_.size() == 1) return token;
      end_text();
      texts_.pop_back();
      continue;
    }
    if (token.is("#") && token.begins_line) {
      hash_ = token;
      directive();
    } else if (reads()) {
      if (text.include) {
        token.offset = text.include->offset;
        token.end = text.include->end;
        token.is_made = true;
      }
      return token;
    }
  }
}

// Reads the rest of the line. The first token of the next line is held.
void Preprocessor::directive() {
  std::vector<Token> line;
  Text& text = texts_.back();
  Token token = text.lexer.next();
  for (; token.kind != Token::Kind::end && !token.begins_line; token = text.lexer.next()) line.push_back(token);
  text.held = token;
  if (line.empty() || !line[0].is_name()) return;
  const Token directive = line[0];
  line.erase(line.begin());
  obey(directive, line);
}

void Preprocessor::obey(const Token& directive, const std::vector<Token>& line) {
  const auto chosen = [&] {
    const Answer said = answer(directive, line);
    if (!said.fault.empty()) fault(hash_, "#" + std::string(directive.text) + ": " + said.fault);
    const bool is_included = texts_.size() > 1;
    if (is_included && !said.unknown.empty()) {
      fault(hash_, detail::quoted(said.unknown) + " is not defined, and a condition depends on it");
    }
    return options_.reads && !is_included ? options_.reads(directive, line, said) : said.value;
  };
  if (directive.is("if") || directive.is("ifdef") || directive.is("ifndef")) {
    const bool names = directive.is("if") || (!line.empty() && line[0].is_name());
    if (!names && reads()) fault(hash_, "expected a name after #" + std::string(directive.text));
    OpenGroup group{.hash = hash_, .depth = texts_.size(), .outer = reads()};
    group.reads = group.taken = group.outer && chosen();
    open_.push_back(group);
  } else if (directive.is("else") || directive.is("elif") || directive.is("endif")) {
    // A file does not go on with another one's conditions.
    if (open_.empty() || open_.back().depth < texts_.size()) {
      return fault(hash_, "'#" + std::string(directive.text) + "' without #if");
    }
    if (directive.is("endif")) return open_.pop_back();
    OpenGroup& group = open_.back();
    if (group.has_else) fault(hash_, "'#" + std::string(directive.text) + "' after #else");
    group.has_else = directive.is("else");
    group.reads = group.outer && !group.taken && chosen();
    group.taken = group.taken || group.reads;
  } else if (!reads()) {
    return;
  } else if (directive.is("define")) {
    if (names_macro(directive, line)) define(line);
  } else if (directive.is("undef")) {
    if (names_macro(directive, line)) macros_.all.erase(line[0].text);
  } else if (directive.is("include")) {
    include(directive, line);
  } else if (directive.is("pragma") && !line.empty() && line[0].is("once")) {
    once_.insert(texts_.back().name);
  } else if (directive.is("error")) {
    fault(hash_, "the text ends itself with #error");
  } else if (constexpr std::array<std::string_view, 12> kKnown{"define", "undef", "include", "if", "ifdef", "ifndef",
                                                               "elif", "else", "endif", "line", "error", "pragma"};
             std::find(kKnown.begin(), kKnown.end(), directive.text) == kKnown.end()) {
    fault(directive, "'#" + std::string(directive.text) + "' is not a line of the preprocessor" +
                         did_you_mean(directive.text, kKnown));
  }
}

void Preprocessor::fault(const Token& at, const std::string& message) const {
  if (!options_.fault) return;
  options_.fault(outer(at), (texts_.size() == 1 ? "" : detail::quoted(texts_.back().name) + ": ") + message);
}

void Preprocessor::finish() {
  end_text();
}

// Reports a condition that the text leaves open, and closes all of the text's.
void Preprocessor::end_text() {
  if (open_.empty() || open_.back().depth < texts_.size()) return;
  fault(open_.back().hash, "unterminated condition; expected #endif");
  while (!open_.empty() && open_.back().depth == texts_.size()) open_.pop_back();
}

// Whether a line names a macro that the text may change.
bool Preprocessor::names_macro(const Token& directive, const std::vector<Token>& line) {
  if (line.empty() || !line[0].is_name()) {
    fault(directive, "expected a name after #" + std::string(directive.text));
    return false;
  }
  const auto found = macros_.all.find(line[0].text);
  if (found == macros_.all.end() || !found->second.is_given) return true;
  found->second.is_used = true;
  return false;
}

Answer Preprocessor::answer(const Token& directive, const std::vector<Token>& line) {
  if (directive.is("else")) return {true, true, {}, {}};
  const auto value_of = [&](std::string_view name) {
    return options_.value_of ? options_.value_of(name) : std::optional<std::string_view>{};
  };
  const auto is_defined = [&](std::string_view name) {
    const auto macro = macros_.all.find(name);
    if (macro != macros_.all.end()) macro->second.is_used = true;
    return macro != macros_.all.end() || value_of(name).has_value();
  };
  if (!directive.is("if") && !directive.is("elif")) {
    const bool known = !line.empty() && is_defined(line[0].text);
    return {known == directive.is("ifdef"), known, {}, {}};
  }
  // The name behind `defined` is not replaced.
  std::vector<Token> asked = line;
  for (std::size_t i = 1; i < asked.size(); ++i) {
    const bool parenthesis = asked[i - 1].is("(") && i > 1;
    asked[i].is_final = asked[i - (parenthesis ? 2 : 1)].is("defined");
  }
  std::vector<Token> expression = expand_tokens(macros_, asked);
  constexpr int kMostReplaced = 1000;
  int replaced = 0;
  for (std::size_t i = 0; i < expression.size() && replaced < kMostReplaced; ++i) {
    const bool is_used = expression[i].is_name() && !expression[i].is_final && !expression[i].is("defined");
    const auto value = is_used ? value_of(expression[i].text) : std::nullopt;
    if (!value) continue;
    const std::vector<Token> body = expand_tokens(macros_, tokens_of(*value));
    const auto at = expression.erase(expression.begin() + static_cast<std::ptrdiff_t>(i));
    expression.insert(at, body.begin(), body.end());
    ++replaced;
    --i;
  }
  bool is_sure = true;
  const auto value = condition_value(expression, [&](std::string_view name) {
    const bool known = is_defined(name);
    is_sure = is_sure && known;
    return known;
  });
  return {value.holds, is_sure && value.unknown.empty() && value.fault.empty(), value.unknown, value.fault};
}

void Preprocessor::define(const std::vector<Token>& line) {
  Macro macro;
  std::size_t at = 1;
  macro.has_parameters = line.size() > 1 && line[1].is("(") && !line[1].after_blank;
  if (macro.has_parameters) {
    for (at = 2; at < line.size() && !line[at].is(")"); ++at) {
      macro.is_variadic = macro.is_variadic || line[at].is("...");
      const bool named = line[at].is_name() && at + 1 < line.size() && line[at + 1].is("...");  // args...
      if (line[at].is_name()) macro.parameters.push_back(line[at].text);
      if (line[at].is("...")) macro.parameters.push_back("__VA_ARGS__");
      if (named) ++at, macro.is_variadic = true;
    }
    ++at;
  }
  if (at < line.size()) macro.body.assign(line.begin() + static_cast<std::ptrdiff_t>(at), line.end());
  macros_.all[line[0].text] = std::move(macro);
}

void Preprocessor::include(const Token& directive, const std::vector<Token>& line) {
  constexpr std::size_t kMostIncluded = 16, kMostFiles = 200;  // inside of each other, and in all
  std::string written;
  for (const Token& token : line) written += token.text;
  const bool named = line.size() == 1 && line[0].kind == Token::Kind::text && written.size() > 2;
  const std::string_view name = named ? line[0].text.substr(1, written.size() - 2) : std::string_view();
  if (named && once_.contains(name)) return;
  if (too_many_included_) return;
  const bool reads_file = options_.include && named;
  const auto too_many = [&](const std::string& why) {
    too_many_included_ = true;
    if (options_.endless) options_.endless(outer(directive), detail::quoted(name) + why);
  };
  if (reads_file && (texts_.size() > kMostIncluded || included_ == kMostFiles)) {
    const bool repeats =
        std::any_of(texts_.begin(), texts_.end(), [&](const Text& one) { return one.include && one.name == name; });
    return too_many(repeats ? " includes itself"
                            : " is one included file too many; expected at most 16 inside "
                              "of each other, and 200 in all");
  }
  const std::string* const text = reads_file ? options_.include(name) : nullptr;
  if (text == nullptr) {
    if (options_.skipped) options_.skipped(outer(directive), written);
    return;
  }
  ++included_;
  included_bytes_ += text->size();
  if (included_bytes_ > kMaxSourceBytes) {
    return too_many(" makes the included files longer than " + std::to_string(kMaxSourceBytes) + " bytes together");
  }
  texts_.push_back({Lexer(*text), {}, outer(directive), name});
}

}  // namespace ninebit::code

#include "src/language/c_like/c_preprocessor.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include "ninebit/language/source_text.h"
#include "src/language/c_like/c_number.h"
#include "src/language/source/source_faults.h"
#include "src/system/nearest_name.h"

namespace ninebit::code {
namespace {

constexpr int kDeepestCondition = 64;                              // parentheses in parentheses
constexpr std::size_t kMostConditionBytes = std::size_t{1} << 20;  // with names replaced

// A number of an expression, or why there is none: only what decides the condition matters.
struct ConditionNumber {
  Number number = int_number(0, kInt64);  // signed or unsigned, of 64 bits
  std::string unknown{}, fault{};

  [[nodiscard]] bool is_sure() const { return unknown.empty() && fault.empty(); }
};

ConditionNumber truth_number(bool value) {
  return {.number = int_number(value ? 1 : 0, kInt64)};
}

// A result with what is not known of the operands.
ConditionNumber from_operands(ConditionNumber result, const ConditionNumber& a, const ConditionNumber& b) {
  result.unknown = a.unknown.empty() ? b.unknown : a.unknown;
  result.fault = a.fault.empty() ? b.fault : a.fault;
  return result;
}

std::string text_of(const Number& number) {
  return number.kinds == kUint64 ? std::to_string(static_cast<std::uint64_t>(number.integer))
                                 : std::to_string(number.integer);
}

ConditionNumber applied(std::string_view mark, const ConditionNumber& a, const ConditionNumber& b) {
  if (mark == "&&" || mark == "||") {
    const bool decides = mark == "||";
    const auto decided = [&](const ConditionNumber& one) { return one.is_sure() && one.number.is_true() == decides; };
    if (decided(a) || (a.fault.empty() && decided(b))) return truth_number(decides);
    const bool left = a.number.is_true(), right = b.number.is_true();
    return from_operands(truth_number(decides ? left || right : left && right), a, b);
  }
  auto value = calculate(mark, a.number, b.number);
  if (value && value->kinds == kInt32) value = convert(*value, kInt64);  // of a comparison
  ConditionNumber out = from_operands({.number = value.value_or(Number{.kinds = kInt64})}, a, b);
  if (!value && out.is_sure()) {
    out.fault = text_of(a.number) + " " + std::string(mark) + " " + text_of(b.number) + " has no value";
  }
  return out;
}

ConditionNumber number_of(std::string_view text) {
  const auto value = read_number(std::string(text) + "u");
  if (!value) return {.fault = detail::quoted(text) + " is not a whole number of 64 bits"};
  const bool is_unsigned = value->integer < 0 || text.find_first_of("uU") != std::string_view::npos;
  return {.number = int_number(value->integer, is_unsigned ? kUint64 : kInt64)};
}

class ConditionParser {
 public:
  ConditionParser(const std::vector<Token>& tokens, const std::function<bool(std::string_view)>& is_defined)
      : tokens_(tokens), is_defined_(is_defined) {}

  ConditionValue read() {
    const ConditionNumber number = conditional(0);
    if (!at_end()) fail("an operator");
    const std::string& fault = fault_.empty() ? number.fault : fault_;
    return {.holds = number.number.is_true() && fault.empty(), .unknown = number.unknown, .fault = fault};
  }

 private:
  ConditionNumber conditional(int depth) {
    const ConditionNumber which = binary(1, depth);
    if (!takes("?")) return which;
    const ConditionNumber yes = conditional(depth + 1);
    if (!takes(":")) fail("':'");
    const ConditionNumber no = conditional(depth + 1);
    ConditionNumber out = which.number.is_true() ? yes : no;
    if (yes.number.kinds == kUint64 || no.number.kinds == kUint64) out.number.kinds = kUint64;
    return which.is_sure() ? out : from_operands(out, which, out);
  }

  ConditionNumber binary(int least, int depth) {
    ConditionNumber left = unary(depth);
    while (true) {
      const Token op = peek();
      if (precedence(op) < least) return left;
      ++at_;
      left = applied(op.text, left, binary(precedence(op) + 1, depth));
    }
  }

  ConditionNumber unary(int depth) {
    if (depth > kDeepestCondition) {
      fail("at most " + std::to_string(kDeepestCondition) + " brackets and signs in each other");
      return {};
    }
    if (takes("!")) {
      const ConditionNumber operand = unary(depth + 1);
      return from_operands(truth_number(!operand.number.is_true()), operand, operand);
    }
    if (takes("+")) return unary(depth + 1);
    if (takes("-")) return applied("-", {}, unary(depth + 1));
    if (takes("~")) return applied("^", {.number = int_number(-1, kInt64)}, unary(depth + 1));
    if (takes("(")) {
      ConditionNumber inner = conditional(depth + 1);
      if (!takes(")")) fail("')'");
      return inner;
    }
    return primary();
  }

  ConditionNumber primary() {
    const Token token = peek();
    if (token.kind == Token::Kind::number) {
      ++at_;
      return number_of(token.text);
    }
    if (!token.is_name()) {
      fail("a number, a name or defined(NAME)");
      return {};
    }
    ++at_;
    if (token.text == "defined") return defined();
    const std::string name(token.text);
    if (!peek().is("(")) return {.unknown = name};
    fault_ = fault_.empty() ? detail::quoted(name) + " has parameters; only names without them are computed" : fault_;
    at_ = tokens_.size();
    return {};
  }

  // NAME or (NAME) behind `defined`.
  ConditionNumber defined() {
    const bool bracket = takes("(");
    if (!peek().is_name()) {
      fail("a name after defined");
      return {};
    }
    const ConditionNumber out = truth_number(is_defined_(tokens_[at_++].text));
    if (bracket && !takes(")")) fail("')'");
    return out;
  }

  [[nodiscard]] bool at_end() const { return at_ >= tokens_.size(); }
  [[nodiscard]] Token peek() const { return at_end() ? Token{} : tokens_[at_]; }

  bool takes(std::string_view mark) {
    if (peek().kind != Token::Kind::punctuation || peek().text != mark) return false;
    ++at_;
    return true;
  }

  // Keeps the first fault of the expression, and ends it.
  void fail(const std::string& expected) {
    if (fault_.empty()) {
      fault_ = "expected " + expected + "; found " + (at_end() ? "the end of the line" : detail::quoted(peek().text));
    }
    at_ = tokens_.size();
  }

  const std::vector<Token>& tokens_;
  const std::function<bool(std::string_view)>& is_defined_;
  std::size_t at_ = 0;
  std::string fault_;
};

}  // namespace

ConditionValue condition_value(const std::vector<Token>& expression,
                               const std::function<bool(std::string_view)>& is_defined) {
  std::size_t bytes = 0;
  for (const Token& token : expression) bytes += token.text.size() + 1;
  if (bytes > kMostConditionBytes) return {.fault = "the condition is longer than 1 MiB with names replaced"};
  return ConditionParser(expression, is_defined).read();
}

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
  } else if (std::find(kDirectives.begin(), kDirectives.end(), directive.text) == kDirectives.end()) {
    fault(directive, "'#" + std::string(directive.text) + "' is not a line of the preprocessor" +
                         did_you_mean(directive.text, kDirectives));
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

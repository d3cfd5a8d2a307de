#include "src/language/source_code/code_macros.h"

#include <algorithm>

#include "src/language/gl_calls/gl_calls_spelling.h"

namespace ninebit::code {
namespace {

constexpr std::size_t kMostNested = 64;

// Names that mean something to combiners are never macros: headers of the time define them as function pointers.
bool is_reserved(std::string_view name) {
  return detail::find_gl_call(name) != nullptr || detail::value_of_name(name).has_value();
}

}  // namespace

const Macro* MacroExpander::find(std::string_view name) const {
  const auto found = macros_.find(name);
  return found == macros_.end() ? nullptr : &found->second;
}

Token MacroExpander::raw() {
  if (peeked_) {
    const Token token = *peeked_;
    peeked_.reset();
    return token;
  }
  while (!expansions_.empty() && expansions_.back().at == expansions_.back().tokens.size()) expansions_.pop_back();
  if (expansions_.empty()) return next_();
  return expansions_.back().tokens[expansions_.back().at++];
}

Token MacroExpander::peek_raw() {
  if (!peeked_) peeked_ = raw();
  return *peeked_;
}

Token MacroExpander::take(std::size_t most) {
  while (true) {
    const Token token = raw();
    if (made_ > most) too_many_ = true;
    if (too_many_) return {};
    if (!token.is_name() || !expand(token)) return token;
  }
}

// Whether the name is a macro, whose tokens then come next.
bool MacroExpander::expand(const Token& name) {
  const auto found = macros_.find(name.text);
  if (found == macros_.end() || is_reserved(name.text) || expansions_.size() >= kMostNested) return false;
  const Macro& macro = found->second;
  const auto is_active = [&](const Expansion& one) { return one.macro == &macro; };
  if (std::any_of(expansions_.begin(), expansions_.end(), is_active)) return false;
  Arguments given;
  if (macro.has_parameters) {
    if (!peek_raw().is("(")) return false;
    auto read = arguments(macro);
    if (!read) return false;
    given = *std::move(read);
  }
  std::vector<Token> tokens = substituted(macro, given, name);
  made_ += tokens.size() + 1;
  expansions_.push_back({&macro, std::move(tokens), 0});
  return true;
}

// From the opening parenthesis, which comes next, to the closing one. Empty: the file ends before it.
std::optional<MacroExpander::Arguments> MacroExpander::arguments(const Macro& macro) {
  raw();
  Arguments all(1);
  std::size_t depth = 0;
  for (std::size_t count = 0;; ++count) {
    const Token token = raw();
    if (token.kind == Token::Kind::end || count > kMostTokensOfArguments) return std::nullopt;
    if (depth == 0 && token.is(")")) return all;
    const bool variadic = macro.is_variadic && all.size() == macro.parameters.size();
    if (depth == 0 && token.is(",") && !variadic) {
      all.emplace_back();
      continue;
    }
    if (token.is("(") || token.is("{") || token.is("[")) ++depth;
    if ((token.is(")") || token.is("}") || token.is("]")) && depth > 0) --depth;
    all.back().push_back(token);
  }
}

// Joins the last token of `out` and the first of `more` to one.
void MacroExpander::paste(std::vector<Token>& out, const std::vector<Token>& more) {
  if (out.empty() || more.empty()) {
    out.insert(out.end(), more.begin(), more.end());
    return;
  }
  pasted_.push_back(std::string(out.back().text) + std::string(more.front().text));
  out.back().text = pasted_.back();
  if (out.back().kind == Token::Kind::punctuation) out.back().kind = more.front().kind;
  out.insert(out.end(), more.begin() + 1, more.end());
}

// #parameter: the argument's text as a literal.
Token MacroExpander::quoted_tokens(const std::vector<Token>& tokens, const Token& name) {
  std::string text = "\"";
  for (const Token& token : tokens) {
    if (token.after_blank && text.size() > 1) text += ' ';
    for (const char c : token.text) text += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
  }
  pasted_.push_back(text + '"');
  Token out = name;
  out.kind = Token::Kind::text;
  out.text = pasted_.back();
  return out;
}

std::vector<Token> MacroExpander::substituted(const Macro& macro, const Arguments& arguments, const Token& name) {
  std::vector<Token> out;
  bool pastes = false;
  for (std::size_t i = 0; i < macro.body.size(); ++i) {
    Token token = macro.body[i];
    if (token.is("##")) {
      pastes = true;
      continue;
    }
    std::vector<Token> part;
    const bool quotes = token.is("#") && i + 1 < macro.body.size();
    if (quotes) token = macro.body[++i];
    const auto parameter = std::find(macro.parameters.begin(), macro.parameters.end(), token.text);
    if (token.is_name() && parameter != macro.parameters.end()) {
      const auto which = static_cast<std::size_t>(parameter - macro.parameters.begin());
      if (which < arguments.size()) part = arguments[which];
      if (quotes) part.assign(1, quoted_tokens(part, name));
    } else {
      token.offset = name.offset;
      token.end = name.end;
      token.begins_line = false;
      part.push_back(token);
    }
    if (out.size() + part.size() > kMostTokensOfArguments) break;
    if (pastes) {
      paste(out, part);
    } else {
      out.insert(out.end(), part.begin(), part.end());
    }
    pastes = false;
  }
  return out;
}

}  // namespace ninebit::code

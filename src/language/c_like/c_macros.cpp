#include "src/language/c_like/c_macros.h"

#include <algorithm>

#include "src/language/c_like/c_lexer.h"

namespace ninebit::code {
namespace {

constexpr std::size_t kMostNested = 64;

// A new token at the place of a macro's name.
Token made_at(const Token& name, Token token) {
  token.offset = name.offset;
  token.end = name.end;
  token.begins_line = false;
  token.is_made = true;
  return token;
}

}  // namespace

std::vector<Token> expand_tokens(Macros& macros, const std::vector<Token>& tokens, std::size_t depth) {
  std::size_t at = 0;
  MacroExpander expander(
      macros, [&] { return at < tokens.size() ? tokens[at++] : Token{}; }, depth);
  std::vector<Token> out;
  for (Token token = expander.take(); token.kind != Token::Kind::end; token = expander.take()) out.push_back(token);
  return out;
}

Token MacroExpander::raw() {
  if (!held_.empty()) {
    const Token token = held_.front();
    held_.pop_front();
    return token;
  }
  while (!expansions_.empty() && expansions_.back().at == expansions_.back().tokens.size()) expansions_.pop_back();
  if (expansions_.empty()) return next_();
  return expansions_.back().tokens[expansions_.back().at++];
}

Token MacroExpander::take() {
  while (true) {
    Token token = raw();
    if (too_many()) return {};
    if (!token.is_name() || token.is_final || !expand(token)) return token;
  }
}

bool MacroExpander::is_active(const Macro& macro) const {
  return std::any_of(expansions_.begin(), expansions_.end(), [&](const Expansion& one) { return one.macro == &macro; });
}

// Whether the name is a macro, whose tokens then come next.
bool MacroExpander::expand(Token& name) {
  const auto found = macros_.all.find(name.text);
  if (found == macros_.all.end() || expansions_.size() + depth_ >= kMostNested) return false;
  found->second.is_used = true;
  const Macro& macro = found->second;
  if (macros_.is_reserved && macros_.is_reserved(name.text, macro)) return false;
  if (is_active(macro)) {
    name.is_final = true;
    return false;
  }
  Arguments given;
  if (macro.has_parameters) {
    Token next = raw();
    if (!next.is("(")) {
      held_.push_front(next);
      return false;
    }
    auto read = arguments(macro);
    if (!read) return false;
    given = *std::move(read);
  }
  std::vector<Token> tokens = substituted(macro, given, name);
  macros_.made += tokens.size() + 1;
  expansions_.push_back({&macro, std::move(tokens), 0});
  return true;
}

// From behind the opening parenthesis to the closing one. Empty: the text ends before it.
std::optional<MacroExpander::Arguments> MacroExpander::arguments(const Macro& macro) {
  Arguments all(1);
  std::size_t depth = 0;
  for (std::size_t count = 0;; ++count) {
    const Token token = raw();
    if (token.kind == Token::Kind::end || count > kMostTokensOfMacro) return std::nullopt;
    if (depth == 0 && token.is(")")) return all;
    const bool variadic = macro.is_variadic && all.size() == macro.parameters.size();
    if (depth == 0 && token.is(",") && !variadic) {
      all.emplace_back();
      continue;
    }
    if (token.is("(")) ++depth;
    if (token.is(")")) --depth;
    all.back().push_back(token);
  }
}

std::vector<Token> MacroExpander::expanded(const std::vector<Token>& tokens) {
  if (std::none_of(tokens.begin(), tokens.end(), [](const Token& one) { return one.is_name(); })) return tokens;
  std::vector<Token> out = expand_tokens(macros_, tokens, depth_ + expansions_.size() + 1);
  // A macro that is being expanded here stays as it is in its argument.
  for (Token& one : out) {
    const auto found = one.is_name() ? macros_.all.find(one.text) : macros_.all.end();
    if (found != macros_.all.end() && is_active(found->second)) one.is_final = true;
  }
  return out;
}

// Joins the last token of `out` and the first of `more` to one.
void MacroExpander::paste(std::vector<Token>& out, const std::vector<Token>& more) {
  if (out.empty() || more.empty()) {
    out.insert(out.end(), more.begin(), more.end());
    return;
  }
  macros_.kept.push_back(std::string(out.back().text) + std::string(more.front().text));
  Token joined = Lexer(macros_.kept.back()).next();
  if (joined.text.size() != macros_.kept.back().size()) joined.kind = Token::Kind::punctuation;  // no token
  joined.text = macros_.kept.back();
  joined.after_blank = out.back().after_blank;
  out.back() = made_at(out.back(), joined);
  out.insert(out.end(), more.begin() + 1, more.end());
}

// #parameter: the argument's text as a literal.
Token MacroExpander::quoted_tokens(const std::vector<Token>& tokens, const Token& name) {
  std::string text = "\"";
  for (const Token& token : tokens) {
    if (token.after_blank && text.size() > 1) text += ' ';
    const bool is_literal = token.kind == Token::Kind::text || token.kind == Token::Kind::character;
    for (const char c : token.text) {
      text += is_literal && (c == '"' || c == '\\') ? std::string("\\") + c : std::string(1, c);
    }
  }
  macros_.kept.push_back(text + '"');
  Token out = made_at(name, name);
  out.kind = Token::Kind::text;
  out.text = macros_.kept.back();
  return out;
}

std::vector<Token> MacroExpander::substituted(const Macro& macro, const Arguments& arguments, const Token& name) {
  std::vector<Token> out;
  const auto parameter_of = [&](const Token& token) -> const std::vector<Token>* {
    static const std::vector<Token> kNone;
    const auto found = std::find(macro.parameters.begin(), macro.parameters.end(), token.text);
    if (!token.is_name() || found == macro.parameters.end()) return nullptr;
    const auto which = static_cast<std::size_t>(found - macro.parameters.begin());
    return which < arguments.size() ? &arguments[which] : &kNone;
  };
  bool pastes = false;
  for (std::size_t i = 0; i < macro.body.size(); ++i) {
    const Token& token = macro.body[i];
    if (token.is("##")) {
      pastes = true;
      continue;
    }
    const bool quotes = token.is("#") && macro.has_parameters && i + 1 < macro.body.size();
    const std::vector<Token>* const given = parameter_of(quotes ? macro.body[i + 1] : token);
    const bool joins = pastes || (i + 1 < macro.body.size() && macro.body[i + 1].is("##"));
    std::vector<Token> part;
    if (quotes && given != nullptr) {
      part.push_back(quoted_tokens(*given, name));
      ++i;
    } else if (given != nullptr) {
      part = joins ? *given : expanded(*given);
      if (!part.empty()) part[0].after_blank = token.after_blank;
    } else {
      part.push_back(made_at(name, token));
    }
    if (out.size() + part.size() > kMostTokensOfMacro) break;
    // A comma before ## and no further arguments is left out.
    const bool no_more = pastes && given != nullptr && part.empty() && !out.empty() && out.back().is(",");
    if (no_more) out.pop_back();
    if (pastes) {
      const bool variadic = given != nullptr && token.is("__VA_ARGS__") && !out.empty() && out.back().is(",");
      variadic ? void(out.insert(out.end(), part.begin(), part.end())) : paste(out, part);
    } else {
      out.insert(out.end(), part.begin(), part.end());
    }
    pastes = false;
  }
  if (!out.empty()) out[0].begins_line = name.begins_line;
  return out;
}

}  // namespace ninebit::code

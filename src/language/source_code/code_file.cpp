#include "src/language/source_code/code_file.h"

#include <algorithm>
#include <optional>

#include "src/language/gl_calls/gl_calls_spelling.h"
#include "src/language/source_code/code_conditions.h"
#include "src/language/source_code/code_lexer.h"
#include "src/language/source_code/code_macros.h"
#include "src/language/source_code/code_xbox.h"

namespace ninebit::code {
namespace {

// Reads the tokens of a C-like file, obeying its directives.
class Preprocessor {
 public:
  Preprocessor(File& file, const std::vector<Definition>& definitions, detail::SourceFaults& faults,
               detail::SourceFaults& notes)
      : file_(file),
        faults_(faults),
        lexer_(file.text, Language::c, 0, file.text.size()),
        expander_([this] { return next(); }, file.pasted),
        conditions_(file, definitions, expander_, notes) {}

  void read() {
    while (true) {
      Token token = expander_.take(kMostTokens);
      if (expander_.too_many() || file_.tokens.size() >= kMostTokens) {
        faults_.add(token.offset, "more than " + std::to_string(kMostTokens) + " tokens, macros expanded");
        token = {};
      }
      file_.tokens.push_back(token);
      if (token.kind == Token::Kind::end) return;
    }
  }

 private:
  // The next token that is neither in a directive nor in a part that is left out.
  Token next() {
    while (true) {
      const Token token = held_ ? *held_ : lexer_.next();
      held_.reset();
      if (token.kind == Token::Kind::end) return token;
      if (token.is("#") && token.begins_line) {
        directive();
      } else if (conditions_.reads()) {
        return token;
      }
    }
  }

  // Reads the rest of the line. The first token of the next line is held.
  void directive() {
    std::vector<Token> line;
    Token token = lexer_.next();
    for (; token.kind != Token::Kind::end && !token.begins_line; token = lexer_.next()) line.push_back(token);
    held_ = token;
    if (line.empty() || !line[0].is_name()) return;
    const std::vector<Token> rest(line.begin() + 1, line.end());
    if (conditions_.obey(line[0], rest) || !conditions_.reads()) return;
    if (line[0].is("define")) define(rest);
    if (line[0].is("undef") && !rest.empty()) expander_.undefine(rest[0].text);
  }

  void define(const std::vector<Token>& line) {
    if (line.empty() || !line[0].is_name()) return;
    Macro macro;
    std::size_t at = 1;
    macro.has_parameters = line.size() > 1 && line[1].is("(") && !line[1].after_blank;
    if (macro.has_parameters) {
      for (at = 2; at < line.size() && !line[at].is(")"); ++at) {
        macro.is_variadic = macro.is_variadic || line[at].is("...");
        if (line[at].is_name()) macro.parameters.push_back(line[at].text);
        if (line[at].is("...")) macro.parameters.push_back("__VA_ARGS__");
      }
      ++at;
    }
    if (at < line.size()) macro.body.assign(line.begin() + static_cast<std::ptrdiff_t>(at), line.end());
    expander_.define(line[0].text, std::move(macro));
  }

  File& file_;
  detail::SourceFaults& faults_;
  Lexer lexer_;
  MacroExpander expander_;
  Conditions conditions_;
  std::optional<Token> held_;
};

// Whether a name that ends here is called: "(" follows, or ")(".
bool is_called(std::string_view text, std::size_t end) {
  const auto skip = [&] {
    while (end < text.size() && detail::is_blank(text[end])) ++end;
  };
  skip();
  if (end < text.size() && text[end] == ')') {
    ++end;
    skip();
  }
  return end < text.size() && text[end] == '(';
}

// A brace also closes what was left open inside of it; a stray bracket closes nothing. What is never closed ends with
// the file.
std::vector<std::uint32_t> closing_brackets(const std::vector<Token>& tokens) {
  std::vector<std::uint32_t> closing(tokens.size()), open;
  const auto last = static_cast<std::uint32_t>(tokens.size() - 1);
  for (std::uint32_t i = 0; i < tokens.size(); ++i) {
    closing[i] = i;
    if (tokens[i].kind != Token::Kind::punctuation || tokens[i].text.size() != 1) continue;
    const char c = tokens[i].text[0];
    if (c == '(' || c == '[' || c == '{') {
      open.push_back(i);
      closing[i] = last;
    } else if (c == ')' || c == ']' || c == '}') {
      const char opener = c == ')' ? '(' : c == ']' ? '[' : '{';
      while (c == '}' && !open.empty() && tokens[open.back()].text[0] != '{') {
        closing[open.back()] = i == 0 ? 0 : i - 1;
        open.pop_back();
      }
      if (open.empty() || tokens[open.back()].text[0] != opener) continue;
      closing[open.back()] = i;
      open.pop_back();
    }
  }
  return closing;
}

}  // namespace

std::vector<std::uint32_t> calls_of(std::string_view text, Language language) {
  constexpr std::string_view kPart = "ombiner", kPascalsPart = "OMBINER";
  std::vector<std::uint32_t> found;
  const auto letters = language == Language::pascal ? detail::NameCase::any : detail::NameCase::exact;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const bool starts = (text[at] == 'o' || text[at] == 'O') &&
                        (text.substr(at).starts_with(kPart) || text.substr(at).starts_with(kPascalsPart));
    const bool parses = text[at] == 'n' && text.substr(at).starts_with("nvparse");
    const bool is_word = text[at] == 'P' && text.substr(at).starts_with("PS") && language == Language::c;
    if (!starts && !parses && !is_word) continue;
    std::size_t begin = at, end = at;
    while (begin > 0 && detail::is_word(text[begin - 1]) && at - begin < 64) --begin;
    while (end < text.size() && detail::is_word(text[end]) && end - at < 64) ++end;
    if (is_word && begin == at && assigns_word(text, begin, end)) found.push_back(static_cast<std::uint32_t>(begin));
    const bool names = text.substr(begin, end - begin) == "nvparse" ||
                       detail::find_gl_call(text.substr(begin, end - begin), letters) != nullptr;
    if (names && is_called(text, end)) {
      found.push_back(static_cast<std::uint32_t>(begin));
    }
    at = end - 1;
  }
  return found;
}

bool File::calls_between(std::size_t begin, std::size_t end) const {
  const auto first = std::lower_bound(calls.begin(), calls.end(), begin);
  return first != calls.end() && *first < end;
}

void read_tokens(File& file) {
  Lexer lexer(file.text, file.language, 0, file.text.size());
  for (bool end = false; !end;) {
    const Token token = file.tokens.size() < kMostTokens ? lexer.next() : Token{};
    file.tokens.push_back(token);
    end = token.kind == Token::Kind::end;
  }
  file.closing = closing_brackets(file.tokens);
}

File read_file(const SourceText& source, const std::vector<Definition>& definitions, detail::SourceFaults& faults,
               detail::SourceFaults& notes) {
  File file{.text = source.text, .language = language_of(source.text)};
  file.calls = calls_of(source.text, file.language);
  if (file.language == Language::pascal) {
    read_tokens(file);
    if (file.tokens.size() > kMostTokens) faults.add(0, "more than " + std::to_string(kMostTokens) + " tokens");
    return file;
  }
  Preprocessor(file, definitions, faults, notes).read();
  file.closing = closing_brackets(file.tokens);
  return file;
}

}  // namespace ninebit::code

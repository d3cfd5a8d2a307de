#include "ninebit/language/source_code.h"

#include <utility>

#include "src/language/pixel_shader/shader_literal.h"
#include "src/language/source/string_literals.h"
#include "src/language/source_code/code_lexer.h"
#include "src/language/source_code/code_units.h"

namespace ninebit {
namespace {

// Whether a token shows that a text is more than a sequence of calls.
bool shows_structure(const code::Token& token) {
  if (token.is("#") && token.begins_line) return true;
  for (const std::string_view word : {"if", "for", "while", "switch", "return", "void", "class", "struct", "namespace",
                                      "begin", "procedure", "public", "private", "else", "do", "import", "using"}) {
    if (token.is(word)) return true;
  }
  return false;
}

// Whether a name is that of a GL function, also of a pointer to one: glEnable, qglEnable, pfn_glEnable.
bool names_gl_function(std::string_view name) {
  constexpr std::size_t kLongestPrefix = 6;
  const std::size_t at = name.find("gl");
  const std::string_view own = at <= kLongestPrefix ? name.substr(at + 2) : std::string_view();
  const auto is_upper = [](char c) { return c >= 'A' && c <= 'Z'; };
  return own.size() > 2 && is_upper(own[0]) && !is_upper(own[1]) && own[1] != '_';
}

bool is_page(std::string_view text) {
  return text.find("\n```") != std::string_view::npos || text.find("\n## ") != std::string_view::npos;
}

}  // namespace

bool is_gl_source_code(std::string_view text) {
  if (text.size() > kMaxSourceBytes || is_page(text)) return false;
  const code::Language language = code::language_of(text);
  bool has_function = language == code::Language::pascal, calls_gl = false, is_name = false;
  // Whether each parenthesis that is open stands behind a name, as parameters do.
  std::vector<bool> open;
  bool closed_parameters = false;
  std::string_view last;
  code::Lexer lexer(text, language, 0, text.size());
  for (code::Token token = lexer.next(); token.kind != code::Token::Kind::end; token = lexer.next()) {
    if (token.is("(")) {
      open.push_back(is_name);
      calls_gl = calls_gl || (is_name && names_gl_function(last));
    }
    has_function = has_function || (token.is("{") && closed_parameters);
    closed_parameters = token.is(")") && !open.empty() && open.back();
    if (token.is(")") && !open.empty()) open.pop_back();
    if (has_function && calls_gl) return true;
    is_name = token.is_name();
    last = token.text;
  }
  return false;
}

bool is_source_code(std::string_view text) {
  if (text.size() > kMaxSourceBytes) return false;
  if (find_literal(text, "!!RC1.0") != std::string_view::npos) return true;
  if (detail::find_shader_literal(text) != std::string_view::npos) return true;
  // A page may show calls.
  if (is_page(text)) return false;
  const code::Language language = code::language_of(text);
  const std::vector<std::uint32_t> calls = code::calls_of(text, language);
  if (calls.empty()) return false;
  if (text.substr(calls[0]).starts_with("nvparse")) return true;
  if (language == code::Language::pascal) return true;
  code::Lexer lexer(text, language, 0, text.size());
  for (code::Token token = lexer.next(); token.kind != code::Token::Kind::end; token = lexer.next()) {
    if (shows_structure(token)) return true;
  }
  return false;
}

std::vector<SourceFunction> find_source_functions(const SourceText& source, const std::vector<Definition>& definitions,
                                                  const HardwareProfile& profile) {
  detail::SourceFaults faults(source);
  if (detail::too_long(source, faults)) return {};
  code::Units units(source, definitions, profile);
  std::vector<SourceFunction> all;
  for (const code::Unit& unit : units.all()) {
    if (unit.kind == code::Unit::Kind::text && units.is_loaded(unit)) continue;
    SourceFunction one = units.describe(unit);
    if (one.calls_read + one.calls_not_read > 0 || !one.faults.empty()) all.push_back(std::move(one));
  }
  return all;
}

Parsed<CombinerState> parse_source_code(const SourceText& source, const SourceSelection& selection,
                                        const HardwareProfile& profile, std::vector<RegisterWord>* other_words) {
  detail::SourceFaults faults(source);
  if (detail::too_long(source, faults)) return faults.take();
  code::Units units(source, selection.definitions, profile);
  if (!units.faults().empty()) return {units.faults().take(), units.notes().take()};
  const std::vector<const code::Unit*> chosen = units.choose(selection.functions);
  if (!units.faults().empty()) return {units.faults().take(), units.notes().take()};
  units.program().steps = 0;  // what was needed to choose does not count
  code::Machine machine(units.program(), selection.definitions, profile, units.faults(), units.notes());
  for (const code::Unit* const one : chosen) code::Units::run(machine, *one);
  machine.finish();
  const std::vector<TextFault> notes = units.notes().take();
  if (!units.faults().empty()) return {units.faults().take(), notes};
  if (!machine.fills_definition()) return {machine.state(), notes};
  Parsed<CombinerState> program = machine.program_of_words(other_words);
  program.notes.insert(program.notes.begin(), notes.begin(), notes.end());
  return program;
}

}  // namespace ninebit

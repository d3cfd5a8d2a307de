#include "ninebit/language/source_code.h"

#include <utility>

#include "src/language/c_like/c_lexer.h"
#include "src/language/pixel_shader/shader_parser.h"
#include "src/language/source/source_faults.h"
#include "src/language/source/string_literals.h"
#include "src/language/source_code/code_units.h"

namespace ninebit {
namespace {

// Whether a token shows that a text is more than a sequence of calls.
bool shows_structure(const code::Token& token) {
  if (token.is("#") && token.begins_line) return true;
  for (const std::string_view word : {"if", "for", "while", "switch", "return", "void", "class", "struct", "namespace",
                                      "public", "private", "else", "do", "import", "using"}) {
    if (token.is(word)) return true;
  }
  return false;
}

bool is_page(std::string_view text) {
  return text.find("\n```") != std::string_view::npos || text.find("\n## ") != std::string_view::npos;
}

// The program of a number from 1, or the only one. Its stages count if they are enabled.
Parsed<CombinerState> program_of(const std::vector<code::WholeState>& all, std::size_t number, const SourceText& source,
                                 std::vector<TextFault> notes, TextureShaderState* texture_shader) {
  const std::size_t chosen = number == 0 && all.size() == 1 ? 1 : number;
  if (chosen > 0 && chosen <= all.size()) {
    const auto& [combiners, stages] = all[chosen - 1];
    if (stages.enabled && texture_shader != nullptr) *texture_shader = stages;
    if (!stages.enabled && stages != TextureShaderState{}) {
      notes.push_back({std::string(source.file), 1, 1,
                       "texture shaders are set and not enabled by GL_TEXTURE_SHADER_NV: they have no effect"});
    }
    return {combiners, notes};
  }
  detail::SourceFaults faults(source);
  const std::string count = std::to_string(all.size());
  faults.add(0,
             number == 0
                 ? "draws with " + count + " programs; pick one with #1 to #" + count + " behind the file's name"
                 : "has " + count + (all.size() == 1 ? " program" : " programs") + ", not " + std::to_string(number));
  return {faults.take(), notes};
}

}  // namespace

bool is_gl_source_code(std::string_view text) {
  if (text.size() > kMaxSourceBytes || is_page(text)) return false;
  bool has_function = false, calls_gl = false, is_name = false;
  // Whether each parenthesis that is open stands behind a name, as parameters do.
  std::vector<bool> open;
  bool closed_parameters = false;
  std::string_view last;
  code::Lexer lexer(text);
  for (code::Token token = lexer.next(); token.kind != code::Token::Kind::end; token = lexer.next()) {
    if (token.is("(")) {
      open.push_back(is_name);
      calls_gl = calls_gl || (is_name && code::names_gl_function(last));
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
  const std::vector<std::uint32_t> calls = code::calls_of(text, code::names_stages(text));
  if (calls.empty()) return false;
  if (text.substr(calls[0]).starts_with("nvparse")) return true;
  code::Lexer lexer(text);
  for (code::Token token = lexer.next(); token.kind != code::Token::Kind::end; token = lexer.next()) {
    if (shows_structure(token)) return true;
  }
  return false;
}

std::vector<SourceFunction> find_source_functions(const SourceText& source, const std::vector<Definition>& definitions,
                                                  const HardwareProfile& profile, const SourceInclude& include) {
  detail::SourceFaults faults(source);
  if (detail::too_long(source, faults)) return {};
  SourceSelection selection;
  selection.definitions = definitions;
  selection.include = include;
  code::Units units(source, selection, profile);
  std::vector<SourceFunction> all;
  for (const code::Unit& unit : units.all()) {
    if (unit.kind == code::Unit::Kind::text && units.is_loaded(unit)) continue;
    SourceFunction one = units.describe(unit);
    if (one.calls_read + one.calls_not_read > 0 || !one.faults.empty()) all.push_back(std::move(one));
  }
  return all;
}

Parsed<CombinerState> parse_source_code(const SourceText& source, const SourceSelection& selection,
                                        const HardwareProfile& profile, std::vector<RegisterWord>* other_words,
                                        TextureShaderState* texture_shader) {
  detail::SourceFaults faults(source);
  if (detail::too_long(source, faults)) return faults.take();
  code::Units units(source, selection, profile);
  if (!units.faults().empty()) return {units.faults().take(), units.notes().take()};
  const std::vector<const code::Unit*> chosen = units.choose(selection.functions);
  if (!units.faults().empty()) return {units.faults().take(), units.notes().take()};
  units.program().steps = 0;  // what was needed to choose does not count
  code::Machine machine(units.program(), selection.definitions, profile, units.faults(), units.notes());
  for (const code::Unit* const one : chosen) code::Units::run(machine, *one);
  machine.finish();
  const std::vector<TextFault> notes = units.notes().take();
  if (!units.faults().empty()) return {units.faults().take(), notes};
  if (!machine.fills_definition()) {
    return program_of(machine.programs(), selection.program, source, notes, texture_shader);
  }
  Parsed<CombinerState> program = machine.program_of_words(other_words);
  program.notes.insert(program.notes.begin(), notes.begin(), notes.end());
  return program;
}

}  // namespace ninebit

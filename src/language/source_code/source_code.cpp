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

}  // namespace

bool is_source_code(std::string_view text) {
  if (text.size() > kMaxSourceBytes) return false;
  if (find_literal(text, "!!RC1.0") != std::string_view::npos) return true;
  if (detail::find_shader_literal(text) != std::string_view::npos) return true;
  // A page may show calls.
  if (text.find("\n```") != std::string_view::npos || text.find("\n## ") != std::string_view::npos) return false;
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
    if (one.calls_read + one.calls_not_read > 0) all.push_back(std::move(one));
  }
  return all;
}

Parsed<CombinerState> parse_source_code(const SourceText& source, const SourceSelection& selection,
                                        const HardwareProfile& profile, std::vector<RegisterWord>* other_words) {
  detail::SourceFaults faults(source);
  if (detail::too_long(source, faults)) return {std::nullopt, faults.take()};
  code::Units units(source, selection.definitions, profile);
  if (!units.faults().empty()) return {std::nullopt, units.faults().take(), units.notes().take()};
  const std::vector<const code::Unit*> chosen = units.choose(selection.functions);
  if (!units.faults().empty()) return {std::nullopt, units.faults().take(), units.notes().take()};
  code::Machine machine(units.program(), selection.definitions, profile, units.faults(), units.notes());
  for (const code::Unit* const one : chosen) code::Units::run(machine, *one);
  machine.finish();
  Parsed<CombinerState> words{};
  if (machine.fills_definition() && units.faults().empty()) words = machine.program_of_words(other_words);
  Parsed<CombinerState> out{std::nullopt, units.faults().take(), units.notes().take()};
  if (out.faults.empty()) out.value = machine.fills_definition() ? words.value : machine.state();
  out.faults.insert(out.faults.end(), words.faults.begin(), words.faults.end());
  out.notes.insert(out.notes.end(), words.notes.begin(), words.notes.end());
  return out;
}

}  // namespace ninebit

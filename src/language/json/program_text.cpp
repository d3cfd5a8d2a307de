#include "ninebit/language/program_text.h"

#include <utility>

#include "ninebit/language/gl_calls.h"
#include "ninebit/language/json.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_log.h"
#include "ninebit/language/xbox_pixel_shader.h"
#include "src/language/json/text_kind.h"
#include "src/language/source/foreign_language.h"
#include "src/language/source/string_literals.h"
#include "src/language/xbox/xbox_dump.h"

namespace ninebit {
namespace {

// The form of a JSON object: the canonical form has "ninebit": "program"; register words need no such key.
ProgramForm form_of_object(std::string_view text) {
  const std::string_view said = json_kind(text);
  return said.empty() || said == "register_words" ? ProgramForm::words_json : ProgramForm::json;
}

// The form of a program in string literals, which the text begins with.
ProgramForm form_of_literals(std::string_view text) {
  const std::size_t end = end_of_literals(text, 0);
  const LiteralText program({text, {}}, 0, end);
  const std::string_view content = without_heading(program.source().text);
  return content.starts_with('"') ? ProgramForm::gl : form_of(content);
}

}  // namespace

ProgramForm form_of(std::string_view text) {
  const std::string_view content = without_heading(text);
  if (is_pixel_shader(text)) return ProgramForm::ps;
  if (content.starts_with("!!")) return ProgramForm::rc10;
  const bool definition = is_xbox_pixel_shader(text);
  const bool bracket = content.starts_with('{') || content.starts_with('[');
  if (bracket && definition) return ProgramForm::xbox;
  if (is_json(content)) return form_of_object(content);
  if (is_assignment(content)) return definition ? ProgramForm::xbox : ProgramForm::words;
  if (is_source_code(text)) return ProgramForm::source;
  // Both may be columns of numbers. A hex dump has offsets that fit its rows; few logs have as many numbers as a
  // definition.
  const auto is_dump = [&] {
    return xbox::is_hex_dump(text) || bool(parse_xbox_pixel_shader({text, ""}, profiles::nv2a));
  };
  if (is_register_log(text) && !(definition && is_dump())) return ProgramForm::log;
  if (definition) return ProgramForm::xbox;
  if (content.starts_with('"') || content.starts_with("R\"")) return form_of_literals(content);
  // Code without combiners is not a sequence of calls, either.
  const bool is_code = is_gl_source_code(text) && foreign_language(text).empty();
  return is_code ? ProgramForm::source : ProgramForm::gl;
}

ChipClass chip_of(const HardwareProfile& profile) {
  return profile.per_stage_constants ? ChipClass::nv20 : ChipClass::nv10;
}

namespace {

Parsed<CombinerState> parse_log(const SourceText& source, const HardwareProfile& profile, const ReadOptions& options,
                                std::vector<RegisterWord>& other_words) {
  auto log = parse_register_log(source, {.chip = options.chip, .fallback = chip_of(profile)});
  if (!log) return {log.faults(), std::move(log.notes)};
  auto state = program_of(*log, options.setup, source.file, profile, &other_words);
  state.notes.insert(state.notes.begin(), log.notes.begin(), log.notes.end());
  return state;
}

Parsed<CombinerState> parse_state(const SourceText& source, ProgramForm form, const HardwareProfile& profile,
                                  const ReadOptions& options, std::vector<RegisterWord>& other_words) {
  switch (form) {
    case ProgramForm::gl:
      return parse_gl_calls(source, profile);
    case ProgramForm::source:
      return parse_source_code(source, options.source, profile, &other_words);
    case ProgramForm::rc10:
      return parse_rc10(source, profile);
    case ProgramForm::ps:
      return parse_pixel_shader(source, profile, options.source.definitions);
    case ProgramForm::words:
      return parse_register_words(source, options.chip.value_or(chip_of(profile)), profile, &other_words);
    case ProgramForm::words_json:
      return parse_json_register_words(source, options.chip.value_or(chip_of(profile)), profile, &other_words);
    case ProgramForm::json:
      return parse_json_program(source, profile, &other_words);
    case ProgramForm::xbox:
      return parse_xbox_pixel_shader(source, profile, &other_words);
    case ProgramForm::log:
      return parse_log(source, profile, options, other_words);
  }
  return CombinerState{};
}

}  // namespace

Parsed<TextProgram> parse_program(const SourceText& source, ProgramForm form, const HardwareProfile& profile,
                                  const ReadOptions& options) {
  std::vector<RegisterWord> other_words;
  Parsed<CombinerState> state = parse_state(source, form, profile, options, other_words);
  if (!state) return {state.faults(), std::move(state.notes)};
  return {TextProgram{*state, std::move(other_words)}, std::move(state.notes)};
}

}  // namespace ninebit

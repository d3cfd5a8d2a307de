#include "ninebit/language/program_text.h"

#include "ninebit/language/gl_calls.h"
#include "ninebit/language/json.h"
#include "ninebit/language/rc10.h"
#include "src/language/json/text_kind.h"

namespace ninebit {
namespace {

// The form of a JSON object: the canonical form has "ninebit": "program"; register words need no such key.
ProgramForm form_of_object(std::string_view text) {
  const std::string_view said = json_kind(text);
  return said.empty() || said == "register_words" ? ProgramForm::words_json : ProgramForm::json;
}

}  // namespace

ProgramForm form_of(std::string_view text) {
  const std::string_view content = without_heading(text);
  if (content.starts_with("!!RC1.0")) return ProgramForm::rc10;
  if (content.starts_with('{') || content.starts_with('[')) return form_of_object(content);
  return is_assignment(content) ? ProgramForm::words : ProgramForm::gl;
}

ChipClass chip_of(const HardwareProfile& profile) {
  return profile.per_stage_constants ? ChipClass::nv20 : ChipClass::nv10;
}

Parsed<CombinerState> parse_program(const SourceText& source, ProgramForm form, ChipClass chip,
                                    const HardwareProfile& profile) {
  switch (form) {
    case ProgramForm::gl:
      return parse_gl_calls(source, profile);
    case ProgramForm::rc10:
      return parse_rc10(source, profile);
    case ProgramForm::words:
      return parse_register_words(source, chip, profile);
    case ProgramForm::words_json:
      return parse_json_register_words(source, chip, profile);
    case ProgramForm::json:
      return parse_json_program(source, profile);
  }
  return {};
}

}  // namespace ninebit

#include "ninebit/language/program_text.h"

#include <algorithm>
#include <array>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/language/c_source.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/json.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_log.h"
#include "ninebit/language/xbox_pixel_shader.h"
#include "src/language/json/text_kind.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/language/source/foreign_language.h"
#include "src/language/source/string_literals.h"
#include "src/language/xbox/xbox_dump.h"

namespace ninebit {
namespace {

using Words = std::vector<RegisterWord>;
using State = Parsed<CombinerState>;

bool is_json_program(std::string_view, std::string_view content) {
  const std::string_view said = json_kind(content);
  return is_json(content) && !said.empty() && said != "register_words";
}

// Whether a text is a definition, and not a log with columns of numbers or a source that fills one.
bool is_definition(std::string_view text, std::string_view content) {
  if (!is_xbox_pixel_shader(text)) return false;
  if (content.starts_with('{') || content.starts_with('[') || is_assignment(content)) return true;
  if (is_source_code(text)) return false;
  // A hex dump has offsets that fit its rows; few logs have as many numbers as a definition.
  return !is_register_log(text) || xbox::is_hex_dump(text) || bool(parse_xbox_pixel_shader({text, ""}, profiles::nv2a));
}

// A program in string literals, or code: without combiners it is not a sequence of calls, either.
bool is_source(std::string_view text, std::string_view content) {
  if (is_source_code(text)) return true;
  if (is_register_log(text)) return false;
  const bool is_literal = content.starts_with('"') || content.starts_with("R\"");
  return !is_literal && is_gl_source_code(text) && foreign_language(text).empty();
}

// The content of a program in string literals that the text begins with; empty: there is none.
bool is_rc10(std::string_view text, std::string_view content) {
  if (content.starts_with("!!")) return !is_pixel_shader(text);
  if ((!content.starts_with('"') && !content.starts_with("R\"")) || is_source_code(text)) return false;
  const LiteralText literal({content, {}}, 0, end_of_literals(content, 0));
  return without_heading(literal.source().text).starts_with("!!");
}

ChipClass chip_for(const ReadOptions& options, const HardwareProfile& profile) {
  return options.chip.value_or(chip_of(profile));
}

State parse_json_words(const SourceText& source, const HardwareProfile& profile, const ReadOptions& options,
                       Words& other_words) {
  return parse_json_register_words(source, chip_for(options, profile), profile, &other_words);
}

State parse_log(const SourceText& source, const HardwareProfile& profile, const ReadOptions& options,
                Words& other_words) {
  auto log = parse_register_log(source, {.chip = options.chip, .fallback = chip_of(profile)});
  if (!log) return {log.faults(), std::move(log.notes)};
  auto state = program_of(*log, options.setup, source.file, profile, &other_words);
  state.notes.insert(state.notes.begin(), log.notes.begin(), log.notes.end());
  return state;
}

template <GlslVersion version>
Result<std::string> print_glsl(const TextProgram& program, ChipClass, const HardwareProfile& profile) {
  return emit_glsl(normalize(program.state, profile), version);
}

// A form whose printer needs the state alone.
template <Result<std::string> (*printer)(const CombinerState&, const HardwareProfile&)>
Result<std::string> print_state(const TextProgram& program, ChipClass, const HardwareProfile& profile) {
  return printer(program.state, profile);
}

const std::array kForms{
    Form{.name = "gl",
         .title = "GL calls",
         .kind = "GL calls",
         .parse = [](const SourceText& source, const HardwareProfile& profile, const ReadOptions&,
                     Words&) { return parse_gl_calls(source, profile); },
         .print = print_state<print_gl_calls>},
    Form{.name = "rc10",
         .title = "!!RC1.0 (nvparse)",
         .kind = "an !!RC1.0 program",
         .detect = is_rc10,
         .parse = [](const SourceText& source, const HardwareProfile& profile, const ReadOptions&,
                     Words&) { return parse_rc10(source, profile); },
         .print = print_state<print_rc10>},
    Form{.name = "ps",
         .title = "Pixel shader ps.1.x",
         .kind = "a ps.1.x pixel shader",
         // The compiler's header of tokens has the text before them, between #if 0 and #endif.
         .detect = [](std::string_view text,
                      std::string_view) { return is_pixel_shader(text) && !is_shader_tokens(text); },
         .parse =
             [](const SourceText& source, const HardwareProfile& profile, const ReadOptions& options, Words&) {
               return parse_pixel_shader(source, profile, options.source.definitions, options.source.include);
             },
         .takes_definitions = true},
    Form{.name = "tokens",
         .title = "Assembled pixel shader",
         .kind = "an assembled pixel shader",
         .detect = [](std::string_view text, std::string_view) { return is_shader_tokens(text); },
         .parse = [](const SourceText& source, const HardwareProfile& profile, const ReadOptions&,
                     Words&) { return parse_shader_tokens(source, profile); },
         .print = print_state<print_shader_tokens>},
    Form{.name = "xbox",
         .title = "Xbox pixel shader definition",
         .kind = "an Xbox pixel shader definition",
         .detect = is_definition,
         .parse = [](const SourceText& source, const HardwareProfile& profile, const ReadOptions&,
                     Words& other_words) { return parse_xbox_pixel_shader(source, profile, &other_words); },
         .print =
             [](const TextProgram& program, ChipClass, const HardwareProfile& profile) {
               return print_xbox_pixel_shader(program.state, profile, program.other_words);
             },
         .keeps_other_words = true,
         .writes_values = true},
    Form{.name = "json",
         .title = "Program as JSON",
         .kind = "a combiner program as JSON",
         .detect = is_json_program,
         .parse = [](const SourceText& source, const HardwareProfile& profile, const ReadOptions&,
                     Words& other_words) { return parse_json_program(source, profile, &other_words); },
         .print =
             [](const TextProgram& program, ChipClass, const HardwareProfile&) {
               return Result<std::string>(print_json_program(program.state, program.other_words));
             },
         .keeps_other_words = true},
    Form{.name = "words",
         .title = "Register words",
         .kind = "register words",
         .detect = [](std::string_view,
                      std::string_view content) { return is_assignment(content) || words::is_printed_struct(content); },
         .parse =
             [](const SourceText& source, const HardwareProfile& profile, const ReadOptions& options,
                Words& other_words) {
               if (is_json(without_heading(source.text)))
                 return parse_json_words(source, profile, options, other_words);
               return parse_register_words(source, chip_for(options, profile), profile, &other_words);
             },
         .print =
             [](const TextProgram& program, ChipClass chip, const HardwareProfile& profile) {
               return print_register_words(program.state, chip, profile, program.other_words);
             },
         .has_words = true,
         .keeps_other_words = true},
    Form{.name = "words-json",
         .title = "Register words as JSON",
         .kind = "register words as JSON",
         .detect = [](std::string_view, std::string_view content) { return is_json(content); },
         .parse = parse_json_words,
         .print =
             [](const TextProgram& program, ChipClass chip, const HardwareProfile& profile) {
               return print_json_register_words(program.state, chip, profile, program.other_words);
             },
         .has_words = true,
         .keeps_other_words = true},
    Form{.name = "source",
         .title = "A source file with GL calls",
         .kind = "a source file with GL calls",
         .detect = is_source,
         .parse = [](const SourceText& source, const HardwareProfile& profile, const ReadOptions& options,
                     Words& other_words) { return parse_source_code(source, options.source, profile, &other_words); },
         .takes_definitions = true},
    Form{.name = "log",
         .title = "Log of register writes",
         .kind = "a log of register writes",
         .detect = [](std::string_view text, std::string_view) { return is_register_log(text); },
         .parse = parse_log,
         .has_words = true},
    Form{.name = "ps11", .title = "Pixel shader ps.1.1", .kind = "ps.1.1", .print = print_state<print_pixel_shader>},
    Form{.name = "glsl",
         .title = "GLSL 3.30",
         .kind = "GLSL 3.30",
         .print = print_glsl<GlslVersion::glsl_330>,
         .writes_values = true},
    Form{.name = "glsl-es",
         .title = "GLSL ES 3.00",
         .kind = "GLSL ES 3.00",
         .print = print_glsl<GlslVersion::es_300>,
         .writes_values = true},
    Form{.name = "c",
         .title = "C",
         .kind = "C",
         .print = [](const TextProgram& program, ChipClass,
                     const HardwareProfile& profile) { return emit_c(normalize(program.state, profile)); },
         .writes_values = true},
};

}  // namespace

std::span<const Form> forms() {
  return kForms;
}

const Form& form_row(ProgramForm form) {
  return kForms[static_cast<std::size_t>(form)];
}

ProgramForm form_id(const Form& row) {
  return static_cast<ProgramForm>(&row - kForms.data());
}

const Form* find_form(std::string_view name) {
  const auto* const found = std::find_if(kForms.begin(), kForms.end(), [&](const Form& f) { return f.name == name; });
  return found == kForms.end() ? nullptr : found;
}

std::vector<std::string> read_form_names() {
  std::vector<std::string> names;
  for (const Form& form : kForms) {
    if (form.parse != nullptr) names.emplace_back(form.name);
  }
  return names;
}

std::vector<std::string> written_form_names() {
  std::vector<std::string> names;
  for (const Form& form : kForms) {
    if (form.print != nullptr) names.emplace_back(form.name);
  }
  return names;
}

std::optional<ProgramForm> detected_form(std::string_view text) {
  const auto plain = without_line_prefixes(text);
  if (plain) text = *plain;
  const std::string_view content = without_heading(text);
  for (std::size_t i = 0; i < kForms.size(); ++i) {
    if (kForms[i].detect != nullptr && kForms[i].detect(text, content)) return static_cast<ProgramForm>(i);
  }
  return std::nullopt;
}

ProgramForm form_of(std::string_view text) {
  return detected_form(text).value_or(ProgramForm::gl);
}

ChipClass chip_of(const HardwareProfile& profile) {
  return profile.per_stage_constants ? ChipClass::nv20 : ChipClass::nv10;
}

Parsed<TextProgram> parse_program(const SourceText& source, ProgramForm form, const HardwareProfile& profile,
                                  const ReadOptions& options) {
  const auto plain = without_line_prefixes(source.text);
  const SourceText read = plain ? SourceText{*plain, source.file, source.written, source.begin} : source;
  Words other_words;
  State state = form_row(form).parse(read, profile, options, other_words);
  if (!state) return {state.faults(), std::move(state.notes)};
  return {TextProgram{*state, std::move(other_words)}, std::move(state.notes)};
}

}  // namespace ninebit

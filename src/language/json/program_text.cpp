#include "ninebit/language/program_text.h"

#include <algorithm>
#include <array>
#include <utility>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/c_source.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/json.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_log.h"
#include "ninebit/language/xbox_pixel_shader.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/stage_program.h"
#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/json/text_kind.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/language/source/foreign_language.h"
#include "src/language/source/string_literals.h"
#include "src/language/xbox/stage_words.h"
#include "src/language/xbox/xbox_numbers.h"
#include "src/system/find_row.h"

namespace ninebit {
namespace {

// The program of a parser whose further results `read` holds already.
Parsed<TextProgram> program_with(Parsed<CombinerState> state, TextProgram read) {
  if (!state) return {state.faults(), std::move(state.notes)};
  read.state = *state;
  return {std::move(read), std::move(state.notes)};
}

// The same, where the words of the stages are among the other words, and `registers` of a log: they become stages,
// unless the stages do not model them, or they only read textures, which a chip without stages does, too.
Parsed<TextProgram> program_with_words(Parsed<CombinerState> state, TextProgram read, std::string_view file,
                                       const HardwareProfile& profile,
                                       const std::vector<RegisterWord>& registers = {}) {
  auto program = program_with(std::move(state), std::move(read));
  if (!program) return program;
  if (program->texture_shader.enabled) {
    for (const RegisterWord& word : program->other_words) {
      if (!xbox::is_stage_word(word.name) || word.value == 0) continue;
      return std::vector{TextFault{std::string(file), word.place.line, word.place.column,
                                   word.name + " stands beside texture_shader, which has the same stages; expected one "
                                               "of them"}};
    }
    return program;
  }
  std::vector<RegisterWord> words = program->other_words;
  words.insert(words.end(), registers.begin(), registers.end());
  const xbox::StageWords stages = xbox::decode_stage_words(words);
  if (!stages.why.empty()) {
    program.notes.push_back({std::string(file), stages.place.line, stages.place.column,
                             "texture stages are skipped, and their words kept: " + stages.why});
  } else if (stages.state.enabled && (profile.texture_shaders || !only_reads_textures(stages.state))) {
    program->texture_shader = stages.state;
    if (!stages.missing.empty()) {
      program.notes.push_back({std::string(file), stages.place.line, stages.place.column,
                               stages.missing + ": no word has it, and OpenGL's default stands for it"});
    }
    std::erase_if(program->other_words, [](const RegisterWord& word) { return xbox::is_stage_word(word.name); });
  }
  return program;
}

// The other words of a program with those of its stages, in the order of kOtherWordNames where there are some.
Result<std::vector<RegisterWord>> all_other_words(const TextProgram& program) {
  if (!program.texture_shader.enabled) return program.other_words;
  auto words = xbox::encode_stage_words(program.texture_shader);
  if (!words) return words;
  for (const RegisterWord& word : program.other_words) {
    if (!xbox::is_stage_word(word.name)) words->push_back(word);
  }
  return words;
}

bool is_json_program(std::string_view, std::string_view content) {
  const std::string_view said = json_kind(content);
  return is_json(content) && !said.empty() && said != "register_words";
}

// Whether a text is a definition, and not a log with columns of numbers or a source that fills one.
bool is_definition(std::string_view text, std::string_view content) {
  // A register's address is not the offset of a row of bytes.
  if (!is_xbox_pixel_shader(text) || words::is_listed_register(content)) return false;
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

Parsed<TextProgram> parse_json_words(const SourceText& source, const HardwareProfile& profile,
                                     const ReadOptions& options) {
  TextProgram read;
  auto state = parse_json_register_words(source, chip_for(options, profile), profile, &read.other_words);
  return program_with_words(std::move(state), std::move(read), source.file, profile);
}

Parsed<TextProgram> parse_words(const SourceText& source, const HardwareProfile& profile, const ReadOptions& options) {
  if (is_json(without_heading(source.text))) return parse_json_words(source, profile, options);
  TextProgram read;
  auto state = parse_register_words(source, chip_for(options, profile), profile, &read.other_words);
  return program_with_words(std::move(state), std::move(read), source.file, profile);
}

Parsed<TextProgram> parse_log(const SourceText& source, const HardwareProfile& profile, const ReadOptions& options) {
  auto log = parse_register_log(source, {.chip = options.chip, .fallback = chip_of(profile)});
  if (!log) return {log.faults(), std::move(log.notes)};
  auto program = text_program_of(*log, options.setup, source.file, profile);
  program.notes.insert(program.notes.begin(), log.notes.begin(), log.notes.end());
  return program;
}

// Stages with unsigned textures of the kinds that they read, by the chip's rules, which take any format.
Result<TextureShaderProgram> compile_for_text(TextureShaderState state, const HardwareProfile& profile) {
  const bool is_opengl = state.rules == StageRules::open_gl;
  state.rules = StageRules::nv2a;
  StageTextures textures;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const StageTarget target = info_of(state.stage[i].operation).target;
    if (target != StageTarget::none) textures[i] = StageTexture{.target = target};
  }
  auto program = compile(state, textures, profile);
  if (!program) return program;
  if (is_opengl) program->choices.off_alpha = 0;
  const auto warnings = program->warnings();
  return warnings.empty() ? program : Diagnostic{.message = warnings.front()};
}

// The fault of a form for the combiners alone, if the stages do more than it can leave out.
Status check_combiners_alone(const TextProgram& program) {
  if (only_reads_textures(program.texture_shader)) return {};
  return Diagnostic{.message =
                        "it has the combiners alone, and these texture-shader stages do more than read their textures"};
}

// Register words; NV10 has no texture shaders.
template <Result<std::string> (*printer)(const CombinerState&, ChipClass, const HardwareProfile&,
                                         std::span<const RegisterWord>)>
Result<std::string> print_words(const TextProgram& program, ChipClass chip, const HardwareProfile& profile) {
  if (chip == ChipClass::nv10) {
    if (Status alone = check_combiners_alone(program); !alone) return alone.error();
    return printer(program.state, chip, profile, program.other_words);
  }
  const auto words = all_other_words(program);
  return words ? printer(program.state, chip, profile, *words) : words.error();
}

// The text of the combiners, and behind it that of stages that do more than read their textures.
template <class EmitStages>
Result<std::string> with_stages(Result<std::string> combiners, const TextProgram& program,
                                const HardwareProfile& profile, const EmitStages& emit_stages) {
  if (!combiners || only_reads_textures(program.texture_shader)) return combiners;
  const auto stages = compile_for_text(program.texture_shader, profile);
  if (!stages) return stages.error();
  const Result<std::string> text = emit_stages(*stages, profile);
  if (!text) return text;
  return *combiners + '\n' + *text;
}

template <GlslVersion version>
Result<std::string> print_glsl(const TextProgram& program, ChipClass, const HardwareProfile& profile) {
  return with_stages(emit_glsl(normalize(program.state, profile), version), program, profile,
                     [](const auto& stages, const auto& of) { return emit_glsl_texture_shader(stages, of); });
}

template <PixelLanguage language>
Result<std::string> print_pixel(const TextProgram& program, ChipClass, const HardwareProfile& profile) {
  auto text = emit_pixel_shader(normalize(program.state, profile), language);
  if constexpr (language == PixelLanguage::hlsl) {
    if (Status alone = check_combiners_alone(program); !alone) return alone.error();
    return text;
  } else {
    return with_stages(std::move(text), program, profile,
                       [](const auto& stages, const auto& of) { return emit_glsl_texture_shader(stages, of); });
  }
}

// A form whose parser gives both halves, without other words.
template <Parsed<CombinerState> (*parser)(const SourceText&, const HardwareProfile&, TextureShaderState*)>
Parsed<TextProgram> parse_halves(const SourceText& source, const HardwareProfile& profile, const ReadOptions&) {
  TextProgram read;
  auto state = parser(source, profile, &read.texture_shader);
  return program_with(std::move(state), std::move(read));
}

// A form whose printer needs both halves alone.
template <Result<std::string> (*printer)(const CombinerState&, const HardwareProfile&, const TextureShaderState&)>
Result<std::string> print_halves(const TextProgram& program, ChipClass, const HardwareProfile& profile) {
  return printer(program.state, profile, program.texture_shader);
}

const std::array kForms{
    Form{.name = "gl",
         .title = "GL calls",
         .kind = "GL calls",
         .parse = parse_halves<parse_gl_calls>,
         .print = print_halves<print_gl_calls>},
    Form{.name = "rc10",
         .title = "!!RC1.0 (nvparse)",
         .kind = "an !!RC1.0 program",
         .detect = is_rc10,
         .parse = parse_halves<parse_rc10>,
         .print = print_halves<print_rc10>},
    Form{.name = "ps",
         .title = "Pixel shader ps.1.x",
         .kind = "a ps.1.x pixel shader",
         // The compiler's header of tokens has the text before them, between #if 0 and #endif.
         .detect = [](std::string_view text,
                      std::string_view) { return is_pixel_shader(text) && !is_shader_tokens(text); },
         .parse =
             [](const SourceText& source, const HardwareProfile& profile, const ReadOptions& options) {
               TextProgram read;
               auto state = parse_pixel_shader(source, profile, options.source.definitions, options.source.include,
                                               &read.texture_shader);
               return program_with(std::move(state), std::move(read));
             },
         .takes_definitions = true},
    Form{.name = "tokens",
         .title = "Assembled pixel shader",
         .kind = "an assembled pixel shader",
         .detect = [](std::string_view text, std::string_view) { return is_shader_tokens(text); },
         .parse = parse_halves<parse_shader_tokens>,
         .print = print_halves<print_shader_tokens>},
    Form{.name = "xbox",
         .title = "Xbox pixel shader definition",
         .kind = "an Xbox pixel shader definition",
         .detect = is_definition,
         .parse =
             [](const SourceText& source, const HardwareProfile& profile, const ReadOptions&) {
               TextProgram read;
               auto state = parse_xbox_pixel_shader(source, profile, &read.other_words);
               return program_with_words(std::move(state), std::move(read), source.file, profile);
             },
         .print =
             [](const TextProgram& program, ChipClass, const HardwareProfile& profile) {
               const auto words = all_other_words(program);
               return words ? print_xbox_pixel_shader(program.state, profile, *words) : words.error();
             },
         .keeps_other_words = true,
         .writes_values = true},
    Form{.name = "json",
         .title = "Program as JSON",
         .kind = "a combiner program as JSON",
         .detect = is_json_program,
         .parse =
             [](const SourceText& source, const HardwareProfile& profile, const ReadOptions&) {
               TextProgram read;
               auto state = parse_json_program(source, profile, &read.other_words, &read.texture_shader);
               return program_with_words(std::move(state), std::move(read), source.file, profile);
             },
         .print =
             [](const TextProgram& program, ChipClass, const HardwareProfile&) {
               return Result<std::string>(
                   print_json_program(program.state, program.other_words, program.texture_shader));
             },
         .keeps_other_words = true},
    Form{.name = "words",
         .title = "Register words",
         .kind = "register words",
         .detect =
             [](std::string_view, std::string_view content) {
               return is_assignment(content) || words::is_printed_struct(content) || words::is_listed_register(content);
             },
         .parse = parse_words,
         .print = print_words<print_register_words>,
         .has_words = true,
         .keeps_other_words = true},
    Form{.name = "words-json",
         .title = "Register words as JSON",
         .kind = "register words as JSON",
         .detect = [](std::string_view, std::string_view content) { return is_json(content); },
         .parse = parse_json_words,
         .print = print_words<print_json_register_words>,
         .has_words = true,
         .keeps_other_words = true},
    Form{.name = "source",
         .title = "A source file with GL calls",
         .kind = "a source file with GL calls",
         .detect = is_source,
         .parse =
             [](const SourceText& source, const HardwareProfile& profile, const ReadOptions& options) {
               TextProgram read;
               auto state = parse_source_code(source, options.source, profile, &read.other_words, &read.texture_shader);
               return program_with_words(std::move(state), std::move(read), source.file, profile);
             },
         .takes_definitions = true},
    Form{.name = "log",
         .title = "Log of register writes",
         .kind = "a log of register writes",
         .detect = [](std::string_view text, std::string_view) { return is_register_log(text); },
         .parse = parse_log,
         .has_words = true},
    Form{.name = "ps11", .title = "Pixel shader ps.1.1", .kind = "ps.1.1", .print = print_halves<print_pixel_shader>},
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
    Form{.name = "glsl-pixel-130",
         .title = "GLSL 1.30 by stages",
         .kind = "GLSL 1.30",
         .print = print_pixel<PixelLanguage::glsl_130>},
    Form{.name = "glsl-pixel",
         .title = "GLSL 3.30 by stages",
         .kind = "GLSL 3.30",
         .print = print_pixel<PixelLanguage::glsl_330>},
    Form{.name = "glsl-pixel-450",
         .title = "GLSL 4.50 by stages",
         .kind = "GLSL 4.50",
         .print = print_pixel<PixelLanguage::glsl_450>},
    Form{.name = "glsl-pixel-es",
         .title = "GLSL ES 3.00 by stages",
         .kind = "GLSL ES 3.00",
         .print = print_pixel<PixelLanguage::es_300>},
    Form{.name = "hlsl", .title = "HLSL by stages", .kind = "HLSL", .print = print_pixel<PixelLanguage::hlsl>},
    Form{.name = "c",
         .title = "C",
         .kind = "C",
         .print =
             [](const TextProgram& program, ChipClass, const HardwareProfile& profile) {
               return with_stages(emit_c(normalize(program.state, profile)), program, profile,
                                  [](const auto& stages, const auto& of) { return emit_c_texture_shader(stages, of); });
             },
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
  return find_row(kForms, &Form::name, name);
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
  return form_row(form).parse(read, profile, options);
}

Parsed<TextProgram> text_program_of(const RegisterLog& log, std::size_t setup, std::string_view file,
                                    const HardwareProfile& profile) {
  TextProgram read;
  auto state = program_of(log, setup, file, profile, &read.other_words);
  const std::size_t place = setup == 0 ? 0 : setup - 1;
  const std::vector<RegisterWord> none;
  return program_with_words(std::move(state), std::move(read), file, profile,
                            place < log.setups.size() ? log.setups[place].stage_registers : none);
}

std::vector<StateDiagnostic> validate(const TextProgram& program, const HardwareProfile& profile) {
  std::vector<StateDiagnostic> all;
  for (TextureShaderDiagnostic& found : validate(program.texture_shader, profile)) {
    StateDiagnostic& one = all.emplace_back();
    one.gl_error = found.gl_error;
    one.message = std::move(found.message);
  }
  for (StateDiagnostic& found : validate(program.state, profile)) all.push_back(std::move(found));
  return all;
}

}  // namespace ninebit

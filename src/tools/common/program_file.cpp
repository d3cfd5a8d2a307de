#include "src/tools/common/program_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "ninebit/combiner/validate.h"
#include "src/tools/input/file_kind.h"
#include "src/tools/input/input_file.h"

namespace ninebit::tools {
namespace {

struct FormName {
  ProgramForm form;
  std::string_view kind;  // as kind_of_file() names it
  std::string_view flag;  // of --from
};
constexpr std::array kForms{FormName{ProgramForm::gl, kGlKind, "gl"}, FormName{ProgramForm::rc10, kRc10Kind, "rc10"},
                            FormName{ProgramForm::words, kWordsKind, "words"},
                            FormName{ProgramForm::words_json, kJsonWordsKind, "words"},
                            FormName{ProgramForm::json, kJsonProgramKind, "json"}};

const FormName* form_of_kind(std::string_view kind) {
  const auto found = std::find_if(kForms.begin(), kForms.end(), [&](const FormName& f) { return f.kind == kind; });
  return found == kForms.end() ? nullptr : found;
}

std::string_view kind_of_form(ProgramForm form) {
  return std::find_if(kForms.begin(), kForms.end(), [&](const FormName& f) { return f.form == form; })->kind;
}

// For a file with faults: one sentence if it seems to be of another kind than it was read as; else empty.
std::string seems_to_be_else(const ProgramFile& file, const std::string& from) {
  constexpr std::string_view kExpected = "expected a combiner program: GL calls, !!RC1.0, register words or JSON";
  constexpr std::size_t kFewFaults = 3;  // so few are listed even if the text does not look like a program
  const std::string kind = kind_of_file(file.text);
  const bool is_json = file.form == ProgramForm::json || file.form == ProgramForm::words_json;
  if (kind.empty() || (is_json && kind == kJsonKind)) {
    if (!from.empty() || file.parsed.faults.size() <= kFewFaults) return "";
    return fmt::format("seems to be {}; {}", kind.empty() ? "some other text" : kind, kExpected);
  }
  if (kind == kind_of_form(file.form)) return "";
  const FormName* const other = form_of_kind(kind);
  if (other == nullptr) return fmt::format("seems to be {}; {}", kind, kExpected);
  if (from.empty() || from == other->flag) return "";
  return fmt::format("seems to be {}; expected {}, as --from {} says; leave out --from, or give --from {}", kind,
                     kind_of_form(file.form), from, other->flag);
}

// The text of a file. Reports a file that is too long for a program, with its kind if that is known.
Result<std::string> read_text(const std::string& path) {
  auto input = InputFile::open(path);
  if (!input) return input.error();
  std::string text;
  while (text.size() <= kMaxSourceBytes) {
    auto more = input->read();
    if (!more) return more.error();
    if (more->empty()) return text;
    text.append(*more);
  }
  const std::string kind = kind_of_file(text);
  return Diagnostic{.message = fmt::format("{}is longer than {} bytes, the limit for a program",
                                           kind.empty() ? "" : "seems to be " + kind + ", and ", kMaxSourceBytes),
                    .file = input->name()};
}

}  // namespace

void add_program_argument(CLI::App& verb, const std::string& name, ProgramFlags& flags) {
  verb.add_option(name, flags.file, "Program in any form; - reads standard input")
      ->required()
      ->type_name("PROGRAM")
      ->check(CLI::Validator(
          [](const std::string& text) { return std::string(text.empty() ? "the file name is empty" : ""); }, ""));
}

void add_program_flags(CLI::App& verb, ProgramFlags& flags) {
  add_program_argument(verb, "program", flags);
  verb.add_option("--from", flags.from, "Form of the program (default: detected from the content)")
      ->check(CLI::IsMember({"gl", "rc10", "words", "json"}));
  verb.add_option("--chip", flags.chip, "Chip whose register words are read (default: from the profile)")
      ->check(CLI::IsMember({"nv10", "nv20"}));
}

ChipClass chip_of(const ProgramFlags& flags, const HardwareProfile& profile) {
  if (!flags.chip.empty()) return flags.chip == "nv10" ? ChipClass::nv10 : ChipClass::nv20;
  return ninebit::chip_of(profile);
}

Result<ProgramFile> read_program_file(const ProgramFlags& flags, const HardwareProfile& profile) {
  auto text = read_text(flags.file);
  if (!text) return text.error();
  ProgramFile file{.name = flags.file == "-" ? "standard input" : flags.file, .text = std::move(*text), .parsed = {}};
  if (flags.from.empty() && without_heading(file.text).empty()) {
    return Diagnostic{.message = "is empty; expected a program", .file = file.name};
  }
  file.form = form_of(file.text);
  const bool is_json = file.form == ProgramForm::json || file.form == ProgramForm::words_json;
  if (flags.from == "gl") file.form = ProgramForm::gl;
  if (flags.from == "rc10") file.form = ProgramForm::rc10;
  if (flags.from == "json") file.form = ProgramForm::json;
  if (flags.from == "words") file.form = is_json ? ProgramForm::words_json : ProgramForm::words;
  file.parsed = parse_program({file.text, file.name}, file.form, chip_of(flags, profile), profile);
  if (file.parsed) return file;
  if (std::string message = seems_to_be_else(file, flags.from); !message.empty()) {
    return Diagnostic{.message = std::move(message), .file = file.name};
  }
  return file;
}

std::optional<CombinerState> load_program(const ProgramFlags& flags, const HardwareProfile& profile, int& exit_code) {
  auto file = read_program_file(flags, profile);
  if (!file) {
    exit_code = report(file.error());
    return std::nullopt;
  }
  if (!file->parsed) {
    exit_code = report(file->parsed.faults);
    return std::nullopt;
  }
  const std::vector<StateDiagnostic> refused = validate(*file->parsed.value, profile);
  for (const StateDiagnostic& d : refused) {
    exit_code = report({.message = fmt::format("{}: {}", name_of(d.gl_error), d.message), .file = file->name});
  }
  if (!refused.empty()) return std::nullopt;
  return std::move(file->parsed.value);
}

int report(const std::vector<TextFault>& faults) {
  for (const TextFault& fault : faults) say_error(fault.text());
  return kInvalidInput;
}

}  // namespace ninebit::tools

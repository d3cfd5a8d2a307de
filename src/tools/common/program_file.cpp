#include "src/tools/common/program_file.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <system_error>
#include <utility>

#include "ninebit/combiner/validate.h"
#include "ninebit/language/program_text.h"
#include "src/combiner/given_registers.h"
#include "src/language/source/foreign_language.h"
#include "src/language/source/source_faults.h"
#include "src/system/inside_folder.h"
#include "src/system/lines.h"
#include "src/tools/input/file_kind.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {

namespace {

std::string_view kind_of_form(ProgramForm form) {
  return form_row(form).kind;
}

// For a file with faults: one sentence if it seems to be of another kind than it was read as; else empty.
std::string seems_to_be_else(const ProgramFile& file, const std::string& from) {
  constexpr std::size_t kFewFaults = 3;  // so few are listed even if the text does not look like a program
  const std::string kind = kind_of_file(file.text);
  const bool is_page = kind.find("Markdown") != std::string::npos || kind.find("HTML") != std::string::npos;
  if (!is_page && !foreign_language(file.text).empty()) return "";  // the fault names it
  const bool is_json = file.form == ProgramForm::json || file.form == ProgramForm::words_json;
  if (kind.empty() || (is_json && kind == kJsonKind)) {
    if (!from.empty() || file.parsed.faults().size() <= kFewFaults) return "";
    return fmt::format("seems to be {}; expected a combiner program", kind.empty() ? "some other text" : kind);
  }
  if (kind == kind_of_form(file.form) || (file.form == ProgramForm::xbox && kind == kBinaryKind)) return "";
  const bool is_calls = kind == kind_of_form(ProgramForm::gl) || kind.find("source") != std::string::npos;
  if (file.form == ProgramForm::source && is_calls) return "";
  const auto all = forms();
  const auto other = std::find_if(all.begin(), all.end(), [&](const Form& form) { return form.kind == kind; });
  if (other == all.end()) return wrong_kind(kind, FileRole::program);
  if (from.empty() || from == other->name) return "";
  return fmt::format("seems to be {}; expected {}, as --from {} says; leave out --from, or give --from {}", kind,
                     kind_of_form(file.form), from, other->name);
}

// The form that --from names, if it is given, else the detected one.
ProgramForm form_by(const std::string& from, std::string_view text) {
  const Form* const named = find_form(from);
  return named == nullptr ? form_of(text) : form_id(*named);
}

// The program of a log that was read.
Parsed<TextProgram> program_in(Parsed<RegisterLog>& log, std::size_t setup, const std::string& name,
                               const HardwareProfile& profile) {
  if (!log) return {log.faults(), std::move(log.notes)};
  auto program = text_program_of(*log, setup, name, profile);
  program.notes.insert(program.notes.begin(), log.notes.begin(), log.notes.end());
  return program;
}

// The lines of a text, for messages. Asked for from the first to the last, they take one pass over the text.
class SourceLines {
 public:
  explicit SourceLines(std::string_view text) : rest_(text) {}

  // The line, and below it a mark under the word at the column; empty if there is no such line, or it is not plain text
  // of a terminal's width.
  std::string marked(int line, int column) {
    for (; number_ < line && !rest_.empty(); ++number_) take_line(rest_);
    constexpr std::size_t kLongest = 160;
    std::string shown(rest_.substr(0, std::min(rest_.find('\n'), kLongest + 1)));
    if (shown.ends_with('\r')) shown.pop_back();
    std::replace(shown.begin(), shown.end(), '\t', ' ');
    const auto is_plain = [](char c) { return c >= ' ' && c <= '~'; };
    const auto at = static_cast<std::size_t>(column - 1);
    if (number_ != line || at >= shown.size() || shown.size() > kLongest ||
        !std::all_of(shown.begin(), shown.end(), is_plain)) {
      return "";
    }
    std::size_t end = at;
    while (end < shown.size() && detail::is_word(shown[end])) ++end;
    return fmt::format("  {}\n  {}^{}\n", shown, std::string(at, ' '), std::string(end > at ? end - at - 1 : 0, '~'));
  }

 private:
  std::string_view rest_;
  int number_ = 1;
};

// The program of a file, if there is nothing wrong with it; else prints what is.
std::optional<TextProgram> checked(Result<ProgramFile> file, const HardwareProfile& profile, bool quiet,
                                   int& exit_code) {
  if (!file) {
    exit_code = report(file.error());
    return std::nullopt;
  }
  if (!quiet) say_notes(file->parsed.notes);
  if (!file->parsed) {
    exit_code = report(file->parsed.faults(), file->text);
    return std::nullopt;
  }
  const std::vector<StateDiagnostic> refused = validate(*file->parsed, profile);
  for (const StateDiagnostic& d : refused) {
    exit_code = report({.message = fmt::format("{}: {}", name_of(d.gl_error), d.message), .file = file->name});
  }
  if (!refused.empty()) return std::nullopt;
  return std::move(*file->parsed);
}

}  // namespace

namespace {

SourceSelection selection_in(const ProgramFlags& flags, const ProgramSource& source) {
  SourceSelection out = selection_of(flags);
  out.program = source.setup.value_or(0);
  out.include = include_beside(source.name, flags.allow_outside);
  return out;
}

}  // namespace

SourceInclude include_beside(const std::string& file, bool allow_outside) {
  const std::filesystem::path parent = std::filesystem::path(file).parent_path();
  // "-" alone would be standard input.
  const std::filesystem::path folder = parent.empty() ? "." : parent;
  return [folder, allow_outside](std::string_view name) -> std::optional<std::string> {
    std::string beside(name);
    std::replace(beside.begin(), beside.end(), '\\', '/');
    if (!allow_outside && posix::why_outside(folder, beside)) return std::nullopt;
    auto input = InputFile::open(folder / beside);
    std::string text;
    while (input) {
      auto more = input->read();
      if (!more || text.size() > kMaxSourceBytes) return std::nullopt;
      if (more->empty()) return text;
      text.append(*more);
    }
    return std::nullopt;
  };
}

Result<ProgramSource> open_program(const ProgramFlags& flags) {
  const SetupName named = setup_name(flags.file);
  auto input = InputFile::open(named.file);
  if (!input) return input.error();
  ProgramSource source{.name = input->name(), .text = {}};
  source.setup = named.setup;
  bool whole = false;
  while (!whole && source.text.size() <= kMaxSourceBytes) {
    auto more = input->read();
    if (!more) return more.error();
    whole = more->empty();
    source.text.append(*more);
  }
  source.form = form_by(flags.from, source.text);
  // A text that looks like a plain sequence of calls may still need values.
  const bool asks_for_source = !flags.functions.empty() || !flags.defines.empty();
  if (flags.from.empty() && asks_for_source && source.form == ProgramForm::gl) source.form = ProgramForm::source;
  const bool is_log = source.form == ProgramForm::log;
  const bool is_calls = source.form == ProgramForm::gl || source.form == ProgramForm::source;
  if (flags.from.empty() && is_calls && without_heading(source.text).empty()) {
    return Diagnostic{.message = "is empty; expected a program", .file = source.name};
  }
  if (named.setup && !is_log && source.form != ProgramForm::source) {
    return Diagnostic{.message = fmt::format("is neither a log of register writes nor a source file; #{} picks a "
                                             "combiner set-up of a log, or a program of a function that draws",
                                             *named.setup),
                      .file = source.name};
  }
  if (named.setup == 0U) {
    return Diagnostic{.message = "#0 is out of range; combiner set-ups are counted from 1", .file = source.name};
  }
  if (whole) return source;
  if (is_log) {
    source.rest.emplace(std::move(*input));
    return source;
  }
  const std::string kind = kind_of_file(source.text);
  if (std::string message = wrong_kind(kind, FileRole::program); !message.empty() && kind != kBinaryKind) {
    return Diagnostic{.message = std::move(message), .file = source.name};
  }
  return Diagnostic{.message = fmt::format("{}is longer than {} bytes, the limit for a program",
                                           kind.empty() ? "" : "seems to be " + kind + ", and ", kMaxSourceBytes),
                    .file = source.name};
}

Result<Parsed<RegisterLog>> read_log(ProgramSource& source, const ProgramFlags& flags, const HardwareProfile& profile,
                                     std::optional<std::uint32_t> frame) {
  const auto chip = flags.chip.empty() ? std::nullopt : std::optional(chip_of(flags, profile));
  RegisterLogReader reader(source.name, {.chip = chip, .fallback = ninebit::chip_of(profile), .frame = frame});
  reader.read(source.text);
  while (source.rest) {
    auto more = source.rest->read();
    if (!more) return more.error();
    if (more->empty()) break;
    reader.read(*more);
  }
  return reader.finish();
}

Result<ProgramFile> read_program_file(const ProgramFlags& flags, const HardwareProfile& profile) {
  auto source = open_program(flags);
  if (!source) return source.error();
  return read_program_file(std::move(*source), flags, profile);
}

Result<ProgramFile> read_program_file(ProgramSource source, const ProgramFlags& flags, const HardwareProfile& profile) {
  std::optional<Parsed<TextProgram>> parsed;
  if (source.form == ProgramForm::log) {
    auto log = read_log(source, flags, profile);
    if (!log) return log.error();
    parsed = program_in(*log, source.setup.value_or(0), source.name, profile);
  } else {
    parsed = parse_program({source.text, source.name}, source.form, profile,
                           {.chip = chip_of(flags, profile), .source = selection_in(flags, source)});
  }
  ProgramFile file{source.name, std::move(source.text), source.form, *std::move(parsed)};
  if (file.parsed) return file;
  if (std::string message = seems_to_be_else(file, flags.from); !message.empty()) {
    return Diagnostic{.message = std::move(message), .file = file.name};
  }
  return file;
}

std::optional<TextProgram> load_text_program(const ProgramFlags& flags, const HardwareProfile& profile, bool quiet,
                                             int& exit_code) {
  auto source = open_program(flags);
  if (!source) {
    exit_code = report(source.error());
    return std::nullopt;
  }
  return load_text_program(std::move(*source), flags, profile, quiet, exit_code);
}

std::optional<TextProgram> load_text_program(ProgramSource source, const ProgramFlags& flags,
                                             const HardwareProfile& profile, bool quiet, int& exit_code) {
  if (misuses_source_flags(flags, source.name, source.form)) {
    exit_code = kWrongUsage;
    return std::nullopt;
  }
  return checked(read_program_file(std::move(source), flags, profile), profile, quiet, exit_code);
}

std::optional<TextProgram> load_setup(Parsed<RegisterLog> log, ProgramSource source, const HardwareProfile& profile,
                                      bool quiet, int& exit_code) {
  auto program = program_in(log, source.setup.value_or(0), source.name, profile);
  return checked(ProgramFile{source.name, std::move(source.text), source.form, std::move(program)}, profile, quiet,
                 exit_code);
}

bool misuses_source_flags(const ProgramFlags& flags, std::string_view name, ProgramForm form) {
  if (!flags.chip.empty() && !form_row(form).has_words && !flags.writes_words) {
    say_error(fmt::format("--chip is for register words and logs; {} was read as {}", name, kind_of_form(form)));
    return true;
  }
  if (!flags.functions.empty() && form != ProgramForm::source) {
    say_error(fmt::format("--function is for source files; {} was read as {}", name, kind_of_form(form)));
    return true;
  }
  if (flags.defines.empty() || form_row(form).takes_definitions) return false;
  say_error(fmt::format("--define is for source files and pixel shaders; {} was read as {}", name, kind_of_form(form)));
  return true;
}

void say_notes(const std::vector<TextFault>& notes) {
  for (const TextFault& note : notes) say(fmt::format("ninebit: note: {}\n", printable_briefly(note.text())));
}

void say_assumed_constants(const std::string& file, const Program& program, const std::vector<EvalColumn>& given) {
  std::vector<std::string> names;
  for (const UnsetComponent& one : unset_components(program)) {
    const bool is_given = std::find(given.begin(), given.end(), EvalColumn{one.reg, one.component}) != given.end();
    const std::string name = name_of_constant(one.name);
    if (!is_given && std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  if (names.empty()) return;
  say(fmt::format("ninebit: note: {}: {} {} not set; 0 is assumed\n", printable(file), fmt::join(names, ", "),
                  names.size() == 1 ? "is" : "are"));
}

int report(const std::vector<TextFault>& faults, std::string_view text) {
  SourceLines lines(text);
  for (const TextFault& fault : faults) {
    (void)report_fault(fault);
    say(lines.marked(fault.line, fault.column));
  }
  return kInvalidInput;
}

SetupName setup_name(const std::string& name) {
  const std::string_view file = posix::without_setup(name);
  std::error_code error;
  if (file.size() == name.size() || std::filesystem::exists(name, error)) return {name};
  return {std::string(file), std::stoul(name.substr(file.size() + 1))};
}

void add_program_argument(CLI::App& verb, const std::string& name, ProgramFlags& flags) {
  verb.add_option(name, flags.file, "Program in any form; - reads standard input")
      ->required()
      ->type_name("PROGRAM")
      ->check(CLI::Validator(
          [](const std::string& text) { return std::string(text.empty() ? "the file name is empty" : ""); }, ""));
}

void add_define_flag(CLI::App& verb, std::vector<std::string>& defines) {
  verb.add_option("--define", defines, "Value that a source file or a pixel shader does not give")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false)
      ->check(CLI::Validator(
          [](const std::string& text) {
            const std::size_t equals = text.rfind('=');
            const bool good = equals != std::string::npos && equals > 0 && equals + 1 < text.size();
            return good ? std::string() : "'" + text + "' is not a definition; expected NAME=VALUE";
          },
          ""));
}

void add_program_flags(CLI::App& verb, ProgramFlags& flags) {
  add_program_argument(verb, "program", flags);
  verb.add_option("--from", flags.from, "Form of the program (default: detected from the content)")
      ->check(CLI::IsMember(read_form_names()));
  verb.add_option("--function", flags.functions, "Function of a source file to execute; several run in this order")
      ->type_name("NAME")
      ->delimiter(',')
      ->allow_extra_args(false);
  add_define_flag(verb, flags.defines);
  verb.add_option("--chip", flags.chip, "Chip whose register words are read (default: from the profile)")
      ->check(CLI::IsMember({"nv10", "nv20"}));
}

void add_include_flag(CLI::App& verb, bool& allow_outside) {
  verb.add_flag("--allow-outside", allow_outside,
                "Also read files that a source file or a pixel shader includes from outside of its folder");
}

SourceSelection selection_of(const ProgramFlags& flags) {
  SourceSelection out{.functions = flags.functions};
  for (const std::string& define : flags.defines) {
    const std::size_t equals = define.rfind('=');
    out.definitions.push_back({define.substr(0, equals), define.substr(equals + 1)});
  }
  return out;
}

ChipClass chip_of(const ProgramFlags& flags, const HardwareProfile& profile) {
  if (!flags.chip.empty()) return flags.chip == "nv10" ? ChipClass::nv10 : ChipClass::nv20;
  return ninebit::chip_of(profile);
}

}  // namespace ninebit::tools

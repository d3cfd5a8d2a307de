#include "src/tools/program_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <utility>

#include "ninebit/combiner/validate.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/json.h"
#include "ninebit/language/rc10.h"
#include "src/tools/input_file.h"

namespace ninebit::tools {
namespace {

// The text without white space and comments at its beginning; every form but `!!RC1.0` and JSON may start with those.
std::string_view without_heading(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  while (true) {
    const auto first = std::find_if(text.begin(), text.end(), [](unsigned char c) { return std::isspace(c) == 0; });
    text.remove_prefix(static_cast<std::size_t>(first - text.begin()));
    if (text.starts_with("/*")) {
      const std::size_t end = text.find("*/", 2);
      text.remove_prefix(end == std::string_view::npos ? text.size() : end + 2);
    } else if (text.starts_with("//") || text.starts_with('#')) {
      text.remove_prefix(std::min(text.find('\n'), text.size()));
    } else {
      return text;
    }
  }
}

std::string_view without_space(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())) != 0) text.remove_prefix(1);
  return text;
}

// A JSON object: the canonical form says "ninebit": "program" (or tries to), register words need not say anything.
ProgramForm json_form(std::string_view text) {
  constexpr std::string_view kKey = "\"ninebit\"";
  const std::size_t key = text.find(kKey);
  if (key == std::string_view::npos) return ProgramForm::words_json;
  std::string_view rest = without_space(text.substr(key + kKey.size()));
  if (rest.starts_with(':')) rest = without_space(rest.substr(1));
  return rest.starts_with("\"register_words\"") ? ProgramForm::words_json : ProgramForm::json;
}

// "NAME =" with a name such as RC_IN_RGB[0].
bool is_assignment(std::string_view text) {
  std::size_t i = 0;
  const auto is_name = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("_[]()").find(static_cast<char>(c)) != std::string_view::npos;
  };
  while (i < text.size() && is_name(static_cast<unsigned char>(text[i]))) ++i;
  return i > 0 && without_space(text.substr(i)).starts_with('=');
}

Parsed<CombinerState> parse(const ProgramFile& file, ChipClass chip, const HardwareProfile& profile) {
  const SourceText source{file.text, file.name};
  switch (file.form) {
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
  return Diagnostic{
      .message = fmt::format("is longer than {} bytes, the most that a program may have", kMaxSourceBytes),
      .file = input->name()};
}

}  // namespace

void add_program_flags(CLI::App& verb, ProgramFlags& flags) {
  verb.add_option("program", flags.file, "Program in any form, - for standard input")
      ->required()
      ->type_name("PROGRAM")
      ->check(CLI::Validator(
          [](const std::string& text) { return std::string(text.empty() ? "the file name is empty" : ""); }, ""));
  verb.add_option("--from", flags.from, "The program's form; told by its content where not given")
      ->check(CLI::IsMember({"gl", "rc10", "words", "json"}));
  verb.add_option("--chip", flags.chip, "The chip whose register words are meant; follows the profile where not given")
      ->check(CLI::IsMember({"nv10", "nv20"}));
}

ChipClass chip_of(const ProgramFlags& flags, const HardwareProfile& profile) {
  if (!flags.chip.empty()) return flags.chip == "nv10" ? ChipClass::nv10 : ChipClass::nv20;
  return profile.per_stage_constants ? ChipClass::nv20 : ChipClass::nv10;
}

ProgramForm form_of(std::string_view text) {
  const std::string_view content = without_heading(text);
  if (content.starts_with("!!RC1.0")) return ProgramForm::rc10;
  if (content.starts_with('{') || content.starts_with('[')) return json_form(content);
  return is_assignment(content) ? ProgramForm::words : ProgramForm::gl;
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
  file.parsed = parse(file, chip_of(flags, profile), profile);
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
  for (const TextFault& fault : faults) say(fmt::format("ninebit: error: {}\n", fault.text()));
  return kInvalidInput;
}

}  // namespace ninebit::tools

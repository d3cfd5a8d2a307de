#include "src/tools/common/program_flags.h"

#include "ninebit/language/program_text.h"

namespace ninebit::tools {

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

// `ninebit convert`: the same program in another form.
#include <fmt/format.h>

#include <memory>
#include <utility>

#include "ninebit/language/c_source.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/json.h"
#include "ninebit/language/rc10.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/program_file.h"

namespace ninebit::tools {
namespace {

struct ConvertFlags {
  CommonFlags common;
  ProgramFlags program;
  std::string to;
  std::string output;
};

Result<std::string> printed(const ConvertFlags& flags, const CombinerState& state) {
  const HardwareProfile& profile = profile_of(flags.common);
  const ChipClass chip = chip_of(flags.program, profile);
  if (flags.to == "gl") return print_gl_calls(state, profile);
  if (flags.to == "rc10") return print_rc10(state, profile);
  if (flags.to == "words") return print_register_words(state, chip, profile);
  if (flags.to == "words-json") return print_json_register_words(state, chip, profile);
  if (flags.to == "json") return print_json_program(state);
  const Program program = normalize(state, profile);
  if (flags.to == "c") return emit_c(program);
  return emit_glsl(program, flags.to == "glsl-es" ? GlslVersion::es_300 : GlslVersion::glsl_330);
}

int write(const ConvertFlags& flags, const std::string& text) {
  auto file = OutputFile::open(flags.output);
  if (!file) return report(file.error());
  if (Status written = file->write(text); !written) return report(written.error());
  if (Status finished = file->finish(); !finished) return report(finished.error());
  if (!flags.output.empty() && !flags.common.quiet) say_written(flags.output);
  return kDone;
}

int run(const ConvertFlags& flags) {
  int exit_code = kDone;
  const auto state = load_program(flags.program, profile_of(flags.common), exit_code);
  if (!state) return exit_code;
  const auto text = printed(flags, *state);
  if (!text) {
    Diagnostic lacking = text.error();
    if (lacking.file.empty()) lacking.file = flags.program.file == "-" ? "standard input" : flags.program.file;
    lacking.message = fmt::format("cannot be written as {}: {}", flags.to, lacking.message);
    return report(lacking);
  }
  if (!flags.common.json) return write(flags, *text);
  Json row{{"form", flags.to}};
  if (flags.output.empty()) {
    row["text"] = *text;
  } else {
    if (const int code = write(flags, *text); code != kDone) return code;
    row["file"] = flags.output;
  }
  const Json out{{"command", "convert"},
                 {"version", NINEBIT_VERSION},
                 {"profile", flags.common.profile},
                 {"rows", Json::array({std::move(row)})}};
  return answer(out);
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("convert", "Convert a program to another form");
  verb->footer(
      "If the form cannot express the program, the error names the unsupported features.\n"
      "Examples:\n"
      "  ninebit convert compare.gl --to rc10\n"
      "  ninebit convert program.json --to words --chip nv20 --profile nv2a -o program.words");
  auto flags = std::make_shared<ConvertFlags>();
  add_common_flags(*verb, flags->common);
  add_program_flags(*verb, flags->program);
  verb->add_option("--to", flags->to, "Form to write")
      ->required()
      ->check(CLI::IsMember({"gl", "rc10", "words", "words-json", "json", "glsl", "glsl-es", "c"}));
  verb->add_option("-o,--output", flags->output, "Write to this file instead of standard output")->type_name("FILE");
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools

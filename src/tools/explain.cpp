// `ninebit explain`: what a program computes, as equations.
#include "ninebit/language/explain.h"

#include <memory>

#include "ninebit/combiner/normalize.h"
#include "ninebit/language/json.h"
#include "src/system/stream.h"
#include "src/tools/common/explanation.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/program_file.h"
#include "src/tools/input/host.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

struct ExplainFlags {
  CommonFlags common;
  ProgramFlags program;
  std::string output;
};

DiagramPage page_of(const ExplainFlags& flags, const TextProgram& program, const Json& explanation,
                    const std::string& text) {
  DiagramPage page{.kind = "ninebit explain", .title = printable(flags.program.file)};
  page.facts = {{"Profile", printable(flags.common.profile)}, {"Version", "ninebit " NINEBIT_VERSION}};
  if (!given_command().empty()) page.facts.emplace_back("Command", printable(given_command()));
  page.program = print_json_program(program.state, {}, program.texture_shader);
  page.explanation = json_text(explanation);
  page.text = printable_lines(text);
  return page;
}

int run(const ExplainFlags& flags) {
  const HardwareProfile& profile = profile_of(flags.common);
  int exit_code = kDone;
  const auto program = load_text_program(flags.program, profile, flags.common.quiet, exit_code);
  if (!program) return exit_code;
  const Explanation explanation = explain(normalize(program->state, profile), profile);
  Json object = explanation_json(explanation, *program, flags.common.profile);
  const std::string text = explanation_text(explanation, *program);
  if (!flags.output.empty()) {
    const Status written = write_page(flags.output, page_of(flags, *program, object, text));
    if (!written) return report(written.error());
    if (!flags.common.quiet) say_written(flags.output);
    object["files"] = Json::array({flags.output});
  }
  if (host() != nullptr) {
    host()->give("page", diagram_page(page_of(flags, *program, object, text)));
    host()->give("text", text);
  }
  if (flags.common.json) return answer(object);
  return flags.output.empty() ? answer(wrapped(text, terminal_columns(posix::kStandardOutput))) : kDone;
}

}  // namespace

void add_explain(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("explain", "Print what a program computes, as equations, stage by stage");
  verb->footer(
      "Examples:\n"
      "  ninebit explain compare.gl\n"
      "  ninebit explain program.json --profile nv2a --json\n"
      "  ninebit explain compare.gl -o compare.html");
  auto flags = std::make_shared<ExplainFlags>();
  add_answer_flags(*verb, flags->common);
  add_profile_flag(*verb, flags->common);
  add_program_flags(*verb, flags->program);
  add_include_flag(*verb, flags->program.allow_outside);
  add_page_flag(*verb, flags->output);
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools

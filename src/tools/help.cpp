// `ninebit help [COMMAND …]`: the same text as `ninebit COMMAND … --help`.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "src/system/nearest_name.h"
#include "src/tools/common/usage.h"
#include "src/tools/input/host.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {
namespace {

// The help of the verb that the words name. Throws CLI::ValidationError for words that name none.
std::string help_of(const CLI::App& program, const std::vector<std::string>& words) {
  const CLI::App* at = &program;
  std::string above;
  for (const std::string& word : words) {
    const CLI::App* next = nullptr;
    std::vector<std::string> names;
    for (const CLI::App* verb : at->get_subcommands([](const CLI::App*) { return true; })) {
      if (verb->get_name() == word) next = verb;
      if (!verb->get_group().empty()) names.push_back(verb->get_name());
    }
    if (next == nullptr) {
      const std::string command = above + at->get_name();
      throw CLI::ValidationError(names.empty()
                                     ? fmt::format("`{}` has no commands of its own, such as '{}'", command, word)
                                     : fmt::format("unknown command '{}'; expected one of {}{}", word,
                                                   fmt::join(names, ", "), did_you_mean(word, names)));
    }
    above += at->get_name() + ' ';
    at = next;
  }
  // CLI::App::help() would print the help of the verb `help`, which is the one that runs.
  return at->get_formatter()->make_help(at, above + at->get_name(), CLI::AppFormatMode::Normal);
}

}  // namespace

void add_help(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("help", "Print the help of a command");
  verb->footer("Examples:\n  ninebit help render\n  ninebit help study shadows");
  auto words = std::make_shared<std::vector<std::string>>();
  verb->add_option("command", *words, "The command (default: ninebit itself)")->type_name("COMMAND ...");
  verb->callback(
      [&app, words, &exit_code] { exit_code = answer(wrapped_for_terminal(help_of(app, *words), kHelpColumn)); });
}

}  // namespace ninebit::tools

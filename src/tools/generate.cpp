// `ninebit generate man|bash|zsh|fish`: prints the manual page and the shell completions from the same CLI11 app that
// parses the command line. The build runs it; the help does not list it.
#include <memory>

#include "src/tools/help/verb_text.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

void add_generate(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("generate", "Print the manual page or the completions of a shell")->group("");
  verb->footer("Example: ninebit generate bash > ~/.local/share/bash-completion/completions/ninebit");
  auto form = std::make_shared<std::string>();
  verb->add_option("form", *form, "What to print")->required()->check(CLI::IsMember({"man", "bash", "zsh", "fish"}));
  verb->callback([form, &app, &exit_code] {
    const VerbText program = describe(app);
    exit_code = answer(*form == "man"    ? manual_page(program)
                       : *form == "bash" ? bash_completion(program)
                       : *form == "zsh"  ? zsh_completion(program)
                                         : fish_completion(program));
  });
}

}  // namespace ninebit::tools

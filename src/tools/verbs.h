// All verbs: what `ninebit` runs, and what the Python module runs in its process.
#pragma once

#include <CLI/CLI.hpp>

namespace ninebit::tools {

// Adds every verb to the app; running one sets `exit_code`.
void add_verbs(CLI::App& app, int& exit_code);

// Parses the arguments, of which the first is the program's name, and runs the verb that they name. An exception
// becomes a message and an exit code; only std::bad_alloc gets out, if even the message has no memory.
[[nodiscard]] int run_verb(int argc, char** argv);

}  // namespace ninebit::tools

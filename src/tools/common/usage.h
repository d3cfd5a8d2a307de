// The text after wrong usage, and the JSON answer of faults.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace ninebit::tools {

// The column at which help says what an option does.
inline constexpr int kHelpColumn = 30;

// One sentence: what is wrong with the arguments, what was expected or possibly meant, and the help to read.
[[nodiscard]] std::string usage_message(const CLI::App& app, const CLI::ParseError& error);

// The answer of --json to a command that failed.

// If the command line has --json and nothing was answered, prints the errors to stdout as one object:
// {"command", "version", "exit_code", "error": {"message", "file"?, "line"?, "column"?}, "errors": […]}.
// `error` is the first of `errors`. Does nothing after exit code 0.
void answer_with_faults(int argc, char** argv, int exit_code);

}  // namespace ninebit::tools

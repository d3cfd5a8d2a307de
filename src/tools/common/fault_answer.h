// The answer of --json to a command that failed.
#pragma once

namespace ninebit::tools {

// If the command line has --json and nothing was answered, prints the errors to stdout as one object:
// {"command", "version", "exit_code", "error": {"message", "file"?, "line"?, "column"?}, "errors": […]}.
// `error` is the first of `errors`. Does nothing after exit code 0.
void answer_with_faults(int argc, char** argv, int exit_code);

}  // namespace ninebit::tools

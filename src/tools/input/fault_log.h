// The errors of a run, kept beside the lines on stderr: with --json, the program answers with them.
#pragma once

#include <string>
#include <vector>

namespace ninebit::tools {

struct LoggedFault {
  std::string message{};  // one sentence, without its place
  std::string file{};     // empty: none
  int line = 0;           // from 1; 0: none
  int column = 0;         // from 1; 0: none
};

// Adds an error; say_error() and report() do. Only the first thousand are kept.
void log_fault(LoggedFault fault);
[[nodiscard]] const std::vector<LoggedFault>& logged_faults();
// Forgets the errors of an earlier run.
void clear_faults();

// Records that standard output has an answer, or a part of one.
void log_answer() noexcept;
[[nodiscard]] bool answer_is_logged() noexcept;

}  // namespace ninebit::tools

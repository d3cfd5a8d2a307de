// Another program, run as a child process: text in, text out.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ninebit::posix {

enum class ProgramEnd : std::uint8_t {
  ended,        // by itself, with any status
  crashed,      // by a signal
  out_of_time,  // killed after the given seconds
  stopped,      // killed because go_on returned false
  not_found,    // the PATH has no such program
  failed        // it could not be started, or its output could not be read
};

struct ProgramResult {
  ProgramEnd end = ProgramEnd::failed;
  int status = 0;      // of a program that ended
  std::string output;  // its standard output, until then; standard error is not kept
};

// Runs arguments[0], looked up in the PATH, writes `input` to its standard input and reads its standard output.
// `go_on`, if given, is called a few times a second.
[[nodiscard]] ProgramResult run_program(const std::vector<std::string>& arguments, std::string_view input,
                                        double seconds, const std::function<bool()>& go_on = {});

}  // namespace ninebit::posix

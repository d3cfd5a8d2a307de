// This process: its limits, its signals, its environment.
#pragma once

#include <filesystem>
#include <string>

#include "src/system/stream.h"

namespace ninebit::posix {

// Or nobody knows.
[[nodiscard]] bool is_address_space_limited();

[[nodiscard]] bool is_terminal(int standard_stream);

// Opens those of the standard streams that are closed, so that no file takes their place. Has a write beyond the limit
// of a file's size fail, instead of ending the program.
void guard_streams();

// Calls `handler` for the signals that ask a program to end: SIGINT, SIGTERM and SIGHUP. A signal that this process was
// started to ignore, as `nohup` has it, stays ignored.
void catch_interrupts(void (*handler)(int signal));

// This program's own file, which may be a link to it.
[[nodiscard]] std::filesystem::path program_file();

void set_environment(const char* name, const std::string& value);

}  // namespace ninebit::posix

// This process: its limits, its signals, its environment.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "src/system/stream.h"

namespace ninebit::posix {

// Also true if the limit cannot be read.
[[nodiscard]] bool is_address_space_limited();

[[nodiscard]] bool is_terminal(int standard_stream);

// Columns of the terminal; empty if the stream is not a terminal or does not know its size.
[[nodiscard]] std::optional<int> terminal_columns(int standard_stream);

// Opens closed standard streams on /dev/null, so that no other file gets their numbers. Makes a write beyond the file
// size limit fail instead of ending the program.
void guard_streams();

// Installs `handler` for the termination signals SIGINT, SIGTERM and SIGHUP. A signal that this process was started to
// ignore, as by `nohup`, stays ignored.
void catch_interrupts(void (*handler)(int signal));

// The path of this program's executable, or of a link to it.
[[nodiscard]] std::filesystem::path program_file();

void set_environment(const char* name, const std::string& value);
// The value of a variable; empty if it is not set.
[[nodiscard]] std::string environment(const char* name);

// Becomes another program, found as a shell finds it. Returns only if that fails.
[[nodiscard]] std::error_code become_program(const std::vector<std::string>& arguments);

// Support for running out of memory safely.

// Reserves some memory and frees it when operator new fails for the first time, before std::bad_alloc is thrown. The
// cleanup then has memory: messages, the removal of temporary files, destructors that allocate (nlohmann-json's do).
// Grows the stack of this thread by half a mebibyte, so that it does not have to grow when memory has run out.
void keep_memory_for_errors();

// True if the address space has room for `bytes` more contiguous bytes. Check this before calling a library that
// crashes when memory runs out.
[[nodiscard]] bool has_room(std::uint64_t bytes);

// Shared libraries loaded at run time.

// Loads a shared library, which stays loaded until the program ends; on failure it returns nullptr, and library_error()
// returns the reason. find_symbol() returns nullptr for a symbol that the library does not have.
[[nodiscard]] void* load_library(const std::filesystem::path& file);
[[nodiscard]] void* find_symbol(void* library, const char* name);
[[nodiscard]] std::string library_error();

}  // namespace ninebit::posix

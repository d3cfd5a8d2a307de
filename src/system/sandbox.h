// Permanent restrictions of this process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace ninebit::posix {

// Whether memory can be limited: not under sanitizers, which map terabytes.
[[nodiscard]] bool can_limit_memory();

// Limits the address space beyond what is mapped now, the processor time and the size of files, and disables core
// dumps. Existing lower limits stay.
void limit_resources(std::uint64_t more_memory, int seconds, std::uint64_t file_bytes);

// Forbids all file access except reading the named files, as far as the kernel's version of Landlock supports it; other
// access stays allowed.
void allow_only_reading(std::span<const std::filesystem::path> files);

// Allows only the system calls for computing, memory, threads, and reading and writing open files; files can be opened
// only for reading. Every other call fails with EPERM. Does nothing on processors other than x86-64 and arm64.
void forbid_system_calls();

}  // namespace ninebit::posix

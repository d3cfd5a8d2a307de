// Taking from this process, for good, what it does not need.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace ninebit::posix {

// Whether memory can be limited: not under sanitizers, which map terabytes.
[[nodiscard]] bool can_limit_memory();

// Limits on the address space beyond what is mapped now, on processor time, and on the size of files; no core dump. A
// lower limit that holds already stays.
void limit_resources(std::uint64_t more_memory, int seconds, std::uint64_t file_bytes);

// Leaves reading the named files, as far as the kernel can; what it cannot forbid stays allowed.
void allow_only_reading(std::span<const std::filesystem::path> files);

// Leaves the system calls of computing, of memory, of threads, and of reading and writing what is open; opening is left
// for reading alone. Every other call fails with EPERM. Does nothing on processors other than x86-64 and arm64.
void forbid_system_calls();

}  // namespace ninebit::posix

// Support for running out of memory safely.
#pragma once

#include <cstdint>

namespace ninebit::posix {

// Reserves some memory and frees it when operator new fails for the first time, before std::bad_alloc is thrown. The
// cleanup then has memory: messages, the removal of temporary files, destructors that allocate (nlohmann-json's do).
void keep_memory_for_errors();

// True if the address space has room for `bytes` more contiguous bytes. Check this before calling a library that
// crashes when memory runs out.
[[nodiscard]] bool has_room(std::uint64_t bytes);

}  // namespace ninebit::posix

// Memory that is about to run out.
#pragma once

#include <cstdint>

namespace ninebit::posix {

// Keeps some memory until operator new fails for the first time, and frees it then, before std::bad_alloc is thrown.
// What follows has memory: messages, the removal of temporary files, destructors that allocate (nlohmann-json's do).
void keep_memory_for_errors();

// True if the address space has room for so many more bytes in one piece. Ask before a library is called that crashes
// when memory runs out.
[[nodiscard]] bool has_room(std::uint64_t bytes);

}  // namespace ninebit::posix

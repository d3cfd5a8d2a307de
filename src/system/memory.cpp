#include "src/system/memory.h"

#include <sys/mman.h>

#include <atomic>
#include <new>

namespace ninebit::posix {
namespace {

constexpr std::size_t kKept = std::size_t{1} << 20U;

std::atomic<void*> kept = nullptr;

// Mapped, not allocated: the heap may not give freed memory back.
void* map_memory(std::size_t bytes) {
  void* const memory = ::mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

[[noreturn]] void free_kept_and_throw() {
  if (void* const memory = kept.exchange(nullptr)) ::munmap(memory, kKept);
  throw std::bad_alloc();
}

}  // namespace

void keep_memory_for_errors() {
  if (void* const older = kept.exchange(map_memory(kKept))) ::munmap(older, kKept);
  std::set_new_handler(free_kept_and_throw);
}

bool has_room(std::uint64_t bytes) {
  void* const memory = map_memory(bytes);
  if (memory == nullptr) return false;
  ::munmap(memory, bytes);
  return true;
}

}  // namespace ninebit::posix

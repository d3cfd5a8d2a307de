#include "src/system/process.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <sys/ioctl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <csignal>
#include <cstdlib>
#include <new>

#include "src/system/files.h"

namespace ninebit::posix {

bool is_address_space_limited() {
  rlimit space{};
  return ::getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur != RLIM_INFINITY;
}

bool is_terminal(int standard_stream) {
  return ::isatty(standard_stream) != 0;
}

std::optional<int> terminal_columns(int standard_stream) {
  winsize size{};
  if (::ioctl(standard_stream, TIOCGWINSZ, &size) != 0 || size.ws_col == 0) return std::nullopt;
  return size.ws_col;
}

void guard_streams() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int stream : {kStandardInput, kStandardOutput, kStandardError}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // Writing to a closed stdout stays an error; writing to a closed stderr is then not an error. open() returns the
    // lowest free number; if it fails, the stream stays closed.
    (void)::open("/dev/null", stream == kStandardError ? O_WRONLY : O_RDONLY);
  }
}

void catch_interrupts(void (*handler)(int signal)) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    struct sigaction current = {};
    if (::sigaction(signal, nullptr, &current) == 0 && current.sa_handler == SIG_IGN) continue;
    std::signal(signal, handler);
  }
}

std::filesystem::path program_file() {
  return "/proc/self/exe";
}

void set_environment(const char* name, const std::string& value) {
  ::setenv(name, value.c_str(), 1);
}

std::string environment(const char* name) {
  const char* const value = std::getenv(name);
  return value != nullptr ? value : "";
}

std::error_code become_program(const std::vector<std::string>& arguments) {
  std::vector<char*> words;
  for (const std::string& argument : arguments) words.push_back(const_cast<char*>(argument.c_str()));
  words.push_back(nullptr);
  ::execvp(words.front(), words.data());
  return last_error();
}

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

bool has_room(std::uint64_t bytes) {
  void* const memory = map_memory(bytes);
  if (memory == nullptr) return false;
  ::munmap(memory, bytes);
  return true;
}

namespace {

// The stack grows when a page of it is written for the first time. Where the address space is full by then, the process
// ends without a message.
constexpr std::size_t kStack = std::size_t{512} << 10U;

[[gnu::noinline]] void grow_stack() {
  constexpr std::size_t kPage = 4096;
  std::array<char, kStack> room;
  volatile char* const written = room.data();
  for (std::size_t end = kStack; end > 0; end -= kPage) written[end - 1] = 0;
}

}  // namespace

void keep_memory_for_errors() {
  if (has_room(kStack)) grow_stack();
  if (void* const older = kept.exchange(map_memory(kKept))) ::munmap(older, kKept);
  std::set_new_handler(free_kept_and_throw);
}

void* load_library(const std::filesystem::path& file) {
  return ::dlopen(file.c_str(), RTLD_LAZY | RTLD_LOCAL);
}

void* find_symbol(void* library, const char* name) {
  return ::dlsym(library, name);
}

std::string library_error() {
  const char* const why = ::dlerror();
  return why == nullptr ? "" : why;
}

}  // namespace ninebit::posix

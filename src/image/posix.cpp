#include "src/image/posix.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "src/image/faults.h"

namespace ninebit {
namespace {

using image_detail::Move;
using image_detail::MoveFailure;

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;
constexpr mode_t kMode = 0666;  // what the user's umask leaves of it

std::error_code last_error() noexcept {
  return {errno, std::generic_category()};
}

// Runs in a child of a process with threads as well: system calls only.
MoveFailure move_here(std::span<const Move> moves) noexcept {
  MoveFailure failure;
  while (failure.move < moves.size() && failure.error == 0) {
    const Move& move = moves[failure.move];
    if (::rename(move.from.c_str(), move.to.c_str()) == 0) {
      ++failure.move;
    } else {
      failure.error = errno;
    }
  }
  for (std::size_t i = failure.error == 0 ? 0 : failure.move; i-- > 0;) {
    const Move& move = moves[i];
    if (!move.replaces) {
      ::unlink(move.to.c_str());
    } else if (!move.older.empty()) {
      ::rename(move.older.c_str(), move.to.c_str());
    }
  }
  for (const Move& move : moves) {
    if (!move.older.empty()) ::unlink(move.older.c_str());
  }
  return failure;
}

}  // namespace

namespace image_detail {

CheckedFile::CheckedFile(std::filesystem::path file) : file_(std::move(file)), buffer_(kBufferBytes) {
  descriptor_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, kMode);
  if (descriptor_ < 0) {
    error_ = last_error();
    return;
  }
  // A failed write to a device must not remove the device.
  struct stat about = {};
  removable_ = ::fstat(descriptor_, &about) == 0 && S_ISREG(about.st_mode);
}

CheckedFile::~CheckedFile() {
  close_descriptor();
  if (!complete_ && removable_) ::unlink(file_.c_str());
}

bool CheckedFile::put(const std::byte* bytes, std::size_t size) noexcept {
  while (size > 0 && !error_) {
    const ssize_t done = ::pwrite(descriptor_, bytes, size, static_cast<off_t>(written_));
    if (done < 0) {
      if (errno != EINTR) error_ = last_error();
    } else if (done == 0) {
      error_ = std::make_error_code(std::errc::io_error);
    } else {
      bytes += done;
      size -= static_cast<std::size_t>(done);
      written_ += static_cast<std::uint64_t>(done);
    }
  }
  return !error_;
}

bool CheckedFile::flush() noexcept {
  const std::size_t size = std::exchange(pending_, 0);
  return put(buffer_.data(), size);
}

bool CheckedFile::write(const void* bytes, std::size_t size) noexcept {
  if (error_) return false;
  if (size > buffer_.size() - pending_ && !flush()) return false;
  if (size > buffer_.size()) return put(static_cast<const std::byte*>(bytes), size);
  if (size > 0) std::memcpy(buffer_.data() + pending_, bytes, size);
  pending_ += size;
  return true;
}

bool CheckedFile::seek(std::uint64_t position) noexcept {
  if (error_ || !flush()) return false;
  written_ = position;
  return true;
}

void CheckedFile::close_descriptor() noexcept {
  if (descriptor_ < 0) return;
  // Not repeated on EINTR: the descriptor is gone by then.
  if (::close(std::exchange(descriptor_, -1)) != 0 && !error_) error_ = last_error();
}

Status CheckedFile::close() {
  if (!error_) flush();
  close_descriptor();
  if (error_) return cannot_write(file_, "could not be written: " + error_.message());
  complete_ = true;
  return {};
}

std::error_code flush_to_disk(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return last_error();
  std::error_code error;
  if (::fsync(descriptor) != 0) error = last_error();
  if (::close(descriptor) != 0 && !error) error = last_error();
  return error;
}

std::error_code create_new(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
  if (descriptor < 0) return last_error();
  if (::close(descriptor) != 0) return last_error();
  return {};
}

std::uint64_t process_id() {
  return static_cast<std::uint64_t>(::getpid());
}

MoveFailure move_all(std::span<const Move> moves) {
  if (moves.size() < 2) return move_here(moves);
  constexpr int kReadWrite = PROT_READ | PROT_WRITE;
  void* const shared = ::mmap(nullptr, sizeof(MoveFailure), kReadWrite, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return move_here(moves);
  auto* const told = new (shared) MoveFailure{0, ECANCELED};  // what holds if the child does not come to tell
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setsid();  // signals to a group of processes do not mean this one
    *told = move_here(moves);
    ::_exit(0);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  // Without memory for another process, this one has to do.
  if (child < 0) *told = move_here(moves);
  while (child > 0 && ::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  const MoveFailure failure = *told;
  ::munmap(shared, sizeof(MoveFailure));
  return failure;
}

}  // namespace image_detail

namespace posix {

Stream::Stream(const std::filesystem::path& file, Access access, std::error_code& error) : descriptor_(-1) {
  const int flags = access == Access::read    ? O_RDONLY | O_NOCTTY
                    : access == Access::write ? O_WRONLY | O_NOCTTY
                                              : O_WRONLY | O_CREAT | O_EXCL;
  descriptor_ = ::open(file.c_str(), flags | O_CLOEXEC, kMode);
  struct stat about = {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &about) != 0) {
    error = last_error();
  } else if (S_ISDIR(about.st_mode)) {
    error = std::make_error_code(std::errc::is_a_directory);
  }
}

Stream::Stream(Stream&& other) noexcept : descriptor_(std::exchange(other.descriptor_, -1)) {}

Stream::~Stream() {
  if (descriptor_ > kStandardError) ::close(descriptor_);
}

bool Stream::wait(int milliseconds) const {
  pollfd one{descriptor_, POLLIN, 0};
  const int ready = ::poll(&one, 1, milliseconds);
  return ready > 0 || (ready < 0 && errno != EINTR);
}

std::size_t Stream::read(std::span<char> to, std::error_code& error) const {
  while (true) {
    const ssize_t count = ::read(descriptor_, to.data(), to.size());
    if (count >= 0) return static_cast<std::size_t>(count);
    if (errno == EINTR) continue;
    error = last_error();
    return 0;
  }
}

void Stream::write(std::string_view bytes, std::error_code& error) const {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) {
      error = last_error();
      return;
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
}

void Stream::close(std::error_code& error) {
  if (descriptor_ > kStandardError && ::close(std::exchange(descriptor_, -1)) != 0) error = last_error();
}

bool is_address_space_limited() {
  rlimit space{};
  return ::getrlimit(RLIMIT_AS, &space) != 0 || space.rlim_cur != RLIM_INFINITY;
}

bool is_terminal(int standard_stream) {
  return ::isatty(standard_stream) != 0;
}

void guard_streams() {
  std::signal(SIGXFSZ, SIG_IGN);
  for (const int stream : {kStandardInput, kStandardOutput, kStandardError}) {
    if (::fcntl(stream, F_GETFD) >= 0) continue;
    // Writing to a closed stdout stays an error, to a closed stderr it is none. open() takes the lowest free number,
    // and if it fails there is nothing better to do.
    (void)::open("/dev/null", stream == kStandardError ? O_WRONLY : O_RDONLY);
  }
}

std::span<const int> interrupts() {
  static constexpr std::array kSignals{SIGINT, SIGTERM, SIGHUP};
  return kSignals;
}

std::filesystem::path program_file() {
  return "/proc/self/exe";
}

void set_environment(const char* name, const std::string& value) {
  ::setenv(name, value.c_str(), 1);
}

void* load_library(const std::filesystem::path& file) {
  return ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
}

void* find_symbol(void* library, const char* name) {
  return ::dlsym(library, name);
}

std::string library_error() {
  const char* const why = ::dlerror();
  return why == nullptr ? "" : why;
}

}  // namespace posix
}  // namespace ninebit

#include "src/system/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <thread>

#include "src/system/files.h"

namespace ninebit::posix {

FileLock::FileLock(const std::filesystem::path& file) {
  // Without O_NONBLOCK, opening a FIFO of that name would wait for its other end.
  descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, kNewFileMode);
  struct stat about = {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &about) != 0) {
    error_ = last_error();
    return;
  }
  if (!S_ISREG(about.st_mode)) {
    error_ = std::make_error_code(std::errc::invalid_argument);
    return;
  }
  outcome_ = Outcome::held;
  if (::flock(descriptor_, LOCK_EX | LOCK_NB) == 0) return;
  if (errno == EWOULDBLOCK) outcome_ = Outcome::taken;
}

FileLock::~FileLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

FolderLock::FolderLock(const std::filesystem::path& folder, std::chrono::milliseconds longest_wait,
                       std::error_code& error)
    : descriptor_(::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  using Clock = std::chrono::steady_clock;
  constexpr std::chrono::milliseconds kPause(2);
  if (descriptor_ < 0) return;
  // LOCK_NB, so that no other process can make this one wait forever.
  for (const auto end = Clock::now() + longest_wait;; std::this_thread::sleep_for(kPause)) {
    held_ = ::flock(descriptor_, LOCK_EX | LOCK_NB) == 0;
    if (held_ || (errno != EWOULDBLOCK && errno != EINTR)) return;
    if (Clock::now() >= end) {
      error = std::make_error_code(std::errc::timed_out);
      return;
    }
  }
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

}  // namespace ninebit::posix

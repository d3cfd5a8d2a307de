#include "src/system/folder_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <thread>

#include "src/system/last_error.h"

namespace ninebit::posix {

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

#include "src/system/file_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "src/system/last_error.h"

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

}  // namespace ninebit::posix

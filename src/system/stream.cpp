#include "src/system/stream.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <utility>

#include "src/system/last_error.h"

namespace ninebit::posix {

Stream::Stream(const std::filesystem::path& file, Access access, std::error_code& error) : descriptor_(-1) {
  const int flags = access == Access::read    ? O_RDONLY | O_NOCTTY
                    : access == Access::write ? O_WRONLY | O_NOCTTY
                                              : O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW;
  descriptor_ = ::open(file.c_str(), flags | O_CLOEXEC, access == Access::create_private ? 0600 : kNewFileMode);
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

}  // namespace ninebit::posix

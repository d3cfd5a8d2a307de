#include "src/system/stream.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

#include "src/system/files.h"

namespace ninebit::posix {

namespace {

constexpr std::size_t kSmallest = 4096;  // bytes that a buffer grows by

class NotRegular final : public std::error_category {
  [[nodiscard]] const char* name() const noexcept override { return "file"; }
  [[nodiscard]] std::string message(int) const override { return "not a regular file"; }
};

}  // namespace

std::error_code not_a_regular_file() {
  static const NotRegular category;
  return {1, category};
}

Stream::Stream(const std::filesystem::path& file, Access access, std::error_code& error) : descriptor_(-1) {
  // The kind of the file is checked after it was opened, so that no other file can take its place in between.
  const int flags = access == Access::read    ? O_RDONLY | O_NOCTTY | O_NONBLOCK
                    : access == Access::write ? O_WRONLY | O_NOCTTY
                                              : O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW;
  descriptor_ = ::open(file.c_str(), flags | O_CLOEXEC, access == Access::create_private ? 0600 : kNewFileMode);
  struct stat about = {};
  if (descriptor_ < 0 || ::fstat(descriptor_, &about) != 0) {
    error = errno == ENXIO && access == Access::read ? not_a_regular_file() : last_error();  // a socket
  } else if (S_ISDIR(about.st_mode)) {
    error = std::make_error_code(std::errc::is_a_directory);
  } else if (access == Access::read && !S_ISREG(about.st_mode)) {
    error = not_a_regular_file();
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

std::string read_file(const std::filesystem::path& file, std::size_t most, std::error_code& error) {
  const Stream stream(file, Access::read, error);
  std::string content;
  if (error || most == 0) return content;
  // One byte more than the file has shows its end. Files such as those in /proc do not say their size.
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  std::size_t filled = 0,
              capacity = unknown ? 1 : static_cast<std::size_t>(std::min<std::uintmax_t>(size, most - 1)) + 1;
  for (std::size_t count = 1; !error && count > 0; filled += count) {
    if (filled == capacity) capacity += std::min(most - capacity, std::max(capacity, kSmallest));
    content.resize(capacity);
    count = stream.read(std::span(content).subspan(filled), error);
  }
  content.resize(filled);
  return content;
}

}  // namespace ninebit::posix

#include "src/tools/input_file.h"

#include <fcntl.h>
#include <sys/poll.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>
#include <utility>

namespace ninebit::tools {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;
constexpr int kPollMilliseconds = 200;

Diagnostic cannot_read(const std::string& name, int why) {
  return {.message = "could not be read: " + std::generic_category().message(why), .file = name};
}

}  // namespace

InputFile::InputFile(std::string name, int descriptor)
    : name_(std::move(name)), descriptor_(descriptor), buffer_(kPiece) {}

InputFile::InputFile(InputFile&& other) noexcept
    : name_(std::move(other.name_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      buffer_(std::move(other.buffer_)) {}

InputFile::~InputFile() {
  if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
}

Result<InputFile> InputFile::open(const std::string& path) {
  if (path == "-") return InputFile("standard input", STDIN_FILENO);
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NOCTTY);
  if (descriptor < 0) return cannot_read(path, errno);
  InputFile file(path, descriptor);
  struct stat about {};
  if (::fstat(descriptor, &about) != 0) return cannot_read(path, errno);
  if (S_ISDIR(about.st_mode)) return cannot_read(path, EISDIR);
  return file;
}

Result<std::string_view> InputFile::read(bool stoppable) {
  while (true) {
    if (stoppable) {
      // Waiting in slices: a signal between the question and the wait would otherwise be seen only with the next data.
      pollfd wait{descriptor_, POLLIN, 0};
      const int ready = ::poll(&wait, 1, kPollMilliseconds);
      if (ProgressLine::stopped()) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
      if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    }
    const ssize_t count = ::read(descriptor_, buffer_.data(), buffer_.size());
    if (count >= 0) return std::string_view(buffer_.data(), static_cast<std::size_t>(count));
    if (errno != EINTR) return cannot_read(name_, errno);
  }
}

}  // namespace ninebit::tools

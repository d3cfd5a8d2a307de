#include "src/tools/input/input_file.h"

#include <system_error>
#include <utility>

namespace ninebit::tools {
namespace {

constexpr std::size_t kPiece = std::size_t{1} << 18;
constexpr int kWaitMilliseconds = 200;

Diagnostic cannot_read(const std::string& name, std::error_code why) {
  if (why == posix::not_a_regular_file()) {
    return {.message = "is not a regular file; expected one, or - for standard input", .file = name};
  }
  return {.message = "could not be read: " + why.message(), .file = name};
}

}  // namespace

InputFile::InputFile(std::string name, posix::Stream stream)
    : name_(std::move(name)), stream_(std::move(stream)), buffer_(kPiece) {}

Result<InputFile> InputFile::open(const std::string& path) {
  if (path == "-") return InputFile("standard input", posix::Stream(posix::kStandardInput));
  std::error_code error;
  posix::Stream stream(path, posix::Access::read, error);
  if (error) return cannot_read(path, error);
  return InputFile(path, std::move(stream));
}

Result<std::string_view> InputFile::read() {
  // Waits in slices: otherwise a signal between the check and the wait would be noticed only with the next data.
  for (bool ready = false; !ready;) {
    ready = stream_.wait(kWaitMilliseconds);
    if (ProgressLine::stopped()) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  }
  std::error_code error;
  const std::size_t count = stream_.read(buffer_, error);
  if (error) return cannot_read(name_, error);
  return std::string_view(buffer_.data(), count);
}

}  // namespace ninebit::tools

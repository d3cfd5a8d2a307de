#include "src/system/checked_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cstring>
#include <utility>

#include "src/system/last_error.h"

namespace ninebit::posix {

namespace {

constexpr std::size_t kBufferBytes = std::size_t{1} << 18;

// A new file is created exclusively: nobody else can have placed anything at a name that cannot be guessed. An existing
// file is emptied; a link is an error.
int open_to_write(const std::filesystem::path& file) {
  constexpr int kFlags = O_WRONLY | O_NOFOLLOW | O_CLOEXEC;
  const int created = ::open(file.c_str(), kFlags | O_CREAT | O_EXCL, kNewFileMode);
  return created >= 0 || errno != EEXIST ? created : ::open(file.c_str(), kFlags | O_TRUNC);
}

}  // namespace

CheckedFile::CheckedFile(std::filesystem::path file) : file_(std::move(file)), buffer_(kBufferBytes) {
  descriptor_ = open_to_write(file_);
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

std::error_code CheckedFile::close() {
  if (!error_) flush();
  close_descriptor();
  complete_ = !error_;
  return error_;
}

}  // namespace ninebit::posix

#include "src/image/posix_file.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <new>
#include <utility>

#include "src/image/faults.h"

namespace ninebit::image_detail {

namespace {

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

}  // namespace ninebit::image_detail

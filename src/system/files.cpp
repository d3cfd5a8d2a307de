#include "src/system/files.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstring>
#include <new>
#include <random>
#include <utility>

namespace ninebit::posix {

namespace {

// Also runs in the child of a process with threads, so it makes only system calls.
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

std::error_code finish_open_file(int descriptor, const std::filesystem::path& target) {
  struct stat newer = {}, older = {};
  if (::fstat(descriptor, &newer) != 0) return last_error();
  if (!S_ISREG(newer.st_mode)) return std::make_error_code(std::errc::invalid_argument);
  constexpr mode_t kPermissions = 0777;
  const bool replaces = ::lstat(target.c_str(), &older) == 0 && S_ISREG(older.st_mode);
  const bool differs = ((newer.st_mode ^ older.st_mode) & kPermissions) != 0;
  if (replaces && differs && ::fchmod(descriptor, older.st_mode & kPermissions) != 0) return last_error();
  return ::fsync(descriptor) == 0 ? std::error_code() : last_error();
}

}  // namespace

std::string unpredictable_digits() {
  std::array<unsigned char, 16> bytes{};
  if (::getentropy(bytes.data(), bytes.size()) != 0) {
    std::random_device other_source;  // for kernels without the system call
    for (unsigned char& byte : bytes) byte = static_cast<unsigned char>(other_source());
  }
  constexpr char kHex[] = "0123456789abcdef";
  std::string digits;
  for (const unsigned char byte : bytes) digits.append({kHex[byte >> 4], kHex[byte & 15]});
  return digits;
}

std::filesystem::path create_private_folder(const std::filesystem::path& prefix, std::error_code& error) {
  std::string name = prefix.string() + "XXXXXX";
  error = ::mkdtemp(name.data()) == nullptr ? last_error() : std::error_code();
  return name;
}

std::error_code finish_file(const std::filesystem::path& file, const std::filesystem::path& target) {
  // O_NONBLOCK: if somebody replaced the file by a pipe, opening it must not wait for a writer.
  const int descriptor = ::open(file.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return last_error();
  std::error_code error = finish_open_file(descriptor, target);
  if (::close(descriptor) != 0 && !error) error = last_error();
  return error;
}

std::error_code create_new(const std::filesystem::path& file) {
  const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, kNewFileMode);
  if (descriptor < 0) return last_error();
  if (::close(descriptor) == 0) return {};
  // Some file systems report only now that there is no room.
  const std::error_code error = last_error();
  ::unlink(file.c_str());
  return error;
}

MoveFailure move_all(std::span<const Move> moves) {
  if (moves.size() < 2) return move_here(moves);
  constexpr int kReadWrite = PROT_READ | PROT_WRITE;
  void* const shared = ::mmap(nullptr, sizeof(MoveFailure), kReadWrite, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (shared == MAP_FAILED) return move_here(moves);
  auto* const reported = new (shared) MoveFailure{0, ECANCELED};  // the result if the child ends before it reports
  sigset_t all, before;
  ::sigfillset(&all);
  ::pthread_sigmask(SIG_SETMASK, &all, &before);
  const pid_t child = ::fork();
  if (child == 0) {
    ::setsid();  // a signal to the process group must not reach the child
    *reported = move_here(moves);
    ::_exit(0);
  }
  ::pthread_sigmask(SIG_SETMASK, &before, nullptr);
  // If fork() fails, this process renames the files.
  if (child < 0) *reported = move_here(moves);
  while (child > 0 && ::waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  const MoveFailure failure = *reported;
  ::munmap(shared, sizeof(MoveFailure));
  return failure;
}

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

#include "src/system/files.h"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <new>
#include <random>

#include "src/system/last_error.h"

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

}  // namespace ninebit::posix

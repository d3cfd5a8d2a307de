// A lock on a file for one process at a time.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <system_error>

namespace ninebit::posix {

// An advisory lock on a file, held until the object is destroyed or the process ends, however it ends. It excludes only
// other FileLocks. On a file system without locks, the lock always counts as free.
class FileLock {
 public:
  enum class Outcome : std::uint8_t {
    held,
    taken,  // by another FileLock, of this or another process
    failed  // error() says why: the file cannot be opened, or is not a regular file
  };

  // Creates the file if it does not exist; never waits.
  explicit FileLock(const std::filesystem::path& file);
  FileLock(const FileLock&) = delete;
  FileLock& operator=(const FileLock&) = delete;
  ~FileLock();

  [[nodiscard]] Outcome outcome() const noexcept { return outcome_; }
  [[nodiscard]] std::error_code error() const noexcept { return error_; }

 private:
  int descriptor_ = -1;
  Outcome outcome_ = Outcome::failed;
  std::error_code error_;
};

// A lock on a folder for one process at a time.

// An advisory lock on a folder, held until the destructor runs; a process forked in the meantime holds it until that
// process ends. It excludes only those who take it as well.
class FolderLock {
 public:
  // Waits at most `longest_wait` for the lock. `error` is set if another process holds it for that long. A folder that
  // cannot be locked, because of its permissions or its file system, is not an error; held() is then false.
  FolderLock(const std::filesystem::path& folder, std::chrono::milliseconds longest_wait, std::error_code& error);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

  [[nodiscard]] bool held() const { return held_; }

 private:
  int descriptor_;
  bool held_ = false;
};

}  // namespace ninebit::posix

// A lock on a folder for one process at a time.
#pragma once

#include <chrono>
#include <filesystem>
#include <system_error>

namespace ninebit::posix {

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

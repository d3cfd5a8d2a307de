// One process at a time in a folder.
#pragma once

#include <chrono>
#include <filesystem>
#include <system_error>

namespace ninebit::posix {

// The lock of a folder, held until the destructor, and by a process forked meanwhile until that has ended. It keeps out
// nobody but those who take it as well.
class FolderLock {
 public:
  // Waits for the lock. `error` is set where another process holds it all the time; a folder that cannot be locked,
  // because of its permissions or its file system, is not an error.
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

// A file system of its own, of a few MiB, where mounting is allowed.
#pragma once

#include <fcntl.h>
#include <sys/mount.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <string>

namespace tools_test {

class SmallDisk {
 public:
  // Mounted on the folder, which is made where it is missing, until the destructor.
  explicit SmallDisk(const std::string& folder) : folder_(folder) {
    std::filesystem::create_directory(folder);
    mounted_ = ::mount("ninebit-test", folder.c_str(), "tmpfs", 0, "size=4m") == 0;
    error_ = errno;
  }
  SmallDisk(const SmallDisk&) = delete;
  SmallDisk& operator=(const SmallDisk&) = delete;
  ~SmallDisk() {
    if (mounted_) ::umount2(folder_.c_str(), MNT_DETACH);
  }
  [[nodiscard]] bool mounted() const { return mounted_; }
  [[nodiscard]] std::string error() const { return std::strerror(error_); }

  // Writes into a file of that name until there is no room for a byte more.
  void fill(const std::string& name) const {
    const int file = ::open((folder_ + '/' + name).c_str(), O_WRONLY | O_CREAT | O_CLOEXEC, 0600);
    const std::string block(4096, 'x');
    while (::write(file, block.data(), block.size()) > 0) {
    }
    ::close(file);
  }

 private:
  std::string folder_;
  bool mounted_ = false;
  int error_ = 0;
};

}  // namespace tools_test

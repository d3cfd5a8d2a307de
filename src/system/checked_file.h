// Output files that keep their first error.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <system_error>
#include <vector>

namespace ninebit::posix {

// An output file that keeps its first error: close() reports it, whatever the libraries in between do with a failed
// write. Unless close() succeeded, the destructor removes the file if it is a regular file.
class CheckedFile {
 public:
  // Creates the file or empties an existing one; a symbolic link is an error. A failure is reported by close() and by
  // failed().
  explicit CheckedFile(std::filesystem::path file);
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;
  ~CheckedFile();

  // Writes `size` bytes at the current position; false if this or an earlier operation failed. Never throws, so it may
  // be called through C code.
  bool write(const void* bytes, std::size_t size) noexcept;
  bool seek(std::uint64_t position) noexcept;
  [[nodiscard]] std::uint64_t tell() const noexcept { return written_ + pending_; }
  [[nodiscard]] bool failed() const noexcept { return static_cast<bool>(error_); }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return file_; }

  // Writes the pending bytes and closes the file. Returns no error only if every byte since the constructor was
  // written.
  [[nodiscard]] std::error_code close();

 private:
  bool flush() noexcept;
  bool put(const std::byte* bytes, std::size_t size) noexcept;
  void close_descriptor() noexcept;

  std::filesystem::path file_;
  std::vector<std::byte> buffer_;
  std::size_t pending_ = 0;    // bytes of buffer_ not yet written
  std::uint64_t written_ = 0;  // their offset in the file
  int descriptor_ = -1;
  bool removable_ = false;
  bool complete_ = false;
  std::error_code error_;
};

}  // namespace ninebit::posix

// Output files whose every error is kept until somebody looks. The only file of this room that speaks POSIX is its
// .cpp.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <system_error>
#include <vector>

#include "ninebit/numerics/result.h"

namespace ninebit::image_detail {

// A file being written. The first error sticks: whatever the libraries in between do with a failed write, close()
// reports it. A file that was not closed without error is removed by the destructor, if it is a regular file.
class CheckedFile {
 public:
  // Creates the file or empties an existing one. A failure is reported by close(), or asked for by failed().
  explicit CheckedFile(std::filesystem::path file);
  CheckedFile(const CheckedFile&) = delete;
  CheckedFile& operator=(const CheckedFile&) = delete;
  ~CheckedFile();

  // Puts size bytes at the current position; false when this or anything before it failed. Never throws, so that it may
  // be called through C code.
  bool write(const void* bytes, std::size_t size) noexcept;
  bool seek(std::uint64_t position) noexcept;
  [[nodiscard]] std::uint64_t tell() const noexcept { return written_ + pending_; }
  [[nodiscard]] bool failed() const noexcept { return static_cast<bool>(error_); }
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return file_; }

  // Writes what is pending and closes: good only if every byte since the constructor got there.
  Status close();

 private:
  bool flush() noexcept;
  bool put(const std::byte* bytes, std::size_t size) noexcept;
  void close_descriptor() noexcept;

  std::filesystem::path file_;
  std::vector<std::byte> buffer_;
  std::size_t pending_ = 0;    // bytes of buffer_ not yet written
  std::uint64_t written_ = 0;  // where they belong in the file
  int descriptor_ = -1;
  bool removable_ = false;
  bool complete_ = false;
  std::error_code error_;
};

// Waits until the file's content is on the disk.
[[nodiscard]] std::error_code flush_to_disk(const std::filesystem::path& file);

// Creates an empty file; an existing one is an error.
[[nodiscard]] std::error_code create_new(const std::filesystem::path& file);

[[nodiscard]] std::uint64_t process_id();

// A file on its way to its name.
struct Move {
  std::filesystem::path from, to;
  std::filesystem::path older;  // a hard link to what stands at `to`; empty: nothing does, or there is no such link
  bool replaces = false;        // something stands at `to`
};

// Which move failed, and why; 0: none did.
struct MoveFailure {
  std::size_t move = 0;
  int error = 0;
};

// Renames all files, or none: what was renamed before a failure is taken back, as far as there are links to what was
// replaced; these are removed. Several files are renamed by a process of its own, which goes on where this one is
// killed meanwhile: so no signal leaves some renamed and some not.
[[nodiscard]] MoveFailure move_all(std::span<const Move> moves);

}  // namespace ninebit::image_detail

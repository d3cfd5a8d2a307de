// File operations beyond the standard library: exclusive creation, finishing, renaming several files together.
#pragma once

#include <sys/types.h>

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>
#include <vector>

namespace ninebit::posix {

// 128 random bits as hexadecimal digits. A file name with them cannot be guessed, so nobody can place a link there in
// advance.
[[nodiscard]] std::string unpredictable_digits();

// Creates a folder of a name that nobody can guess, which starts with `prefix`, for this user alone; its path.
[[nodiscard]] std::filesystem::path create_private_folder(const std::filesystem::path& prefix, std::error_code& error);

// Prepares `file` to replace `target`: copies the permission bits of `target` if it is a regular file, and waits until
// the content of `file` is on the disk. A link at `file` is an error.
[[nodiscard]] std::error_code finish_file(const std::filesystem::path& file, const std::filesystem::path& target);

// Creates an empty file; an existing one, or a link of that name, is an error. After an error there is no new file.
[[nodiscard]] std::error_code create_new(const std::filesystem::path& file);

// A rename from a temporary name to the final one.
struct Move {
  std::filesystem::path from, to;
  std::filesystem::path older;  // a hard link to the file at `to`; empty: there is no file, or no link
  bool replaces = false;        // a file exists at `to`
};

// The index of the failed move, and its errno; error 0: none failed.
struct MoveFailure {
  std::size_t move = 0;
  int error = 0;
};

// Renames all files or none. After a failure, earlier renames are undone as far as links to the replaced files exist;
// the links are removed in either case. A child process renames several files and continues if this process is killed,
// so a signal cannot leave only some of them renamed.
[[nodiscard]] MoveFailure move_all(std::span<const Move> moves);

// Output files that keep their first error.

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

// errno as an error code.

inline constexpr mode_t kNewFileMode = 0666;  // before the user's umask is applied

inline std::error_code last_error() noexcept {
  return {errno, std::generic_category()};
}

}  // namespace ninebit::posix

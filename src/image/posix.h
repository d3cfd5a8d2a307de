// What the standard library does not have of the system: its .cpp is the only file of ninebit that speaks POSIX.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "ninebit/numerics/result.h"

namespace ninebit::image_detail {

// An output file whose every error is kept until somebody looks. The first error sticks: whatever the libraries in
// between do with a failed write, close() reports it. A file that was not closed without error is removed by the
// destructor, if it is a regular file.
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

namespace ninebit::posix {

inline constexpr int kStandardInput = 0, kStandardOutput = 1, kStandardError = 2;

enum class Access : std::uint8_t {
  read,
  write,  // as it is, which is meant for devices and pipes
  create  // an existing file is an error
};

// An open file, closed at the end, or a standard stream, which stays open.
class Stream {
 public:
  explicit Stream(int standard_stream) : descriptor_(standard_stream) {}
  // A folder is an error.
  Stream(const std::filesystem::path& file, Access access, std::error_code& error);
  Stream(Stream&& other) noexcept;
  Stream& operator=(Stream&&) = delete;
  Stream(const Stream&) = delete;
  Stream& operator=(const Stream&) = delete;
  ~Stream();

  // Waits for something to read, an end or an error; false where there is none after so long, or a signal came.
  [[nodiscard]] bool wait(int milliseconds) const;
  // How many bytes were read; 0: the end, or an error.
  [[nodiscard]] std::size_t read(std::span<char> to, std::error_code& error) const;
  void write(std::string_view bytes, std::error_code& error) const;
  // Tells of what could not be written so far.
  void close(std::error_code& error);

 private:
  int descriptor_;
};

// Or nobody knows.
[[nodiscard]] bool is_address_space_limited();

[[nodiscard]] bool is_terminal(int standard_stream);

// Opens those of the standard streams that are closed, so that no file takes their place. Has a write beyond the limit
// of a file's size fail, instead of ending the program.
void guard_streams();

// The signals that ask a program to end.
[[nodiscard]] std::span<const int> interrupts();

// This program's own file, which may be a link to it.
[[nodiscard]] std::filesystem::path program_file();

void set_environment(const char* name, const std::string& value);

// A shared library that stays loaded until the program ends; nullptr: library_error() says why. find_symbol() gives
// nullptr for what it does not have.
[[nodiscard]] void* load_library(const std::filesystem::path& file);
[[nodiscard]] void* find_symbol(void* library, const char* name);
[[nodiscard]] std::string library_error();

}  // namespace ninebit::posix

// Files, devices and standard streams, read and written as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <system_error>

namespace ninebit::posix {

inline constexpr int kStandardInput = 0, kStandardOutput = 1, kStandardError = 2;

// The error where a regular file is expected and the name is that of a FIFO, a device or a socket.
[[nodiscard]] std::error_code not_a_regular_file();

enum class Access : std::uint8_t {
  read,           // of a regular file; never waits for the other end of a FIFO
  write,          // without truncation, for devices and pipes
  create,         // an existing file or link is an error
  create_private  // like create; only the owner may read or write the file
};

// An open file, closed by the destructor, or a standard stream, which stays open.
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

  // Waits for data, the end or an error; false after the timeout or a signal.
  [[nodiscard]] bool wait(int milliseconds) const;
  // Returns the number of bytes read; 0 at the end or on an error.
  [[nodiscard]] std::size_t read(std::span<char> to, std::error_code& error) const;
  void write(std::string_view bytes, std::error_code& error) const;
  // Also reports errors of earlier writes that were delayed until now.
  void close(std::error_code& error);

 private:
  int descriptor_;
};

// The content of a regular file; of a longer one, its first `most` bytes.
[[nodiscard]] std::string read_file(const std::filesystem::path& file, std::size_t most, std::error_code& error);

}  // namespace ninebit::posix

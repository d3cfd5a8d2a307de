// Files, devices and standard streams, read and written as bytes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <system_error>

namespace ninebit::posix {

inline constexpr int kStandardInput = 0, kStandardOutput = 1, kStandardError = 2;

enum class Access : std::uint8_t {
  read,
  write,          // as it is, which is meant for devices and pipes
  create,         // an existing file or link is an error
  create_private  // the same; nobody but its owner may read or write the file
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

}  // namespace ninebit::posix

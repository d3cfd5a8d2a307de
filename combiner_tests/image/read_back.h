// What the tests of this room need: a folder of their own, and readers and makers of files that share no code with
// src/.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/support/temp_folder.h"

namespace image_test {

using ninebit::test::read_exr;
using ninebit::test::read_png;
using ninebit::test::read_png16;
using ninebit::test::StoredChannel;
using ninebit::test::StoredPart;
using ninebit::test::TempFolder;

std::string read_bytes(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, std::string_view bytes);

// The names of a PNG's chunks, in order.
std::vector<std::string> png_chunks(std::string_view png);

// Lets every file grow to `bytes` only, as a full disk would: further writes fail. Restored by the destructor. Nothing
// may be printed in between, because that might go to a file as well.
class FileSizeLimit {
 public:
  explicit FileSizeLimit(std::uint64_t bytes);
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit();

 private:
  std::uint64_t before_ = 0;
  void (*handler_before_)(int) = nullptr;
};

// A reproducible value per index, different in every bit.
inline std::uint32_t scramble(std::uint32_t index) {
  index ^= index >> 16;
  index *= 0x7feb352dU;
  index ^= index >> 15;
  index *= 0x846ca68bU;
  return index ^ (index >> 16);
}

}  // namespace image_test

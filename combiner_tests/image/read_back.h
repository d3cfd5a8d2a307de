// What the tests of this room need: a folder of their own, and readers and makers of files that share no code with
// src/.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/image/image_io.h"

namespace image_test {

// A new folder, removed with everything in it.
class TempFolder {
 public:
  TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  ~TempFolder();
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  // The names in the folder, sorted.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

std::string read_bytes(const std::filesystem::path& file);
void write_bytes(const std::filesystem::path& file, std::string_view bytes);

// One channel as stored; only the vector of its type is filled.
struct StoredChannel {
  std::vector<std::uint32_t> integers;  // UINT
  std::vector<float> reals;             // HALF
  std::vector<float> floats;            // FLOAT
};

struct StoredPart {
  std::string name;
  int width = 0;
  int height = 0;
  bool zip = false;
  bool cube = false;  // has the envmap attribute with ENVMAP_CUBE
  std::map<std::string, StoredChannel> channels;
};

// All parts, by OpenEXR's own reader. Throws where that does.
std::vector<StoredPart> read_exr(const std::filesystem::path& file);

// An 8-bit picture with alpha as stored, by OpenImageIO's own reader. Throws std::runtime_error where it fails.
ninebit::Image8 read_png(const std::filesystem::path& file);
// The same of a 16-bit picture; throws also where the file has another depth.
ninebit::Image16 read_png16(const std::filesystem::path& file);

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

// What the tests of this room need: a folder of their own, and readers and makers of files that share no code with
// src/.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

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

// A PNG in the plainest encoding there is (no filter, no compression), written from the format's specification. `depth`
// is 8 or 16; `bytes` are the samples as the file stores them. Channels: 1 grey, 2 grey and alpha, 3 RGB, 4 RGBA.
std::string plain_png(int width, int height, int channels, int depth, const std::vector<std::uint8_t>& bytes);

// The pieces of which plain_png is made: a chunk with its length and checksum, and zlib's container around one stored
// block (65535 bytes at most).
inline const std::string kPngSignature = "\x89PNG\r\n\x1a\n";
std::string png_chunk(const std::string& name, const std::string& content);
std::string stored_deflate(const std::string& bytes);

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

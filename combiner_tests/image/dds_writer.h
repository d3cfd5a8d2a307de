// A small DDS encoder for the tests of reading: from the format's documentation, without a line of src/.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace image_test {

// The header's words as they will be written; a test spoils what it wants to be wrong.
struct DdsFile {
  std::uint32_t width = 4;
  std::uint32_t height = 4;
  std::uint32_t flags = 0x1007;  // caps, height, width, pixel format
  std::uint32_t pitch = 0;
  std::uint32_t depth = 0;
  std::uint32_t levels = 0;
  std::uint32_t header_size = 124;
  std::uint32_t pixel_format_size = 32;
  std::uint32_t pixel_flags = 0x4;
  std::string four_cc = std::string("DXT1");
  std::uint32_t bits = 0;
  std::uint32_t red = 0, green = 0, blue = 0, alpha = 0;
  std::uint32_t caps2 = 0;
  std::string data{};  // all faces, each with all its levels

  [[nodiscard]] std::string bytes() const {
    std::string out = "DDS ";
    const auto word = [&](std::uint32_t value) {
      for (int i = 0; i < 4; ++i) out += static_cast<char>((value >> (8 * i)) & 255);
    };
    for (const std::uint32_t value : {header_size, flags, height, width, pitch, depth, levels}) word(value);
    for (int i = 0; i < 11; ++i) word(0);
    word(pixel_format_size);
    word(pixel_flags);
    for (std::size_t i = 0; i < 4; ++i) out += i < four_cc.size() ? four_cc[i] : '\0';
    for (const std::uint32_t value : {bits, red, green, blue, alpha}) word(value);
    for (const std::uint32_t value : {levels > 1 ? 0x401008U : 0x1000U, caps2, 0U, 0U, 0U}) word(value);
    return out + data;
  }

  void make_cube() { caps2 = 0xFE00; }
  void make_uncompressed(std::uint32_t kind, std::uint32_t bit_count) {
    pixel_flags = kind;
    four_cc.clear();
    bits = bit_count;
  }
};

}  // namespace image_test

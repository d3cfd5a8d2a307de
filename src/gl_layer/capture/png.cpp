#include "src/gl_layer/capture/png.h"

#include <algorithm>

namespace ninebit::gl_layer {
namespace {

std::string big_endian(std::uint32_t value) {
  std::string bytes;
  for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255U);
  return bytes;
}

std::uint32_t adler(std::string_view bytes) {
  std::uint32_t a = 1, b = 0;
  for (const char byte : bytes) {
    a = (a + static_cast<unsigned char>(byte)) % 65521U;
    b = (b + a) % 65521U;
  }
  return b << 16U | a;
}

std::string chunk(std::string_view type, std::string_view content) {
  std::string body(type);
  body += content;
  return big_endian(static_cast<std::uint32_t>(content.size())) + body + big_endian(crc_of(body));
}

// A zlib stream of blocks that are stored as they are.
std::string stored(std::string_view bytes) {
  constexpr std::size_t kBlock = 65535;
  std::string out("\x78\x01", 2);
  for (std::size_t at = 0; at < bytes.size(); at += kBlock) {
    const std::size_t size = std::min(kBlock, bytes.size() - at);
    out += at + size == bytes.size() ? '\1' : '\0';
    for (const std::size_t word : {size, ~size}) {
      out += static_cast<char>(word & 255U);
      out += static_cast<char>(word >> 8U & 255U);
    }
    out += bytes.substr(at, size);
  }
  return out + big_endian(adler(bytes));
}

}  // namespace

std::uint32_t crc_of(std::string_view bytes) {
  std::uint32_t value = ~0U;
  for (const char byte : bytes) {
    value ^= static_cast<unsigned char>(byte);
    for (int bit = 0; bit < 8; ++bit) value = (value >> 1U) ^ ((value & 1U) != 0 ? 0xEDB88320U : 0U);
  }
  return ~value;
}

std::string png_file(const std::vector<std::array<unsigned char, 4>>& pixels, std::size_t width) {
  const std::size_t height = pixels.size() / width;
  std::string rows;
  rows.reserve(pixels.size() * 4 + height);
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (i % width == 0) rows += '\0';  // no filter
    for (const unsigned char byte : pixels[i]) rows += static_cast<char>(byte);
  }
  const std::string size =
      big_endian(static_cast<std::uint32_t>(width)) + big_endian(static_cast<std::uint32_t>(height));
  return "\x89PNG\r\n\x1A\n" + chunk("IHDR", size + std::string("\x08\x06\0\0\0", 5)) + chunk("IDAT", stored(rows)) +
         chunk("IEND", "");
}

}  // namespace ninebit::gl_layer

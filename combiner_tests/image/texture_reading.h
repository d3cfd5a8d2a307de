// Shared by the tests of reading textures.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>

#include "combiner_tests/image/read_back.h"
#include "ninebit/image/texture_io.h"
#include "ninebit/numerics/hardware_profile.h"

namespace image_test {

inline std::string random_bytes(std::size_t count, std::uint32_t seed) {
  std::string bytes;
  for (std::size_t i = 0; i < count; ++i) {
    bytes += static_cast<char>(image_test::scramble(seed * 7919 + static_cast<std::uint32_t>(i)) >> 9);
  }
  return bytes;
}

inline int byte_at(const ninebit::Texture& texture, std::size_t face, std::size_t level, std::size_t k, int x, int y) {
  return std::get<0>(texture.faces[face][level].planes)[k].at(x, y);
}

// A file of those bytes in a folder of its own.
struct Written {
  TempFolder folder{};
  std::filesystem::path path;
  explicit Written(const std::string& bytes, const char* name = "a.dds") : path(folder.path() / name) {
    image_test::write_bytes(path, bytes);
  }
};

inline ninebit::Texture read_good(const std::filesystem::path& file,
                                  const ninebit::HardwareProfile& profile = ninebit::profiles::geforce2,
                                  const ninebit::TextureReadOptions& options = {}) {
  auto texture = ninebit::read_texture(profile, file, options);
  EXPECT_TRUE(texture.ok()) << (texture.ok() ? "" : texture.error().text());
  return texture.ok() ? std::move(texture).value() : ninebit::Texture{};
}

// The fault of reading, without the file's name, which it must begin with.
inline std::string complaint(const std::filesystem::path& file) {
  const auto texture = ninebit::read_texture(ninebit::profiles::geforce2, file);
  if (texture.ok()) return "";
  EXPECT_EQ(texture.error().file, file.string());
  EXPECT_EQ(texture.error().fault, ninebit::Fault::invalid_input);
  EXPECT_EQ(texture.error().message.find('\n'), std::string::npos);
  return texture.error().message;
}

}  // namespace image_test

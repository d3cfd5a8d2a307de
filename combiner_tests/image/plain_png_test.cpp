// Plain PNG files, which libpng reads alone: the same textures as OpenImageIO's, and what is left to that.
#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "combiner_tests/image/texture_reading.h"
#include "combiner_tests/support/stored_pictures.h"
#include "src/image/texture/texture_file.h"

namespace {

using image_test::random_bytes;
using image_test::TempFolder;
using ninebit::image_detail::FileTexture;
using ninebit::image_detail::is_plain_png;
using ninebit::image_detail::PictureSource;
using ninebit::image_detail::read_picture;
using ninebit::image_detail::read_plain_png;
namespace fs = std::filesystem;

fs::path written(const TempFolder& folder, const std::string& name, int width, int height, int channels) {
  const std::string bytes = random_bytes(static_cast<std::size_t>(width * height * channels), 5);
  const fs::path file = folder.path() / name;
  ninebit::test::write_as(file, {width, height, channels, std::vector<std::uint8_t>(bytes.begin(), bytes.end())});
  return file;
}

void expect_same(const FileTexture& one, const FileTexture& other) {
  EXPECT_EQ(one.format, other.format);
  ASSERT_EQ(one.faces.size(), 1U);
  const ninebit::TextureSamples &a = one.faces[0][0], &b = other.faces[0][0];
  EXPECT_EQ(std::pair(a.width, a.height), std::pair(b.width, b.height));
  EXPECT_EQ(a.samples, b.samples);
}

TEST(PlainPng, IsReadAsOpenImageIoReadsIt) {
  const TempFolder folder;
  for (int channels = 1; channels <= 4; ++channels) {
    SCOPED_TRACE(channels);
    const fs::path file = written(folder, "a.png", 13, 7, channels);
    ASSERT_TRUE(is_plain_png({.file = file}));
    const auto plain = read_plain_png({.file = file}), usual = read_picture({.file = file});
    ASSERT_TRUE(plain && usual);
    expect_same(*plain, *usual);
    const std::string text = image_test::read_bytes(file);
    const std::vector<std::uint8_t> bytes(text.begin(), text.end());
    const PictureSource in_memory{.file = "embedded", .bytes = bytes};
    ASSERT_TRUE(is_plain_png(in_memory));
    const auto embedded = read_plain_png(in_memory);
    ASSERT_TRUE(embedded);
    expect_same(*embedded, *usual);
  }
}

TEST(PlainPng, OthersAreLeftToOpenImageIo) {
  const TempFolder folder;
  EXPECT_FALSE(is_plain_png({.file = folder.path() / "none.png"}));
  EXPECT_FALSE(is_plain_png({.file = written(folder, "a.jpg", 8, 8, 3)}));
  const std::string bytes = image_test::read_bytes(written(folder, "a.png", 8, 8, 3));
  const fs::path file = folder.path() / "changed.png";
  for (const auto& [at, value] : {std::pair{24, 16}, {24, 4}, {25, 3}}) {  // other depths, a palette
    std::string changed = bytes;
    changed[static_cast<std::size_t>(at)] = static_cast<char>(value);
    image_test::write_bytes(file, changed);
    EXPECT_FALSE(is_plain_png({.file = file})) << at << ' ' << value;
  }
  std::string huge = bytes;
  huge[17] = 1;  // 65,544 pixels wide
  for (const std::string& damaged : {bytes.substr(0, bytes.size() / 2), bytes.substr(0, 40), huge}) {
    image_test::write_bytes(file, damaged);
    EXPECT_TRUE(is_plain_png({.file = file}));
    EXPECT_FALSE(read_plain_png({.file = file})) << damaged.size();
  }
}

// Damaged files that are read here give the picture that OpenImageIO reads.
TEST(PlainPng, DamagedFilesAreReadAlikeOrNot) {
  const TempFolder folder;
  const std::string bytes = image_test::read_bytes(written(folder, "a.png", 8, 8, 4));
  std::uint32_t number = 0;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(image_test::scramble(++number) >> 9);
    const fs::path file = folder.path() / "damaged.png";
    image_test::write_bytes(file, damaged);
    if (!is_plain_png({.file = file})) continue;
    const auto plain = read_plain_png({.file = file});
    if (!plain) continue;
    const auto usual = read_picture({.file = file});
    ASSERT_TRUE(usual) << at << ": " << usual.error().message;
    expect_same(*plain, *usual);
  }
}

}  // namespace

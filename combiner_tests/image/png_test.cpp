#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "combiner_tests/image/read_back.h"
#include "ninebit/image/image_io.h"
#include "src/system/parallel/parallel_loop.h"

namespace {

using image_test::TempFolder;
using ninebit::Fault;
using ninebit::Image8;

// Every byte value in every channel; alpha is 0 beside bright colours, so that a premultiplication would show.
Image8 test_picture(int width, int height, int channels) {
  Image8 image{width, height, channels, {}};
  const std::size_t count = static_cast<std::size_t>(width * height * channels);
  for (std::size_t i = 0; i < count; ++i) {
    image.pixels.push_back(static_cast<std::uint8_t>(image_test::scramble(static_cast<std::uint32_t>(i))));
  }
  if (channels == 4) {
    for (std::size_t pixel = 0; pixel < count / 4; pixel += 3) {
      image.pixels[pixel * 4] = 255;
      image.pixels[pixel * 4 + 3] = static_cast<std::uint8_t>(pixel % 2);
    }
  }
  return image;
}

class PngChannels : public testing::TestWithParam<int> {};

TEST_P(PngChannels, WritesWhatOpenImageIoReads) {
  const TempFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{1, 300}, std::pair{300, 1}, std::pair{129, 67}}) {
    const Image8 expected = test_picture(width, height, GetParam());
    const auto status = ninebit::write_png(folder.path() / "a.png", expected);
    ASSERT_TRUE(status.ok()) << status.error().text();
    const Image8 image = image_test::read_png(folder.path() / "a.png");
    EXPECT_EQ(image.width, width);
    EXPECT_EQ(image.height, height);
    EXPECT_EQ(image.channels, GetParam());
    EXPECT_EQ(image.pixels, expected.pixels);
  }
}

TEST_P(PngChannels, EncodesWhatItWrites) {
  const TempFolder folder;
  const Image8 image = test_picture(129, 67, GetParam());
  ASSERT_TRUE(ninebit::write_png(folder.path() / "a.png", image).ok());
  const auto bytes = ninebit::encode_png(image);
  ASSERT_TRUE(bytes.ok()) << bytes.error().text();
  EXPECT_EQ(*bytes, image_test::read_bytes(folder.path() / "a.png"));
  Image8 short_of_one = image;
  short_of_one.pixels.pop_back();
  EXPECT_FALSE(ninebit::encode_png(short_of_one).ok());
}

TEST_P(PngChannels, HoldsNothingButThePicture) {
  const TempFolder folder;
  const Image8 image = test_picture(64, 64, GetParam());
  ASSERT_TRUE(ninebit::write_png(folder.path() / "a.png", image).ok());
  ASSERT_TRUE(ninebit::write_png(folder.path() / "b.png", image).ok());
  const std::string bytes = image_test::read_bytes(folder.path() / "a.png");
  EXPECT_EQ(bytes, image_test::read_bytes(folder.path() / "b.png"));
  const std::vector<std::string> chunks = image_test::png_chunks(bytes);
  ASSERT_GE(chunks.size(), 3U);
  EXPECT_EQ(chunks.front(), "IHDR");
  EXPECT_EQ(chunks.back(), "IEND");
  for (const std::string& name : chunks) {
    for (const char* unwanted : {"tIME", "tEXt", "zTXt", "iTXt", "gAMA", "sRGB", "iCCP", "cHRM", "eXIf"}) {
      EXPECT_NE(name, unwanted);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, PngChannels, testing::Values(1, 3, 4));

TEST(Png, ReplacesALargerFileWhole) {
  const TempFolder folder;
  const auto file = folder.path() / "a.png";
  ASSERT_TRUE(ninebit::write_png(file, test_picture(200, 200, 4)).ok());
  ASSERT_TRUE(ninebit::write_png(file, test_picture(2, 2, 4)).ok());
  ASSERT_TRUE(ninebit::write_png(folder.path() / "b.png", test_picture(2, 2, 4)).ok());
  EXPECT_EQ(image_test::read_bytes(file), image_test::read_bytes(folder.path() / "b.png"));
}

TEST(Png, ReportsSenselessPictures) {
  const TempFolder folder;
  const auto file = folder.path() / "a.png";
  const auto expect_refused = [&](int width, int height, int channels, std::size_t bytes) {
    const auto status = ninebit::write_png(file, Image8{width, height, channels, std::vector<std::uint8_t>(bytes)});
    ASSERT_FALSE(status.ok()) << width << " x " << height << " x " << channels;
    EXPECT_EQ(status.error().fault, Fault::invalid_input);
    EXPECT_EQ(status.error().file, file.string());
  };
  expect_refused(0, 4, 3, 0);
  expect_refused(4, 0, 3, 0);
  expect_refused(-2, -2, 3, 12);
  expect_refused(16385, 1, 1, 16385);
  expect_refused(1 << 30, 1 << 30, 4, 4);
  expect_refused(4, 4, 0, 0);
  expect_refused(4, 4, 2, 32);
  expect_refused(4, 4, 5, 80);
  expect_refused(4, 4, 3, 47);
  expect_refused(4, 4, 3, 49);
  EXPECT_TRUE(folder.names().empty());
}

// Many pieces, more than are compressed at a time, flat in one half and noisy in the other.
TEST(Png, WritesALargePicture) {
  const TempFolder folder;
  Image8 expected = test_picture(1500, 1200, 3);
  std::fill_n(expected.pixels.begin(), expected.pixels.size() / 2, std::uint8_t{24});
  ASSERT_TRUE(ninebit::write_png(folder.path() / "a.png", expected).ok());
  EXPECT_EQ(image_test::read_png(folder.path() / "a.png").pixels, expected.pixels);
  const std::string bytes = image_test::read_bytes(folder.path() / "a.png");
  EXPECT_GT(image_test::png_chunks(bytes).size(), 18U);
  const ninebit::ScopedThreadLimit one(1);
  ASSERT_TRUE(ninebit::write_png(folder.path() / "b.png", expected).ok());
  EXPECT_TRUE(bytes == image_test::read_bytes(folder.path() / "b.png")) << "another number of threads";
}

TEST(Png, WritesTheWidestRow) {
  const TempFolder folder;
  const Image8 expected = test_picture(16384, 2, 4);
  ASSERT_TRUE(ninebit::write_png(folder.path() / "a.png", expected).ok());
  const Image8 image = image_test::read_png(folder.path() / "a.png");
  EXPECT_EQ(image.pixels, expected.pixels);
}

}  // namespace

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "combiner_tests/image/read_back.h"
#include "ninebit/image/image_io.h"

namespace {

using image_test::plain_png;
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

TEST_P(PngChannels, ReadsAFileMadeFromTheSpecification) {
  const TempFolder folder;
  const Image8 expected = test_picture(37, 11, GetParam());
  image_test::write_bytes(folder.path() / "a.png", plain_png(37, 11, GetParam(), 8, expected.pixels));
  const auto image = ninebit::read_png(folder.path() / "a.png");
  ASSERT_TRUE(image.ok()) << image.error().text();
  EXPECT_EQ(image->width, 37);
  EXPECT_EQ(image->height, 11);
  EXPECT_EQ(image->channels, GetParam());
  EXPECT_EQ(image->pixels, expected.pixels);
}

TEST_P(PngChannels, WritesWhatItReads) {
  const TempFolder folder;
  for (const auto& [width, height] : {std::pair{1, 1}, std::pair{1, 300}, std::pair{300, 1}, std::pair{129, 67}}) {
    const Image8 expected = test_picture(width, height, GetParam());
    const auto status = ninebit::write_png(folder.path() / "a.png", expected);
    ASSERT_TRUE(status.ok()) << status.error().text();
    const auto image = ninebit::read_png(folder.path() / "a.png");
    ASSERT_TRUE(image.ok()) << image.error().text();
    EXPECT_EQ(image->width, width);
    EXPECT_EQ(image->height, height);
    EXPECT_EQ(image->channels, GetParam());
    EXPECT_EQ(image->pixels, expected.pixels);
  }
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

using Chunks = std::vector<std::pair<std::string, std::string>>;

std::string png_of(const Chunks& chunks) {
  std::string png = image_test::kPngSignature;
  for (const auto& [name, content] : chunks) png += image_test::png_chunk(name, content);
  return png;
}

void expect_unreadable(const std::filesystem::path& file, const std::string& what) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  const auto image = ninebit::read_png(file);
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "") << what;
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << what;
  ASSERT_FALSE(image.ok()) << what;
  EXPECT_EQ(image.error().fault, Fault::invalid_input) << what;
  EXPECT_EQ(image.error().file, file.string()) << what;
  EXPECT_FALSE(image.error().message.empty()) << what;
}

TEST(Png, ReportsUnreadableFiles) {
  const TempFolder folder;
  const auto file = folder.path() / "a.png";
  expect_unreadable(folder.path() / "missing.png", "missing");
  expect_unreadable(folder.path(), "a folder");
  const Image8 image = test_picture(40, 40, 3);
  const std::string whole = plain_png(40, 40, 3, 8, image.pixels);
  for (const std::size_t size : {std::size_t{0}, std::size_t{7}, std::size_t{20}, std::size_t{60}, whole.size() / 2}) {
    image_test::write_bytes(file, whole.substr(0, size));
    expect_unreadable(file, "truncated to " + std::to_string(size));
  }
  image_test::write_bytes(file, "P6\n1 1\n255\nabc");
  expect_unreadable(file, "not a PNG");
  std::string damaged = whole;
  damaged[damaged.size() / 2] = static_cast<char>(damaged[damaged.size() / 2] ^ 0x55);
  image_test::write_bytes(file, damaged);
  expect_unreadable(file, "a byte of the content changed");
  image_test::write_bytes(file, plain_png(4, 4, 2, 8, std::vector<std::uint8_t>(32)));
  expect_unreadable(file, "two channels");
  image_test::write_bytes(file, plain_png(4, 4, 3, 16, std::vector<std::uint8_t>(96)));
  expect_unreadable(file, "16 bits");
}

TEST(Png, ReportsMalformedChunks) {
  const TempFolder folder;
  const auto file = folder.path() / "a.png";
  const std::string header("\0\0\0\2\0\0\0\1\x8\3\0\0\0", 13);  // 2 x 1, palette
  const auto expect_refused = [&](const Chunks& chunks, const char* what) {
    image_test::write_bytes(file, png_of(chunks));
    expect_unreadable(file, what);
  };
  const std::string data = image_test::stored_deflate(std::string("\0\0\1", 3));
  expect_refused({{"PLTE", "abcdef"}, {"IHDR", header}, {"IDAT", data}, {"IEND", ""}}, "header not first");
  expect_refused({{"IHDR", header}, {"IHDR", header}, {"IDAT", data}, {"IEND", ""}}, "two headers");
  expect_refused({{"IHDR", header}, {"IDAT", data}, {"IEND", ""}}, "no palette");
  expect_refused({{"IHDR", header}, {"PLTE", "abcde"}, {"IDAT", data}, {"IEND", ""}}, "a palette of 5 bytes");
  expect_refused({{"IHDR", header}, {"PLTE", "abcdef"}, {"tRNS", "abc"}, {"IDAT", data}, {"IEND", ""}}, "3 alphas");
  expect_refused({{"IHDR", header}, {"PLTE", "abcdef"}, {"IEND", ""}}, "no data");
  expect_refused({{"IHDR", header}, {"PLTE", "abcdef"}, {"IDAT", data}}, "no end");
  expect_refused({{"IHDR", header}, {"PLTE", "abcdef"}, {"NEWC", "x"}, {"IDAT", data}, {"IEND", ""}}, "unknown chunk");
  std::string huge = header;
  huge[0] = '\x7f';
  expect_refused({{"IHDR", huge}, {"PLTE", "abcdef"}, {"IDAT", data}, {"IEND", ""}}, "far too wide");
  huge[0] = '\xff';
  expect_refused({{"IHDR", huge}, {"PLTE", "abcdef"}, {"IDAT", data}, {"IEND", ""}}, "a negative width");
}

// Palettes are expanded, and what says nothing about the pixels is not even looked at: no warning may be printed.
TEST(Png, ReadsPalettesAndIgnoresProfiles) {
  const TempFolder folder;
  const auto file = folder.path() / "a.png";
  const std::string header("\0\0\0\2\0\0\0\1\x8\3\0\0\0", 13);
  const std::string data = image_test::stored_deflate(std::string("\0\1\0", 3));
  const auto read = [&](const Chunks& chunks) {
    image_test::write_bytes(file, png_of(chunks));
    testing::internal::CaptureStderr();
    auto image = ninebit::read_png(file);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
    return image;
  };
  auto image =
      read({{"IHDR", header}, {"iCCP", "broken"}, {"gAMA", "x"}, {"PLTE", "abcdef"}, {"IDAT", data}, {"IEND", ""}});
  ASSERT_TRUE(image.ok()) << image.error().text();
  EXPECT_EQ(image->channels, 3);
  EXPECT_EQ(image->pixels, (std::vector<std::uint8_t>{'d', 'e', 'f', 'a', 'b', 'c'}));
  image = read({{"IHDR", header}, {"PLTE", "abcdef"}, {"tRNS", std::string(1, '\0')}, {"IDAT", data}, {"IEND", ""}});
  ASSERT_TRUE(image.ok()) << image.error().text();
  EXPECT_EQ(image->channels, 4);
  EXPECT_EQ(image->pixels, (std::vector<std::uint8_t>{'d', 'e', 'f', 255, 'a', 'b', 'c', 0}));
}

TEST(Png, WidensShortGrey) {
  const TempFolder folder;
  const auto file = folder.path() / "a.png";
  const std::string header("\0\0\0\4\0\0\0\1\2\0\0\0\0", 13);  // 4 x 1, grey of 2 bits
  const std::string data = image_test::stored_deflate(std::string("\0\x1b", 2));
  image_test::write_bytes(file, png_of({{"IHDR", header}, {"IDAT", data}, {"IEND", ""}}));
  const auto image = ninebit::read_png(file);
  ASSERT_TRUE(image.ok()) << image.error().text();
  EXPECT_EQ(image->channels, 1);
  EXPECT_EQ(image->pixels, (std::vector<std::uint8_t>{0, 85, 170, 255}));
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

TEST(Png, WritesTheWidestRow) {
  const TempFolder folder;
  const Image8 expected = test_picture(16384, 2, 4);
  ASSERT_TRUE(ninebit::write_png(folder.path() / "a.png", expected).ok());
  const auto image = ninebit::read_png(folder.path() / "a.png");
  ASSERT_TRUE(image.ok());
  EXPECT_EQ(image->pixels, expected.pixels);
}

}  // namespace

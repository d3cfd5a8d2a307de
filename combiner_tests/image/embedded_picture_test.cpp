// Pictures read from bytes, and pictures whose sides are not powers of two.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <string>
#include <vector>

#include "combiner_tests/image/texture_reading.h"
#include "combiner_tests/support/stored_pictures.h"

namespace {

using image_test::byte_at;
using image_test::TempFolder;
using ninebit::Result;
using ninebit::Texture;
using ninebit::TextureReadOptions;
using ninebit::profiles::geforce2;

std::span<const std::uint8_t> span_of(const std::string& bytes) {
  return {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()};
}

ninebit::Image8 picture(int width, int height) {
  ninebit::Image8 image{width, height, 3, {}};
  for (int i = 0; i < width * height * 3; ++i)
    image.pixels.push_back(static_cast<std::uint8_t>(image_test::scramble(static_cast<std::uint32_t>(i)) >> 8));
  return image;
}

TEST(EmbeddedPictures, AreThoseOfFiles) {
  const TempFolder folder;
  for (const char* name : {"a.png", "a.jpg"}) {
    ninebit::test::write_as(folder.path() / name, picture(16, 8));
    const Texture file = image_test::read_good(folder.path() / name);
    const std::string bytes = image_test::read_bytes(folder.path() / name);
    for (const bool isolated : {false, true}) {
      const auto read = ninebit::read_texture(span_of(bytes), "images[0]", {.isolated = isolated});
      ASSERT_TRUE(read) << read.error().text();
      ASSERT_EQ(read->format, file.format);
      for (int i = 0; i < 16 * 8; ++i) {
        for (std::size_t k = 0; k < 3; ++k)
          ASSERT_EQ(byte_at(*read, 0, 0, k, i % 16, i / 16), byte_at(file, 0, 0, k, i % 16, i / 16));
      }
    }
  }
}

TEST(EmbeddedPictures, FaultsNameThem) {
  const TempFolder folder;
  ninebit::test::write_as(folder.path() / "a.png", picture(16, 8));
  const std::string good = image_test::read_bytes(folder.path() / "a.png");
  for (const std::string& bytes : {std::string(), std::string("hello"), good.substr(0, 40), good.substr(0, 8)}) {
    const auto read = ninebit::read_texture(span_of(bytes), "images[0]", {.isolated = true});
    ASSERT_FALSE(read) << bytes.size();
    EXPECT_EQ(read.error().file, "images[0]");
    EXPECT_FALSE(read.error().message.empty());
  }
}

// The documented rule, in doubles where it is exact, sample by sample.
int resampled(const ninebit::Image8& image, int c, int x, int y, int width, int height) {
  const auto tap = [](int i, int source, int target, int& first, int& second, int& weight) {
    const double at = (2.0 * i + 1.0) * source / (2.0 * target) - 0.5;
    const int fixed = std::clamp(static_cast<int>(std::floor(at * 256.0 + 0.5)), 0, (source - 1) * 256);
    first = fixed / 256;
    second = std::min(first + 1, source - 1);
    weight = fixed % 256;
  };
  int x0 = 0, x1 = 0, u = 0, y0 = 0, y1 = 0, v = 0;
  tap(x, image.width, width, x0, x1, u);
  tap(y, image.height, height, y0, y1, v);
  const auto sample = [&](int column, int row) {
    return int{image.pixels[static_cast<std::size_t>((row * image.width + column) * 3 + c)]};
  };
  const int top = (sample(x0, y0) * (256 - u) + sample(x1, y0) * u + 128) / 256;
  const int bottom = (sample(x0, y1) * (256 - u) + sample(x1, y1) * u + 128) / 256;
  return (top * (256 - v) + bottom * v + 128) / 256;
}

TEST(AnySize, SidesGrowToPowersOfTwo) {
  const TempFolder folder;
  for (const auto& [width, height, wide, high] :
       {std::array{12, 5, 16, 8}, std::array{1, 3, 1, 4}, std::array{33, 16, 64, 16}}) {
    const ninebit::Image8 image = picture(width, height);
    ninebit::test::write_as(folder.path() / "a.png", image);
    EXPECT_NE(image_test::complaint(folder.path() / "a.png").find("power of two"), std::string::npos);
    int told_width = 0, told_height = 0;
    TextureReadOptions options{.any_size = true};
    options.on_resample = [&](int w, int h) {
      told_width = w;
      told_height = h;
    };
    const Texture texture = image_test::read_good(folder.path() / "a.png", geforce2, options);
    EXPECT_EQ(told_width, width);
    EXPECT_EQ(told_height, height);
    ASSERT_EQ(texture.faces[0][0].width, wide);
    ASSERT_EQ(texture.faces[0][0].height, high);
    for (int y = 0; y < high; ++y) {
      for (int x = 0; x < wide; ++x) {
        for (int c = 0; c < 3; ++c)
          ASSERT_EQ(byte_at(texture, 0, 0, static_cast<std::size_t>(c), x, y), resampled(image, c, x, y, wide, high));
      }
    }
  }
}

}  // namespace

// Planes of every kind of sample, as memory holds them, through PNG and EXR and back.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "combiner_tests/image/read_back.h"
#include "ninebit/image/image_io.h"

namespace {

using image_test::read_exr;
using image_test::scramble;
using image_test::StoredChannel;
using image_test::TempFolder;
using ninebit::Half;
using ninebit::PicturePlane;

constexpr int kWidth = 37, kHeight = 29, kStride = 40;  // with padding after each row

template <class Sample>
std::vector<Sample> plane_of(std::uint32_t seed) {
  std::vector<Sample> plane(static_cast<std::size_t>(kStride * kHeight));
  for (std::size_t i = 0; i < plane.size(); ++i) {
    plane[i] = static_cast<Sample>(scramble(static_cast<std::uint32_t>(i) + seed));
  }
  return plane;
}

// The samples without the padding, the picture's top row first.
template <class To, class Sample>
std::vector<To> upright(const std::vector<Sample>& plane, bool lowest_first) {
  std::vector<To> samples;
  for (int row = 0; row < kHeight; ++row) {
    const int from = (lowest_first ? kHeight - 1 - row : row) * kStride;
    for (int x = 0; x < kWidth; ++x) samples.push_back(static_cast<To>(plane[static_cast<std::size_t>(from + x)]));
  }
  return samples;
}

StoredChannel through_exr(const PicturePlane& plane, int width = kWidth, int height = kHeight) {
  const TempFolder folder;
  const std::vector<ninebit::ExrPart> parts = {{"p", width, height, {ninebit::exr_channel("v", plane)}}};
  const auto status = ninebit::write_exr_parts(folder.path() / "a.exr", parts);
  EXPECT_TRUE(status.ok()) << status.error().text();
  return read_exr(folder.path() / "a.exr").at(0).channels.at("v");
}

template <class Sample>
void expect_exact_integers() {
  const std::vector<Sample> plane = plane_of<Sample>(3);
  EXPECT_EQ(through_exr({plane.data(), kStride}).integers, upright<std::uint32_t>(plane, false));
  EXPECT_EQ(through_exr(ninebit::upside_down(plane.data(), kStride, kHeight)).integers,
            upright<std::uint32_t>(plane, true));
}

TEST(Planes, IntegersGoExactlyIntoExr) {
  expect_exact_integers<std::uint8_t>();
  expect_exact_integers<std::uint16_t>();
  expect_exact_integers<std::uint32_t>();
}

TEST(Planes, FloatsGoExactlyIntoExr) {
  std::vector<float> plane = plane_of<float>(4);
  for (std::size_t i = 0; i < plane.size(); ++i) plane[i] = std::ldexp(plane[i], static_cast<int>(i % 200) - 150);
  plane[0] = std::numeric_limits<float>::infinity();
  plane[1] = std::numeric_limits<float>::denorm_min();
  plane[2] = -std::numeric_limits<float>::max();
  plane[3] = 0.1F;
  EXPECT_EQ(through_exr({plane.data(), kStride}).floats, upright<float>(plane, false));
  EXPECT_EQ(through_exr(ninebit::upside_down(plane.data(), kStride, kHeight)).floats, upright<float>(plane, true));
}

TEST(Planes, RegisterCodesGoExactlyIntoExr) {
  std::vector<ninebit::s9> codes;
  for (int code = -256; code < 256; ++code) codes.push_back(static_cast<ninebit::s9>(code));
  const std::vector<float> stored = through_exr({codes.data(), 32}, 32, 16).reals;
  EXPECT_EQ(stored, std::vector<float>(codes.begin(), codes.end()));
}

// Every half, by OpenEXR's own reader; of NaNs only that they are.
TEST(Planes, EveryHalfGoesExactlyIntoExr) {
  std::vector<Half> halves;
  for (unsigned bits = 0; bits < 0x10000; ++bits) halves.push_back({static_cast<std::uint16_t>(bits)});
  const std::vector<float> stored = through_exr({halves.data(), 256}, 256, 256).reals;
  ASSERT_EQ(stored.size(), halves.size());
  for (std::size_t i = 0; i < stored.size(); ++i) {
    const float expected = ninebit::float_of(halves[i]);
    if (std::isnan(expected)) {
      ASSERT_TRUE(std::isnan(stored[i])) << i;
    } else {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(stored[i]), std::bit_cast<std::uint32_t>(expected)) << i;
    }
  }
}

// The interleaved picture of planes.
template <class Sample>
std::vector<Sample> interleaved(const std::vector<std::vector<Sample>>& planes, bool lowest_first) {
  std::vector<Sample> pixels;
  std::vector<std::vector<Sample>> rows;
  for (const auto& plane : planes) rows.push_back(upright<Sample>(plane, lowest_first));
  for (std::size_t i = 0; i < rows[0].size(); ++i) {
    for (const auto& row : rows) pixels.push_back(row[i]);
  }
  return pixels;
}

template <class Sample, class Read>
void expect_exact_png(Read read) {
  const TempFolder folder;
  for (const int channels : {1, 3, 4}) {
    for (const bool lowest_first : {false, true}) {
      std::vector<std::vector<Sample>> memory;
      std::vector<PicturePlane> planes;
      for (int c = 0; c < channels; ++c) memory.push_back(plane_of<Sample>(static_cast<std::uint32_t>(1000 * c)));
      for (const auto& plane : memory) {
        planes.push_back(lowest_first ? ninebit::upside_down(plane.data(), kStride, kHeight)
                                      : PicturePlane{plane.data(), kStride});
      }
      const auto status = ninebit::write_png(folder.path() / "a.png", kWidth, kHeight, planes);
      ASSERT_TRUE(status.ok()) << status.error().text();
      const ninebit::Image<Sample> image = read(folder.path() / "a.png");
      EXPECT_EQ(image.width, kWidth);
      EXPECT_EQ(image.height, kHeight);
      EXPECT_EQ(image.channels, channels);
      EXPECT_EQ(image.pixels, interleaved(memory, lowest_first));
    }
  }
}

TEST(Planes, BytesGoExactlyIntoPng) {
  expect_exact_png<std::uint8_t>(image_test::read_png);
}
TEST(Planes, SixteenBitsGoExactlyIntoPng) {
  expect_exact_png<std::uint16_t>(image_test::read_png16);
}

TEST(Planes, SenselessOnesAreReported) {
  const TempFolder folder;
  const std::vector<std::uint8_t> bytes(4);
  const std::vector<std::uint16_t> words(4);
  const std::vector<float> floats(4);
  const PicturePlane byte{bytes.data(), 2}, word{words.data(), 2}, real{floats.data(), 2};
  const PicturePlane none{static_cast<const std::uint8_t*>(nullptr), 2};
  const auto refused = [&](int width, const std::vector<PicturePlane>& planes) {
    const auto status = ninebit::write_png(folder.path() / "a.png", width, 2, planes);
    EXPECT_FALSE(status.ok());
    return status.ok() ? std::string() : status.error().message;
  };
  EXPECT_EQ(refused(2, {}), "the picture has 0 planes; 1, 3 or 4 can be written");
  EXPECT_EQ(refused(2, {byte, byte}), "the picture has 2 planes; 1, 3 or 4 can be written");
  EXPECT_EQ(refused(2, {byte, byte, word}), "plane 2 has other samples than plane 0");
  EXPECT_EQ(refused(2, {none}), "plane 0 has no samples");
  EXPECT_EQ(refused(2, {real}), "PNG holds 8-bit and 16-bit planes only");
  EXPECT_EQ(refused(0, {byte}), "the picture is 0 x 2 in size; each side must be 1 to 16384");
  const std::vector<ninebit::ExrPart> parts = {{"p", 2, 2, {ninebit::exr_channel("v", none)}}};
  EXPECT_EQ(ninebit::write_exr_parts(folder.path() / "a.exr", parts).error().message,
            "part p has no function for the rows of channel v");
  EXPECT_TRUE(folder.names().empty());
}

}  // namespace

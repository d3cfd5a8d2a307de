#include "ninebit/frame/index_codes.h"

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/initial_registers.h"

namespace {

using namespace ninebit;

constexpr std::array kFormats{IndexFormat::rgb, IndexFormat::luminance_alpha, IndexFormat::luminance,
                              IndexFormat::alpha};

// As a register reads the texel that holds this colour: what the format's texture does not store is gone.
ColorBytes through_the_texture(const ColorBytes& color, IndexFormat format) {
  Texel texel{.value = color, .format = base_format(map_format(format))};
  for (std::size_t c = 0; c < 4; ++c) {
    if (!stored_components(map_format(format))[c]) texel.value[c] = 77;
  }
  const Rgba9 codes = texel_codes(profiles::geforce2, texel);
  ColorBytes read;
  for (std::size_t c = 0; c < 4; ++c) read[c] = static_cast<std::uint8_t>(codes[c]);
  return read;
}

TEST(IndexCodes, CapacityIsTheNumberOfLevelsToThePowerOfTheChannels) {
  EXPECT_EQ(IndexCodes(2, IndexFormat::luminance_alpha).capacity(), 1U << 14);
  EXPECT_EQ(IndexCodes(2, IndexFormat::luminance).capacity(), 1U << 7);
  EXPECT_EQ(IndexCodes(2, IndexFormat::alpha).capacity(), 1U << 7);
  EXPECT_EQ(IndexCodes(3, IndexFormat::luminance_alpha).capacity(), 86U * 86U);
  EXPECT_EQ(IndexCodes(1, IndexFormat::alpha).capacity(), 256U);

  EXPECT_EQ(IndexCodes(1).capacity(), 1U << 24);
  EXPECT_EQ(IndexCodes(2).capacity(), 1U << 21);  // the article's seven bits a channel
  EXPECT_EQ(IndexCodes(3).capacity(), 86U * 86U * 86U);
  EXPECT_EQ(IndexCodes(4).capacity(), 64U * 64U * 64U);
  EXPECT_EQ(IndexCodes(16).capacity(), 16U * 16U * 16U);
}

TEST(IndexCodes, RedCountsFastestAndZeroIsTheClearedMap) {
  const IndexCodes codes(2);
  EXPECT_EQ(codes.color(0), (ColorBytes{0, 0, 0, 255}));
  EXPECT_EQ(codes.color(1), (ColorBytes{2, 0, 0, 255}));
  EXPECT_EQ(codes.color(127), (ColorBytes{254, 0, 0, 255}));
  EXPECT_EQ(codes.color(128), (ColorBytes{0, 2, 0, 255}));
  EXPECT_EQ(codes.color(128 * 128), (ColorBytes{0, 0, 2, 255}));
  EXPECT_EQ(codes.color(codes.capacity() - 1), (ColorBytes{254, 254, 254, 255}));
}

TEST(IndexCodes, LuminanceCountsFasterThanAlpha) {
  const IndexCodes codes(2, IndexFormat::luminance_alpha);
  EXPECT_EQ(codes.color(0), (ColorBytes{0, 0, 0, 0}));
  EXPECT_EQ(codes.color(127), (ColorBytes{254, 254, 254, 0}));
  EXPECT_EQ(codes.color(128), (ColorBytes{0, 0, 0, 2}));
  EXPECT_EQ(codes.color(128 * 128 - 1), (ColorBytes{254, 254, 254, 254}));
  EXPECT_EQ(IndexCodes(2, IndexFormat::luminance).color(5), (ColorBytes{10, 10, 10, 255}));
  EXPECT_EQ(IndexCodes(2, IndexFormat::alpha).color(5), (ColorBytes{0, 0, 0, 10}));
}

// The primary colour is what a texel of the map puts into its register, so that equal indices have no difference.
TEST(IndexCodes, EveryCodeIsItsOwnMultipleOfTheStep) {
  for (const IndexFormat format : kFormats) {
    for (int step = 1; step <= kMaxIndexStep; ++step) {
      const IndexCodes codes(step, format);
      // All codes of the larger steps; of the smaller ones every 97th, which meets every digit.
      const std::uint32_t stride = step >= 4 || format != IndexFormat::rgb ? 1 : 97;
      for (std::uint32_t n = 0; n < codes.capacity(); n += stride) {
        const ColorBytes c = codes.color(n);
        const auto stored = stored_components(map_format(format));
        for (std::size_t i = 0; i < 4; ++i) ASSERT_TRUE(!stored[i] || c[i] % step == 0) << step << ' ' << n;
        ASSERT_EQ(codes.number(c), n) << "step " << step;
        ASSERT_EQ(through_the_texture(c, format), c) << "step " << step;
      }
    }
  }
}

void expect_parts(const Status& status, const std::vector<std::string>& parts) {
  ASSERT_FALSE(status.ok());
  for (const std::string& part : parts) {
    EXPECT_NE(status.error().message.find(part), std::string::npos)
        << "'" << part << "' is missing in: " << status.error().message;
  }
}

TEST(IndexCodes, TooManyPolygonsNameCountsAndRemedies) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  using enum IndexFormat;
  using enum IndexScope;
  EXPECT_TRUE(check_index_codes(rgb, 16, polygon, {4095, 0, 3}).ok());
  expect_parts(check_index_codes(rgb, 16, polygon, {4096, 0, 3}),
               {"too many polygons", "4096 of them", "4097 codes", "index format rgb with step 16 has 4096",
                "index step 15 would do (5832 codes)", ", or index scope object (3 objects)"});
  EXPECT_EQ(check_index_codes(rgb, 1, polygon, {1U << 24, 0, 1U << 25}).error().message.find("index scope"),
            std::string::npos);
  expect_parts(check_index_codes(rgb, 1, object, {1U << 24, 0, 1U << 24}), {"no other step, format or scope alone"});
  EXPECT_FALSE(check_index_codes(rgb, 0, polygon, {1, 1, 1}).ok());
  EXPECT_FALSE(check_index_codes(rgb, 17, polygon, {1, 1, 1}).ok());
}

TEST(IndexCodes, ASmallFormatNamesTheNextThatWouldDo) {
  using enum IndexFormat;
  using enum IndexScope;
  EXPECT_TRUE(check_index_codes(luminance, 2, polygon, {127, 0, 9}).ok());
  expect_parts(check_index_codes(luminance, 2, polygon, {128, 20, 9}),
               {"index format l with step 2 has 128", "index step 1 would do (256 codes)",
                ", or index format la (16384 codes)", ", or index scope section (at most 20 sections)"});
  expect_parts(check_index_codes(alpha, 2, polygon, {20'000, 128, 127}),
               {"index format a", "index format rgb would do (2097152 codes)", "index scope object (127 objects)"});
  expect_parts(check_index_codes(luminance_alpha, 4, section, {1U << 20, 4096, 4095}),
               {"too many sections: 4096 of them", "index step 3 would do (7396 codes)", "index scope object (4095"});
  expect_parts(check_index_codes(alpha, 4, object, {1U << 20, 4096, 64}), {"too many objects", "index step 3"});
}

}  // namespace

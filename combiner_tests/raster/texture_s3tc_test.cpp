// S3TC blocks against the specification's real numbers, rounded as s3tc.h says.
#include <gtest/gtest.h>

#include <cmath>

#include "combiner_tests/hardware/csv.h"
#include "combiner_tests/raster/support.h"
#include "ninebit/raster/s3tc.h"

namespace ninebit::test {
namespace {

using Block = std::array<std::uint8_t, 16>;

// A component of `bits` bits as a byte whose lower bits repeat the upper ones.
int widened(int value, int bits) {
  int byte = 0;
  for (int bit = 0; bit < 8; ++bit) {
    if ((value >> (bits - 1 - bit % bits)) & 1) byte |= 128 >> bit;
  }
  return byte;
}

int rounded(double value) {
  return static_cast<int>(std::floor(value + 0.5));
}

struct Expected {
  int value[4];
};

// One texel of a colour block: shares nothing with the decoder but the specification.
Expected expected_color(unsigned c0, unsigned c1, int code, bool dxt1, bool narrow) {
  const bool four = !dxt1 || c0 > c1;
  Expected e{{0, 0, 0, 255}};
  if (!four && code == 3) {
    e.value[3] = 0;
    return e;
  }
  for (int k = 0; k < 3; ++k) {
    const int bits = k == 1 ? 6 : 5, shift = k == 0 ? 11 : k == 1 ? 5 : 0;
    const auto part = [&](unsigned color) { return static_cast<int>((color >> shift) & ((1U << bits) - 1)); };
    int a = part(c0), b = part(c1);
    if (!narrow) {
      a = widened(a, bits);
      b = widened(b, bits);
    }
    double mixed = code == 0 ? a : b;
    if (code >= 2) mixed = four ? ((4 - code) * a + (code - 1) * b) / 3.0 : (a + b) / 2.0;
    e.value[k] = narrow ? widened(rounded(mixed), bits) : rounded(mixed);
  }
  return e;
}

int expected_alpha5(int a0, int a1, int code) {
  if (code == 0) return a0;
  if (code == 1) return a1;
  if (a0 > a1) return rounded(((8 - code) * a0 + (code - 1) * a1) / 7.0);
  if (code == 6) return 0;
  if (code == 7) return 255;
  return rounded(((6 - code) * a0 + (code - 1) * a1) / 5.0);
}

void put(Block& block, std::size_t at, std::uint64_t value, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; ++i) block[at + i] = static_cast<std::uint8_t>(value >> (8 * i));
}

constexpr std::uint64_t kEachCode = 0xE4E4E4E4;  // 0, 1, 2, 3 in every row

// All pairs of a component's values, in both orders of the whole colours.
TEST(S3tc, EveryPairOfComponents) {
  for (const auto& [bits, shift] : {std::pair{5, 11}, std::pair{6, 5}, std::pair{5, 0}}) {
    for (unsigned a = 0; a < (1U << bits); ++a) {
      for (unsigned b = 0; b < (1U << bits); ++b) {
        const unsigned c0 = (a << shift) | (shift == 11 ? 3U : 0x1000U),
                       c1 = (b << shift) | (shift == 11 ? 5U : 0x1000U);
        for (const S3tcFormat format :
             {S3tcFormat::dxt1_rgb, S3tcFormat::dxt1_rgba, S3tcFormat::dxt3, S3tcFormat::dxt5}) {
          const bool dxt1 = s3tc_block_bytes(format) == 8;
          for (const Dxt1Palette palette : {Dxt1Palette::rgb565, Dxt1Palette::rgb888}) {
            Block block{};
            const std::size_t colors = dxt1 ? 0 : 8;
            put(block, colors, c0, 2);
            put(block, colors + 2, c1, 2);
            put(block, colors + 4, kEachCode, 4);
            const auto texels = decode_s3tc_block(format, palette, block);
            for (int code = 0; code < 4; ++code) {
              const Expected e = expected_color(c0, c1, code, dxt1, dxt1 && palette == Dxt1Palette::rgb565);
              for (std::size_t k = 0; k < 3; ++k) {
                ASSERT_EQ(texels[static_cast<std::size_t>(code)][k], e.value[k]) << c0 << ' ' << c1 << ' ' << code;
              }
              if (format == S3tcFormat::dxt1_rgb) {
                ASSERT_EQ(texels[static_cast<std::size_t>(code)][3], 255);
              }
              if (format == S3tcFormat::dxt1_rgba) {
                ASSERT_EQ(texels[static_cast<std::size_t>(code)][3], e.value[3]);
              }
            }
          }
        }
      }
    }
  }
}

unsigned number(const HardwareRow& row, const std::string& column) {
  return static_cast<unsigned>(std::stoul(row.at(column), nullptr, 0));
}

// The texel of a row whose color block is at `colors`: index `index` at (x, y).
Bytes4 decoded(const HardwareRow& row, S3tcFormat format, Block block, unsigned x, unsigned y) {
  const std::size_t colors = s3tc_block_bytes(format) - 8;
  put(block, colors, number(row, "c0"), 2);
  put(block, colors + 2, number(row, "c1"), 2);
  put(block, colors + 4, std::uint64_t{number(row, "index")} << (2 * (4 * y + x)), 4);
  return decode_s3tc_block(format, profiles::nv2a.dxt1_palette, block)[4 * y + x];
}

TEST(S3tc, Dxt1IsDitheredAsOnTheNv2a) {
  std::size_t colors = 0, transparent = 0;
  for (const auto& row : read_hardware_table("nv2a_dxt1")) {
    ASSERT_EQ(row.at("match"), "1");
    const Bytes4 texel = decoded(row, S3tcFormat::dxt1_rgba, {}, number(row, "x_and_3"), number(row, "y_and_3"));
    ASSERT_EQ(texel[3], number(row, "hw_A"));
    if (row.at("hw_R").empty()) {  // alpha 0 hid the colour
      ++transparent;
      continue;
    }
    ASSERT_EQ((std::array<unsigned, 3>{texel[0], texel[1], texel[2]}),
              (std::array{number(row, "hw_R"), number(row, "hw_G"), number(row, "hw_B")}))
        << row.at("c0") << ' ' << row.at("c1") << ' ' << row.at("index") << ' ' << row.at("x_and_3") << ' '
        << row.at("y_and_3");
    ++colors;
  }
  EXPECT_GT(colors, 3000U);
  EXPECT_GT(transparent, 0U);
}

// The picture shows texels blended over 16, and alpha over 254: n / 255 to nearest.
void expect_blended(const HardwareRow& row, const Bytes4& texel) {
  const auto blended = [&](unsigned value, unsigned under) {
    return (2 * (texel[3] * value + (255U - texel[3]) * under) + 255) / 510;
  };
  EXPECT_EQ(blended(texel[0], 16), number(row, "hw_R"));
  EXPECT_EQ(blended(texel[1], 16), number(row, "hw_G"));
  EXPECT_EQ(blended(texel[2], 16), number(row, "hw_B"));
  EXPECT_EQ(blended(texel[3], 254), number(row, "hw_A"));
}

TEST(S3tc, Dxt3AndDxt5AreThoseOfTheNv2a) {
  for (const auto& row : read_hardware_table("nv2a_dxt3")) {
    Block block{};
    block[0] = static_cast<std::uint8_t>(number(row, "alpha4"));
    expect_blended(row, decoded(row, S3tcFormat::dxt3, block, 0, 0));
    if (HasFailure()) FAIL() << "DXT3 " << row.at("c0") << ' ' << row.at("c1");
  }
  for (const auto& row : read_hardware_table("nv2a_dxt5")) {
    Block block{};
    block[0] = static_cast<std::uint8_t>(number(row, "alpha0"));
    block[1] = static_cast<std::uint8_t>(number(row, "alpha1"));
    block[2] = static_cast<std::uint8_t>(number(row, "alpha_index"));
    expect_blended(row, decoded(row, S3tcFormat::dxt5, block, 0, 0));
    if (HasFailure()) FAIL() << "DXT5 " << row.at("c0") << ' ' << row.at("c1");
  }
}

TEST(S3tc, EveryPairOfAlphas) {
  std::uint64_t codes = 0;  // 0 to 7, twice
  for (int i = 0; i < 16; ++i) codes |= static_cast<std::uint64_t>(i % 8) << (3 * i);
  for (int a0 = 0; a0 < 256; ++a0) {
    for (int a1 = 0; a1 < 256; ++a1) {
      Block block{};
      block[0] = static_cast<std::uint8_t>(a0);
      block[1] = static_cast<std::uint8_t>(a1);
      put(block, 2, codes, 6);
      const auto texels = decode_s3tc_block(S3tcFormat::dxt5, Dxt1Palette::rgb888, block);
      for (int i = 0; i < 16; ++i) {
        ASSERT_EQ(texels[static_cast<std::size_t>(i)][3], expected_alpha5(a0, a1, i % 8))
            << a0 << ' ' << a1 << ' ' << i;
      }
    }
  }
  Block block{};
  put(block, 0, 0xFEDCBA9876543210, 8);
  const auto texels = decode_s3tc_block(S3tcFormat::dxt3, Dxt1Palette::rgb565, block);
  for (std::size_t i = 0; i < 16; ++i) EXPECT_EQ(texels[i][3], rounded(static_cast<double>(i) * 255 / 15));
}

// The famous banding: between two near colours the narrow palette has no room.
TEST(S3tc, TheNarrowPaletteHasFewerSteps) {
  Block block{};
  put(block, 0, 0x0842, 2);  // 1, 2, 2
  put(block, 2, 0x0000, 2);
  put(block, 4, kEachCode, 4);
  const auto wide = decode_s3tc_block(S3tcFormat::dxt1_rgb, Dxt1Palette::rgb888, block);
  const auto narrow = decode_s3tc_block(S3tcFormat::dxt1_rgb, Dxt1Palette::rgb565, block);
  EXPECT_EQ(wide[2], (Bytes4{5, 5, 11, 255}));
  EXPECT_EQ(wide[3], (Bytes4{3, 3, 5, 255}));
  EXPECT_EQ(narrow[2], (Bytes4{8, 4, 8, 255}));
  EXPECT_EQ(narrow[3], (Bytes4{0, 4, 8, 255}));
}

TEST(S3tc, ImagesAreMadeOfBlocks) {
  Random random(91);
  for (const S3tcFormat format : {S3tcFormat::dxt1_rgb, S3tcFormat::dxt1_rgba, S3tcFormat::dxt3, S3tcFormat::dxt5}) {
    for (const auto& [width, height] : {std::pair{1, 1}, std::pair{2, 8}, std::pair{16, 4}, std::pair{7, 13}}) {
      const auto columns = static_cast<std::size_t>((width + 3) / 4), rows = static_cast<std::size_t>((height + 3) / 4);
      const std::size_t size = s3tc_block_bytes(format);
      ASSERT_EQ(s3tc_image_bytes(format, width, height), columns * rows * size);
      std::vector<std::uint8_t> data(columns * rows * size);
      for (std::uint8_t& byte : data) byte = random.byte();
      const auto image = decode_s3tc(format, Dxt1Palette::rgb565, width, height, data);
      ASSERT_TRUE(image.ok());
      const auto& samples = std::get<std::vector<std::uint8_t>>(image->samples);
      const std::size_t planes = format == S3tcFormat::dxt1_rgb ? 3 : 4;
      ASSERT_EQ(samples.size(), planes * static_cast<std::size_t>(width * height));
      for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
          const std::size_t block = static_cast<std::size_t>(y / 4) * columns + static_cast<std::size_t>(x / 4);
          const auto texels =
              decode_s3tc_block(format, Dxt1Palette::rgb565, std::span(data).subspan(block * size, size));
          for (std::size_t k = 0; k < planes; ++k) {
            ASSERT_EQ(samples[k * static_cast<std::size_t>(width * height) + static_cast<std::size_t>(y * width + x)],
                      texels[static_cast<std::size_t>(4 * (y % 4) + x % 4)][k]);
          }
        }
      }
      EXPECT_FALSE(
          decode_s3tc(format, Dxt1Palette::rgb565, width, height, std::span(data).first(data.size() - 1)).ok());
    }
  }
  EXPECT_FALSE(decode_s3tc(S3tcFormat::dxt3, Dxt1Palette::rgb888, 0, 4, {}).ok());
  EXPECT_FALSE(decode_s3tc(S3tcFormat::dxt3, Dxt1Palette::rgb888, 16385, 4, {}).ok());
}

}  // namespace
}  // namespace ninebit::test

#include <gtest/gtest.h>
#include <ninebit/raster/s3tc.h>

TEST(Examples, S3tc) {
  using namespace ninebit;
  // Red and black, and two bits for each texel: the first is red, the others are black.
  const std::array<std::uint8_t, 8> block{0x00, 0xF8, 0x00, 0x00, 0x54, 0x55, 0x55, 0x55};
  const auto texels = decode_s3tc_block(S3tcFormat::dxt1_rgb, Dxt1Palette::rgb565, block);
  EXPECT_EQ(texels[0], (Bytes4{255, 0, 0, 255}));
  EXPECT_EQ(texels[15], (Bytes4{0, 0, 0, 255}));
  EXPECT_EQ(s3tc_image_bytes(S3tcFormat::dxt5, 256, 256), 65536U);
}

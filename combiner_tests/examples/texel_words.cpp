#include <gtest/gtest.h>
#include <ninebit/raster/texel_words.h>

TEST(Examples, TexelWords) {
  using namespace ninebit;
  EXPECT_EQ(texel_of_word(TexelWord::r5g6b5, 0xF800), (Bytes4{255, 0, 0, 255}));
  EXPECT_EQ(texel_of_word(TexelWord::r16b16, 0x12345678), (Bytes4{0x34, 0x56, 0x78, 0x12}));
  EXPECT_EQ(texels_of_yuv_word(0x40302010, false)[1], (Bytes4{0x30, 0x20, 0x40, 255}));  // Y0 U Y1 V
}

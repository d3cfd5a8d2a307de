#include <gtest/gtest.h>
#include <ninebit/language/pixel_shader.h>

#include <string_view>

TEST(Examples, PixelShader) {
  using namespace ninebit;
  const std::string_view text =
      "ps.1.1\n"
      "tex t0\n"
      "mul_x2 r0, v0, t0\n";
  ASSERT_TRUE(is_pixel_shader(text));
  const auto state = parse_pixel_shader({text, "lit.psh"}, profiles::nv2a);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->general[0].rgb.out.scale, Scale::by_two);
}

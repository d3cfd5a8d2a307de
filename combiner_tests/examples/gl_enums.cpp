#include <gtest/gtest.h>
#include <ninebit/language/gl_enums.h>

TEST(Examples, GlEnums) {
  using namespace ninebit;
  EXPECT_EQ(gl::to_enum(Register::texture1), gl::GL_TEXTURE1_ARB);
  EXPECT_EQ(gl::to_scale(gl::GL_SCALE_BY_FOUR_NV), Scale::by_four);
  EXPECT_FALSE(gl::to_register(gl::GL_ONE).has_value());  // not a register
  EXPECT_EQ(gl::to_stage(gl::GL_COMBINER7_NV), 7);
}

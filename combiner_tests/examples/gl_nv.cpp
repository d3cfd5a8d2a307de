#include <gtest/gtest.h>
#include <ninebit/language/gl_nv.h>

TEST(Examples, GlNv) {
  using namespace ninebit::gl;
  Context context(ninebit::profiles::geforce2);
  const CurrentContext current(context);
  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 9);
  EXPECT_EQ(glGetError(), GL_INVALID_VALUE);  // a GeForce 2 has two
  EXPECT_EQ(context.state().general[0].rgb.b.reg, ninebit::Register::texture0);
}

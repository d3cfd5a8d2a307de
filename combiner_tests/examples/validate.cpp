#include <gtest/gtest.h>
#include <ninebit/combiner/validate.h>
#include <ninebit/numerics/hardware_profile.h>

TEST(Examples, Validate) {
  using namespace ninebit;
  CombinerState state;
  state.num_general_combiners = 3;
  state.general[0].alpha.out.ab_dot_product = true;
  const auto faults = validate(state, profiles::geforce2);
  ASSERT_EQ(faults.size(), 2U);
  EXPECT_EQ(name_of(faults[0].gl_error), "GL_INVALID_VALUE");  // a GeForce 2 has two general combiners
  EXPECT_EQ(faults[1].portion, PortionName::alpha);            // dot products are for RGB alone
}

#include <gtest/gtest.h>
#include <ninebit/combiner/state.h>

TEST(Examples, State) {
  using namespace ninebit;
  // spare0 = 2 · primary · texture 0; the rest keeps GL's defaults.
  CombinerState state;
  Portion& rgb = state.general[0].rgb;
  rgb.b = {Register::texture0, InputMapping::unsigned_identity, ComponentUsage::rgb};
  rgb.out.scale = Scale::by_two;

  EXPECT_EQ(rgb.a.reg, Register::primary);
  EXPECT_EQ(rgb.out.sum, Register::spare0);
  EXPECT_FALSE(state == CombinerState{});
}

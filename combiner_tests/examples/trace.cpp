#include <gtest/gtest.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/combiner/trace.h>

TEST(Examples, Trace) {
  using namespace ninebit;
  CombinerState half;
  half.general[0].rgb.out.scale = Scale::by_one_half;
  RegisterFile registers;
  registers[Register::primary] = {201, 99, 51, 255};
  registers[Register::fog][kAlpha] = 255;
  const Trace steps = trace(normalize(half, profiles::geforce2), profiles::geforce2, registers);
  const TracedOutput& red = *steps.stage[0].rgb.channel[kRed].third_output;
  EXPECT_EQ(red.written.code, 100);
  EXPECT_DOUBLE_EQ(red.dropped.real, 0.5 / 255);  // what narrowing took away
  EXPECT_EQ(steps.bytes[kRed], 100);
}

#include <gtest/gtest.h>
#include <ninebit/combiner/evaluate_real.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/numerics/hardware_profile.h>

TEST(Examples, EvaluateReal) {
  using namespace ninebit;
  CombinerState half;
  half.general[0].rgb.out.scale = Scale::by_one_half;
  const Program program = normalize(half, profiles::geforce2);
  RegisterFile registers;
  registers[Register::primary] = {201, 99, 51, 255};
  registers[Register::fog][kAlpha] = 255;
  EXPECT_DOUBLE_EQ(evaluate_real(program, registers).color[kRed], 100.5 / 255);
  EXPECT_EQ(evaluate(program, registers)[kRed], 100);
}

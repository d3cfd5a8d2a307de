#include <gtest/gtest.h>
#include <ninebit/combiner/evaluate.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/numerics/hardware_profile.h>

TEST(Examples, Evaluate) {
  using namespace ninebit;
  constexpr Program program = normalize(CombinerState{}, profiles::geforce2);
  RegisterFile registers;
  registers[Register::primary] = {201, 99, 51, 255};
  registers[Register::secondary] = {100, 0, 0, 0};
  registers[Register::fog][kAlpha] = 255;                              // no fog
  EXPECT_EQ(evaluate(program, registers), (Rgba9{255, 99, 51, 255}));  // the colour sum clamps 301
}

#include <gtest/gtest.h>
#include <ninebit/combiner/evaluate.h>
#include <ninebit/shadow/index_cube.h>

TEST(Examples, IndexCube) {
  using namespace ninebit;
  const Result<CombinerState> state = index_comparison_state(profiles::geforce2);
  const Result<Program> program = compile(*state, profiles::geforce2);
  ASSERT_TRUE(program.ok());
  RegisterFile registers;
  registers[Register::primary] = {100, 8, 0, 255};      // the polygon's index
  registers[Register::texture0] = {102, 8, 0, 255};     // that of the polygon which the light sees
  EXPECT_GT(evaluate(*program, registers)[kAlpha], 0);  // shadow
  registers[Register::texture0] = registers[Register::primary];
  EXPECT_EQ(evaluate(*program, registers)[kAlpha], 0);  // light
}

#include <gtest/gtest.h>
#include <ninebit/combiner/program.h>
#include <ninebit/numerics/hardware_profile.h>

TEST(Examples, Program) {
  using namespace ninebit;
  CombinerState state;  // GL's defaults: the primary colour, then colour sum and fog
  const Result<Program> program = compile(state, profiles::geforce2);
  ASSERT_TRUE(program.ok());
  EXPECT_EQ(program->num_general_combiners, 1);

  state.num_general_combiners = 9;
  EXPECT_FALSE(compile(state, profiles::geforce2).ok());
}

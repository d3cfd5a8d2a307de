#include <gtest/gtest.h>
#include <ninebit/combiner/normalize.h>

TEST(Examples, Normalize) {
  using namespace ninebit;
  // A valid state becomes a program while the compiler runs.
  constexpr Program program = normalize(CombinerState{}, profiles::geforce2);
  static_assert(program.num_general_combiners == 1);
  EXPECT_EQ(program, *compile(CombinerState{}, profiles::geforce2));
}

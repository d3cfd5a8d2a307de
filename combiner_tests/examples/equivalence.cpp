#include <gtest/gtest.h>
#include <ninebit/numerics/fixed9.h>
#include <ninebit/study/equivalence.h>

TEST(Examples, Equivalence) {
  using namespace ninebit;
  CombinerState doubled;
  doubled.general[0].rgb.out.scale = Scale::by_two;
  const ProofSubject a{.state = {}, .profile = profiles::geforce2};
  const ProofSubject b{.state = doubled, .profile = profiles::geforce2};
  const Result<EquivalenceAnswer> answer =
      prove_equivalent(a, b, {.targets = {{.reg = Register::spare0, .component = kRed}}});
  ASSERT_TRUE(answer.ok());
  EXPECT_EQ(answer->answer, ProofAnswer::refuted);
  EXPECT_EQ(answer->method, ProofMethod::exhaustive);
  EXPECT_NE(answer->counterexample->a, answer->counterexample->b);
}

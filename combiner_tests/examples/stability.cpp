#include <gtest/gtest.h>
#include <ninebit/study/stability.h>

TEST(Examples, Stability) {
  using namespace ninebit;
  CombinerState half;
  half.general[0].rgb.out.scale = Scale::by_one_half;
  const Result<StabilityAnswer> answer = prove_stable(half, profiles::nv2a);
  ASSERT_TRUE(answer.ok()) << answer.error().text();
  EXPECT_EQ(answer->answer, ProofAnswer::refuted);
  for (const FieldEffect& effect : answer->fields) {
    EXPECT_EQ(effect.answer == ProofAnswer::refuted, effect.field.name == "general_narrowing");
  }
}

#include <gtest/gtest.h>
#include <ninebit/study/stage_vectors.h>

#include <string>

TEST(Examples, StageVectors) {
  using namespace ninebit;
  Result<StageVectorPack> pack =
      make_stage_vector_pack(profiles::nv2a, {.programs = least_stage_vector_programs(), .fragments = 1});
  ASSERT_TRUE(pack.ok());
  const std::string text = print_stage_vector_pack(*pack);
  StageVectorResults results;
  results.programs[0].outputs = {StageOutput{}};  // of an emulator
  const Result<VectorVerdict> verdict = judge_stage_vectors(*pack, results, 10);
  EXPECT_EQ(verdict->fragments, 1U);
  EXPECT_EQ(verdict->differ, 1U);
}

#include <gtest/gtest.h>
#include <ninebit/study/vectors.h>

#include <string>

TEST(Examples, Vectors) {
  using namespace ninebit;
  const HardwareProfile& chip = profiles::nv2a;
  Result<VectorPack> pack = make_vector_pack(chip, {.programs = least_vector_programs(chip), .fragments = 2});
  ASSERT_TRUE(pack.ok());
  const std::string text = print_vector_pack(*pack);
  VectorResults results;
  results.id = pack->id;
  results.programs[0].colors = {Bytes4{1, 2, 3, 4}, Bytes4{1, 2, 3, 4}};  // of an emulator
  const Result<VectorVerdict> verdict = judge_vectors(*pack, results, 10);
  EXPECT_EQ(verdict->fragments, 2U);
  EXPECT_EQ(verdict->differ, 2U);
}

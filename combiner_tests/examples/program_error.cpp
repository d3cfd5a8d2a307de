#include <gtest/gtest.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/numerics/hardware_profile.h>
#include <ninebit/study/program_error.h>

TEST(Examples, ProgramError) {
  using namespace ninebit;
  CombinerState half;
  half.general[0].rgb.out.scale = Scale::by_one_half;
  const Program program = normalize(half, profiles::geforce2);
  const ProgramInputs inputs{.components = {{Register::primary, kRed}}};  // all of its values
  const StudyQuestion question{.study = "datapath", .profile = "geforce2"};
  const auto study = program_error_study(question, profiles::geforce2, program, inputs);
  ASSERT_TRUE(study.ok());
  const auto rows = (*study)->run(0, {});
  ASSERT_TRUE(rows.ok());
  EXPECT_EQ(rows->front().count("exact"), 128U);  // the even ones
}

#include <gtest/gtest.h>
#include <ninebit/numerics/hardware_profile.h>
#include <ninebit/study/datapath_error.h>

TEST(Examples, DatapathError) {
  using namespace ninebit;
  EXPECT_EQ(kOutputForms[2].name, "x4");
  const StudyQuestion question{.study = "datapath", .profile = "geforce2"};
  const auto study = datapath_study(question, {&profiles::geforce2, 1});
  ASSERT_TRUE(study.ok());
  const auto rows = (*study)->run(0, {});
  ASSERT_TRUE(rows.ok());
  EXPECT_EQ(rows->front().text("operation"), "mapping");
  EXPECT_EQ(rows->front().count("cases"), 511U);
}

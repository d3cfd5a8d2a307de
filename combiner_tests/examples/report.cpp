#include <gtest/gtest.h>
#include <ninebit/study/report.h>

TEST(Examples, Report) {
  using namespace ninebit;
  const StudyRow row{.fields = {{"step", std::uint64_t{2}}, {"false_matches", std::uint64_t{0}}, {"share", 0.25}}};
  EXPECT_EQ(row.count("step"), 2U);
  EXPECT_EQ(row.number("share"), 0.25);
  EXPECT_EQ(row.text("profile"), "");  // there is none

  StudyReport report{.title = "Index steps", .answers = {"Step 2 has no false match."}};
  report.plots.push_back({.file = "matches",
                          .title = "False matches",
                          .x_label = "step",
                          .y_label = "matches",
                          .series = {{"rgb", {{1, 12}, {2, 0}}}}});
  EXPECT_EQ(report.plots[0].series[0].points.size(), 2U);
}

#include <gtest/gtest.h>
#include <ninebit/study/depth_packing_error.h>
#include <ninebit/study/study.h>

#include <vector>

TEST(Examples, Study) {
  using namespace ninebit;
  const auto study = make_depth_packing_study(
      {.packings = {"rgba8-mod"}, .storages = {ChannelStorage::round}, .sets = {DepthSet::bits16}});
  ASSERT_TRUE(study.ok());
  const Study& depths = **study;
  std::vector<StudyRow> rows;
  for (std::size_t unit = 0; unit < depths.units(); ++unit) {
    const auto more = depths.run(unit, {});
    rows.insert(rows.end(), more->begin(), more->end());
  }
  const Result<StudyReport> report = depths.report(rows, depths.units());
  EXPECT_EQ(report->title, "Depth packing");
  EXPECT_EQ(depths.question().command().substr(0, 27), "ninebit study depth-packing");
}

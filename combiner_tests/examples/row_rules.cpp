#include <gtest/gtest.h>
#include <ninebit/study/row_rules.h>

#include <vector>

TEST(Examples, RowRules) {
  using namespace ninebit;
  const std::vector<RowRule> rules{{.fields = {exactly("packing", "rgba8-mod"), count_up_to("exact", 65536)}}};
  const std::vector<StudyRow> right{{.fields = {{"packing", "rgba8-mod"}, {"exact", std::uint64_t{7}}}}};
  EXPECT_EQ(wrong_with_rows(rules, right), "");
  const std::vector<StudyRow> wrong{{.fields = {{"packing", "x"}, {"exact", std::uint64_t{7}}}}};
  EXPECT_EQ(wrong_with_rows(rules, wrong), "row 1: packing is 'x'; expected 'rgba8-mod'");
}

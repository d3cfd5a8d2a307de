#include <gtest/gtest.h>
#include <ninebit/study/index_steps.h>

TEST(Examples, IndexSteps) {
  using namespace ninebit;
  const HardwareProfile& chip = profiles::geforce2;
  const IndexVariant& article = index_variants()[0];
  const Result<CombinerState> state = index_variant_state(chip, StudyFormat::channel, article);
  const Result<Program> program = compile(*state, chip);
  ASSERT_TRUE(program.ok());
  const Result<FalseMatches> one = count_false_matches(*program, chip, StudyFormat::channel, 1);
  const Result<FalseMatches> two = count_false_matches(*program, chip, StudyFormat::channel, 2);
  EXPECT_EQ(one->false_matches, 510U);  // of 256 · 255 pairs
  EXPECT_EQ(two->false_matches, 0U);
}

#include <gtest/gtest.h>
#include <ninebit/language/profile_json.h>

TEST(Examples, ProfileJson) {
  using namespace ninebit;
  const SourceText file{R"({"base": "geforce2", "name": "mine", "half": 127})", "mine.json"};
  const Parsed<OwnedProfile> mine = parse_json_profile(file);
  ASSERT_TRUE(mine);
  EXPECT_EQ(mine->profile.half.value, 127);
  EXPECT_EQ(mine->profile.half.evidence, Evidence::assumed);
}

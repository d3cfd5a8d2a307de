#include <gtest/gtest.h>
#include <ninebit/effect/effect_json.h>

TEST(Examples, EffectJson) {
  using namespace ninebit;
  const Parsed<Effect> effect = read_effect("scenes/effects/sepia.json");
  ASSERT_TRUE(effect);
  EXPECT_EQ(effect->passes[0].program, "programs/sepia.rc1");

  const Parsed<Effect> wrong = parse_effect({R"({"ninebit": "effect", "version": 1, "size": [0, 0]})", "small.json"});
  EXPECT_FALSE(wrong);
  EXPECT_EQ(wrong.faults()[0].line, 1);
}

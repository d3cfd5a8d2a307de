#include <gtest/gtest.h>
#include <ninebit/frame/technique_settings.h>

TEST(Examples, TechniqueSettings) {
  using namespace ninebit;
  const TechniqueSetting* step = find_technique_setting("index-step");
  ASSERT_NE(step, nullptr);
  RenderSettings settings;
  step->set(settings, *step->value_of("3"));
  EXPECT_EQ(settings.index.step, 3);
  EXPECT_FALSE(step->value_of("17"));
  EXPECT_TRUE(is_read(*step, "index-cube", settings));
  EXPECT_FALSE(is_read(*step, "shadow-map", settings));
}

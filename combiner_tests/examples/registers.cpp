#include <gtest/gtest.h>
#include <ninebit/combiner/registers.h>

TEST(Examples, Registers) {
  using namespace ninebit;
  EXPECT_EQ(texture_register(1), Register::texture1);
  EXPECT_EQ(texture_unit_of(Register::texture1), 1);
  EXPECT_EQ(short_name(Register::texture1), "tex1");
  EXPECT_EQ(name_of(Scale::by_two), "scale_by_two");
  EXPECT_EQ(name_of(kInputMappings[2]), "expand_normal");
}

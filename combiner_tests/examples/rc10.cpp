#include <gtest/gtest.h>
#include <ninebit/language/rc10.h>

#include <string>
#include <string_view>

TEST(Examples, Rc10) {
  using namespace ninebit;
  const std::string_view text =
      "!!RC1.0\n"
      "{ rgb { spare0 = tex0 . const0; } }\n"
      "out.rgb = spare0;\n";
  const auto state = parse_rc10({text, "dot.rc1"}, profiles::geforce2);
  ASSERT_TRUE(state);
  EXPECT_TRUE(state->general[0].rgb.out.ab_dot_product);
  const Result<std::string> printed = print_rc10(*state, profiles::geforce2);
  EXPECT_EQ(printed->substr(0, 7), "!!RC1.0");
}

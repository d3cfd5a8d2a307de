#include <gtest/gtest.h>
#include <ninebit/language/gl_calls.h>

#include <string>
#include <string_view>

TEST(Examples, GlCalls) {
  using namespace ninebit;
  const std::string_view text =
      "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);\n"
      "glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE1, GL_EXPAND_NORMAL_NV, GL_RGB);\n";
  const auto state = parse_gl_calls({text, "setup.txt"}, profiles::geforce2);
  ASSERT_TRUE(state);
  EXPECT_EQ(state->general[1].rgb.b.mapping, InputMapping::expand_normal);
  const Result<std::string> calls = print_gl_calls(*state, profiles::geforce2);
  EXPECT_EQ(*parse_gl_calls({*calls, "printed"}, profiles::geforce2), *state);
}

#include <gtest/gtest.h>
#include <ninebit/language/program_text.h>

#include <string_view>

TEST(Examples, ProgramText) {
  using namespace ninebit;
  const std::string_view text =
      "!!RC1.0\n"
      "{ rgb { spare0 = col0 * tex0; scale_by_two(); } }\n"
      "out.rgb = spare0;\n"
      "out.a = unsigned_invert(zero);\n";
  EXPECT_EQ(form_of(text), ProgramForm::rc10);
  const auto program = parse_program({text, "multiply.rc1"}, form_of(text), profiles::geforce2);
  ASSERT_TRUE(program);
  EXPECT_EQ(program->state.general[0].rgb.out.scale, Scale::by_two);
}

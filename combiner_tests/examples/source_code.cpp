#include <gtest/gtest.h>
#include <ninebit/language/source_code.h>

TEST(Examples, SourceCode) {
  using namespace ninebit;
  const SourceText source{
      "void Water::setup(int unit) {\n"
      "  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE0_ARB + unit,\n"
      "                    GL_UNSIGNED_IDENTITY_NV, GL_RGB);\n"
      "}\n",
      "water.cpp"};
  const auto functions = find_source_functions(source, {}, profiles::geforce2);
  ASSERT_EQ(functions.size(), 1U);
  EXPECT_EQ(functions[0].needs[0], "unit");  // without it, the call cannot be read

  const auto state = parse_source_code(source, {.definitions = {{"unit", "1"}}}, profiles::geforce2);
  EXPECT_EQ(state->general[0].rgb.b.reg, Register::texture1);
}

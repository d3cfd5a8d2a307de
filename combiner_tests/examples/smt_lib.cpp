#include <gtest/gtest.h>
#include <ninebit/language/smt_lib.h>

#include <string>
#include <vector>

TEST(Examples, SmtLib) {
  using namespace ninebit;
  CombinerState doubled;
  doubled.general[0].rgb.out.scale = Scale::by_two;
  const Program one = normalize(CombinerState{}, profiles::geforce2), two = normalize(doubled, profiles::geforce2);
  SmtProgram a, b;
  a.program = &one;
  b.program = &two;
  const auto primary = static_cast<std::size_t>(Register::primary);
  a.start[primary][kRed].input = b.start[primary][kRed].input = "primary.r";
  const auto fog = static_cast<std::size_t>(Register::fog);
  a.start[fog][kAlpha].code = b.start[fog][kAlpha].code = 255;    // no fog
  const Result<SmtQuestion> question = emit_smt_lib(a, b, kRed);  // for which red do they differ?
  ASSERT_TRUE(question.ok());
  EXPECT_EQ(question->inputs, std::vector<std::string>{"primary.r"});
  EXPECT_NE(question->text.find("(check-sat)"), std::string::npos);
}

#include <gtest/gtest.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/language/smt_lib.h>
#include <ninebit/numerics/hardware_profile.h>

#include <string>
#include <vector>

TEST(Examples, SmtLib) {
  using namespace ninebit;
  CombinerState doubled;
  doubled.general[0].rgb.out.scale = Scale::by_two;
  const Program one = normalize(CombinerState{}, profiles::geforce2), two = normalize(doubled, profiles::geforce2);
  std::vector<SmtProgram> sides(2);
  sides[0].program = &one;
  sides[1].program = &two;
  for (SmtProgram& side : sides) {
    side.start[static_cast<std::size_t>(Register::primary)][kRed].input = "primary.r";
    side.start[static_cast<std::size_t>(Register::fog)][kAlpha].code = 255;  // no fog
  }
  const Result<SmtQuestion> question = emit_smt_lib(sides[0], sides[1], kRed);  // for which red do they differ?
  ASSERT_TRUE(question.ok());
  EXPECT_EQ(question->inputs, std::vector<std::string>{"primary.r"});
  EXPECT_NE(question->text.find("(check-sat)"), std::string::npos);
}

#include <gtest/gtest.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/language/explain.h>

#include <string>

TEST(Examples, Explain) {
  using namespace ninebit;
  CombinerState state;
  state.general[0].rgb.b = {Register::texture0, InputMapping::expand_normal, ComponentUsage::rgb};
  const Explanation explanation = explain(normalize(state, profiles::geforce2), profiles::geforce2);
  EXPECT_EQ(explanation.equations[0].target, "spare0");
  EXPECT_EQ(explanation.equations[0].expression, "primary × expand(tex0)");
  EXPECT_NE(print_explanation(explanation).find("spare0 = "), std::string::npos);
}

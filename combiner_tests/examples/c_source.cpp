#include <gtest/gtest.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/language/c_source.h>

#include <string>

TEST(Examples, CSource) {
  using namespace ninebit;
  const Program program = normalize(CombinerState{}, profiles::geforce2);
  const Result<std::string> source = emit_c(program, "shade");
  ASSERT_TRUE(source.ok());
  EXPECT_NE(source->find("void shade(const int32_t primary[4]"), std::string::npos);
  EXPECT_FALSE(emit_c(program, "2d").ok());  // not a name
}

#include <gtest/gtest.h>
#include <ninebit/combiner/normalize.h>
#include <ninebit/language/glsl.h>

#include <string>

TEST(Examples, Glsl) {
  using namespace ninebit;
  const Program program = normalize(CombinerState{}, profiles::geforce2);
  const Result<std::string> shader = emit_glsl(program, GlslVersion::glsl_330, "shade");
  ASSERT_TRUE(shader.ok());
  EXPECT_EQ(shader->substr(0, 12), "#version 330");
  EXPECT_NE(shader->find("ivec4 shade("), std::string::npos);
}

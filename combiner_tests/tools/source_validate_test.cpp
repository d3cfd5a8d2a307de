// `ninebit validate` of source files without --function: the faults of all functions stand below the table.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

class SourceValidate : public testing::Test {
 protected:
  Outcome validate(const std::string& text, const Words& more = {}) {
    return ninebit(Words{"validate", write_bytes(folder_ / "set.c", text)} + more);
  }
  TempFolder folder_;
};

const std::string kGood = "glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);";

TEST_F(SourceValidate, FaultsOfTheTextAreListed) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_SPARE0_NVV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);",
       "did you mean 'GL_SPARE0_NV'?"},
      {"glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV);", "4 arguments"},
      {"nvparse(\"!!RC1.0\\n{ rgb { spare0 = colr0; } } out.rgb = spare0;\");", "colr0"},
      {"glFinalCombinrInputNV(GL_VARIABLE_D_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);",
       "did you mean 'glFinalCombinerInputNV'?"},
  };
  for (const auto& [call, message] : faults) {
    SCOPED_TRACE(call);
    const std::string text = "void good(void)\n{\n  " + kGood + "\n}\nvoid f(void)\n{\n  " + call + "\n}\n";
    const Outcome outcome = validate(text);
    EXPECT_EQ(outcome.code, 3);
    expect_parts(outcome.out, {"\nf "});
    expect_parts(outcome.err, {folder_ / "set.c" + ":7:", message});
    const Json rows = json_of(validate(text, {"--json"}), 3)["rows"];
    ASSERT_EQ(rows.size(), 1U);
    EXPECT_TRUE(rows[0]["gl_error"].is_null());
    EXPECT_EQ(rows[0]["line"], 7);
    expect_parts(rows[0]["message"].get<std::string>(), {message});
    // The faults are those of the function itself.
    EXPECT_EQ(err_of(validate(text, {"--function", "f", "--quiet"}), 3), outcome.err);
  }
}

TEST_F(SourceValidate, ValuesThatAreNotKnownAreNoFaults) {
  const std::string helper =
      "static void set(GLenum stage, GLenum input, const GLfloat *color)\n{\n"
      "  glCombinerInputNV(stage, GL_RGB, GL_VARIABLE_A_NV, input, GL_SIGNED_IDENTITY_NV, GL_RGB);\n"
      "  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, color);\n  nvparse(text_of(stage));\n}\n";
  EXPECT_EQ(validate(helper).code, 0);
  EXPECT_EQ(err_of(validate(helper + "void all(void) { set(GL_COMBINER0_NV, GL_TEXTURE0_ARB, tint); }\n")), "");
  expect_parts(out_of(validate(helper + "void all(void) { set(GL_COMBINER0_NV, GL_ONE, tint); }\n"), 1),
               {"GL_INVALID_ENUM"});
}

// The source compares with these strings, or they are the beginning of a program.
TEST_F(SourceValidate, PartsOfProgramsAreNoFaults) {
  const std::string outcome =
      out_of(validate("int is_program(const char *s) { return strncmp(s, \"!!RC1.0\", 7) == 0; }\n"
                      "std::string made() { return \"!!RC1.0\\n{ rgb { spare0 = \" + name + \"; } }\"; }\n"
                      "void f(void) { " +
                      kGood + " }\n"));
  const Words lines = lines_of(outcome);
  ASSERT_EQ(lines.size(), 4U) << outcome;
  EXPECT_TRUE(lines[2].starts_with("string                       1           0         1        0")) << lines[2];
}

TEST_F(SourceValidate, DestructorsHaveTheirNames) {
  expect_parts(out_of(validate("struct In { In() { " + kGood + " } ~In() { " + kGood + " } };\nSetup::Setup() { " +
                               kGood + " }\nSetup::~Setup() { " + kGood + " }\n")),
               {"\nIn::In ", "\nIn::~In ", "\nSetup::Setup ", "\nSetup::~Setup "});
  EXPECT_EQ(
      validate("Setup::Setup() { " + kGood + " }\nSetup::~Setup() { " + kGood + " }\n", {"--function", "Setup::~Setup"})
          .code,
      0);
}

// Code for OpenGL without combiners is code, too.
TEST_F(SourceValidate, CodeWithoutCombiners) {
  const Json fault = faults_of(validate("void f(void)\n{\n  glFinalCombinrInputNV(GL_VARIABLE_D_NV, GL_SPARE0_NV, "
                                        "GL_UNSIGNED_IDENTITY_NV, GL_RGB);\n  glEnable(GL_REGISTER_COMBINERS_NV);\n}\n",
                                        {"--json", "--function", "f", "--quiet"}),
                               3)["error"];
  EXPECT_TRUE(fault["message"].get<std::string>().ends_with("did you mean 'glFinalCombinerInputNV'?"));
  EXPECT_EQ(fault["line"], 3);
  EXPECT_EQ(fault["column"], 3);
  EXPECT_EQ(validate("void f(void) { glEnable(GL_REGISTER_COMBINERS_NV); }\n").code, 0);
  expect_error(validate("if (ready) {\n  glCombinrOutputNV(GL_COMBINER0_NV);\n}\nvoid f(void) { glFlush(); }\n"), 3,
               {"set.c:2:3: ", "did you mean 'glCombinerOutputNV'?"});
  const std::vector<std::pair<std::string, std::string>> texts{
      {"glBegin(GL_TRIANGLES); glEnd();", "no call of the register combiners was found in this source"},
      {"glColorFragmentOp1ATI(GL_MOV_ATI, GL_REG_0_ATI, GL_NONE, GL_NONE, GL_REG_1_ATI, GL_NONE, GL_NONE);",
       "this is code for ATI_fragment_shader, which register combiners cannot run"},
      {"glTexEnvi(GL_TEXTURE_ENV, GL_COMBINE_RGB_ARB, GL_DOT3_RGB_ARB);",
       "this is code for texture environments, which register combiners cannot run"},
  };
  for (const auto& [call, message] : texts) {
    expect_error(validate("void f(void)\n{\n  " + call + "\n}\n"), 3, {message});
    if (message.starts_with("this")) expect_error(validate(call + "\n"), 3, {message});
  }
}

// Stages alone, and stages that are enabled, are refused by a chip that has none.
TEST_F(SourceValidate, StagesOfAnotherChip) {
  const std::string set = "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);",
                    enable = "glEnable(GL_TEXTURE_SHADER_NV);";
  for (const std::string& body : {set, set + enable, kGood + enable}) {
    const Outcome refused = validate("void f(void)\n{\n  " + body + "\n}\n");
    EXPECT_EQ(refused.code, 1) << refused.out;
    expect_parts((refused.out + refused.err), {"GL_INVALID_ENUM: profile geforce2 has no texture shaders"});
    EXPECT_EQ(validate("void f(void)\n{\n  " + body + "\n}\n", {"--profile", "nv2a"}).code, 0);
  }
  EXPECT_EQ(validate("void f(void)\n{\n  " + kGood + set + "\n}\n").code, 0);
}

}  // namespace
}  // namespace tools_test

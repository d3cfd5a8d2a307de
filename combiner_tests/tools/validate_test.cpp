// `ninebit validate`: exit codes, the GL error of each call, places.
#include <gtest/gtest.h>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

using namespace ninebit;  // NOLINT(google-build-using-namespace): states are spelled in its words

class Validate : public testing::Test {
 protected:
  Outcome validate(const std::string& text, const Words& more = {}) {
    return ninebit(Words{"validate", write_bytes(folder_ / "program", text)} + more);
  }
  TempFolder folder_;
};

// Fog's alpha in a general combiner, three combiners where there are two, a dot product in an alpha portion.
const char* const kRefused =
    "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_FOG, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);\n"
    "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 3);\n"
    "  glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_NONE, GL_NONE,\n"
    "                     GL_TRUE, GL_FALSE, GL_FALSE);\n"
    "glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_ZERO, GL_EXPAND_NORMAL_NV, GL_RGB);\n";

TEST_F(Validate, ValidPrograms) {
  const std::string outcome = out_of(validate(article_calls()));
  EXPECT_EQ(outcome, folder_ / "program" + ": valid for geforce2\n");
  EXPECT_EQ(validate(article_calls(), {"--quiet"}).out, outcome);  // a result
  const Json object = json_of(validate(article_calls(), {"--json"}));
  EXPECT_EQ(keys_of(object), (Words{"command", "version", "profile", "rows"}));
  EXPECT_EQ(object["rows"], Json::array());
}

TEST_F(Validate, EveryRefusalWithItsErrorAndPlace) {
  const Outcome outcome = validate(kRefused);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_EQ(outcome.err, "");
  const Words lines = lines_of(outcome.out);
  ASSERT_EQ(lines.size(), 4U) << outcome.out;
  const std::string file = folder_ / "program";
  EXPECT_TRUE(lines[0].starts_with(file + ":1:1: GL_INVALID_OPERATION: ")) << lines[0];
  EXPECT_TRUE(lines[1].starts_with(file + ":2:1: GL_INVALID_VALUE: ")) << lines[1];
  EXPECT_TRUE(lines[2].starts_with(file + ":3:3: GL_INVALID_VALUE: ")) << lines[2];
  EXPECT_TRUE(lines[3].starts_with(file + ":5:1: GL_INVALID_ENUM: ")) << lines[3];
  const Json rows = json_of(validate(kRefused, {"--json"}), 1).at("rows");
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[2]["gl_error"], "GL_INVALID_VALUE");
  EXPECT_EQ(rows[2]["line"], 3);
  EXPECT_EQ(rows[2]["column"], 3);
  for (const char* key : {"gl_error", "stage", "portion", "variable", "line", "column", "message"}) {
    EXPECT_TRUE(rows[0].contains(key)) << key;
  }
}

// The other forms have GL's error, too, where their text loaded would raise it.
TEST_F(Validate, RefusalsInEveryForm) {
  const Json of_rc10 =
      json_of(validate("!!RC1.0\n{ rgb { spare0 = fog.a * discard; } }\nout.a = spare0;\n", {"--json"}), 1).at("rows");
  ASSERT_EQ(of_rc10.size(), 2U);
  EXPECT_EQ(of_rc10[0]["gl_error"], "GL_INVALID_OPERATION");
  EXPECT_EQ(of_rc10[0]["message"], "fog's alpha can be read by the final combiner alone");
  EXPECT_EQ(of_rc10[0]["line"], 2);
  EXPECT_EQ(of_rc10[0]["column"], 18);
  EXPECT_EQ(of_rc10[1]["gl_error"], "GL_INVALID_ENUM");
  EXPECT_EQ(lines_of(validate("!!RC1.0\nout.a = color_sum;\n").out),
            (Words{folder_ / "program" + ":2:9: GL_INVALID_OPERATION: 'color_sum' has no alpha, which out.a needs"}));
  const Json of_words = json_of(validate("RC_OUT_ALPHA[0] = 0x00002c00\n", {"--json"}), 1).at("rows");
  ASSERT_EQ(of_words.size(), 1U);
  EXPECT_EQ(of_words[0]["gl_error"], "GL_INVALID_VALUE");
  EXPECT_EQ(of_words[0]["line"], 1);
}

// Others in every form: same_fault_test.cpp.
TEST_F(Validate, TooManyCombinersAreARefusal) {
  std::string json_stages = "{}";
  for (int i = 1; i < 9; ++i) json_stages += ",{}";
  const std::string begin = R"({"ninebit":"program","version":1,)";
  for (const std::string& program : {std::string("glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1000000);\n"),
                                     begin + R"("num_general_combiners":99999999999999999999})",
                                     begin + R"("general_combiners":[)" + json_stages + "]}"}) {
    SCOPED_TRACE(program);
    expect_parts(out_of(validate(program), 1), {"GL_INVALID_VALUE"});
  }
  // So is a constant of one general combiner, on a profile that has none.
  EXPECT_EQ(validate("!!RC1.0\n{const0=(0,0,0,0);rgb{spare0=const0;}}out.a=zero;\n").code, 1);
  EXPECT_EQ(validate(begin + R"("per_stage_constants":true})").code, 1);
  EXPECT_EQ(validate("glEnable(GL_PER_STAGE_CONSTANTS_NV);\n").code, 1);
  // A number that is not a whole one is not a number of combiners in any language.
  expect_error(validate(begin + R"("num_general_combiners":1.5})"), 3, {"whole number"});
}

// Each profile has a feature that the other has not.
TEST_F(Validate, ByProfile) {
  CombinerState state;
  state.num_general_combiners = 5;
  state.per_stage_constants = true;
  const std::string program = write_program(folder_, "program.json", state);
  EXPECT_EQ(ninebit({"validate", program, "--profile", "nv2a"}).code, 0);
  const std::string refused = out_of(ninebit({"validate", program}), 1);
  EXPECT_EQ(lines_of(refused).size(), 2U) << refused;
}

TEST_F(Validate, WhatIsNoProgram) {
  expect_error(validate("glFoo(3);\n"), 3, {"program:1:1: "});
  expect_parts(err_of(validate("!!RC1.0\n{ rgb {"), 3), {"program:2:"});
  expect_error(validate("{\"ninebit\": \"program\", \"version\": 9}"), 3, {"program:1:"});
  expect_error(validate("RC_IN_RGB[0] = 0x00000006\n"), 3, {"program:1:"});
  expect_error(validate(std::string("\0\0\0", 3)), 3, {"program: this is a binary file; expected "});
  // A refusal beside a fault of the text: all of it is told, and there is no program.
  const Outcome both = validate(std::string(kRefused) + "glFoo();\n");
  EXPECT_EQ(both.code, 3);
  std::size_t errors = 0;
  for (const std::string& line : lines_of(both.err)) errors += line.starts_with("ninebit: error: ") ? 1U : 0U;
  EXPECT_EQ(errors, 5U) << both.err;
  expect_error(ninebit({"validate", "-"}, {.in = "/dev/zero"}), 3, {"16777216 bytes"});
}

}  // namespace
}  // namespace tools_test

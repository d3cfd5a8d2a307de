// Dumps of GL calls in the style of apitrace and GLIntercept: numbers, parameters' names, results, other calls.
#include <gtest/gtest.h>

#include <string>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

constexpr std::string_view kDump = R"dump(// process.name = "/usr/games/lamp"
1201 glXMakeCurrent(dpy = 0x55d0, drawable = 54525954, ctx = 0x5601) = True
1202 glGetString(name = GL_RENDERER) = "GeForce4 (glCombinerInputNV(\"x\"); too)"
1203 glBindTexture(target = GL_TEXTURE_2D, texture = 7)
1204 glEnable(cap = GL_TEXTURE_2D)
1205 glCombinerParameteriNV(pname = GL_NUM_GENERAL_COMBINERS_NV, param = 1)
1206 glCombinerParameterfvNV(pname = GL_CONSTANT_COLOR0_NV, params = {0.5, 0.25, 0, 1})
1207: glCombinerInputNV(stage = GL_COMBINER0_NV, portion = GL_RGB, variable = GL_VARIABLE_A_NV, input = GL_TEXTURE0, mapping = GL_EXPAND_NORMAL_NV, componentUsage = GL_RGB)
1208 @1 glCombinerOutputNV(stage = GL_COMBINER0_NV, portion = GL_RGB, abOutput = GL_DISCARD_NV, cdOutput = GL_DISCARD_NV, sumOutput = GL_SPARE0_NV, scale = GL_NONE, bias = GL_NONE, abDotProduct = GL_FALSE, cdDotProduct = GL_FALSE, muxSum = GL_FALSE) = 0
1209 glShaderSource(shader = 3, string = "void main()
{
  glCombinerInputNV(;
}")
  1210 glFinalCombinerInputNV(variable = GL_VARIABLE_D_NV, input = GL_SPARE0_NV, mapping = GL_UNSIGNED_IDENTITY_NV, componentUsage = GL_RGB) // no error
1211 glEnable(cap = GL_REGISTER_COMBINERS_NV)
1212 glBegin(mode = GL_TRIANGLES)
)dump";

constexpr std::string_view kCalls = R"(
glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, (GLfloat[]){0.5, 0.25, 0, 1});
glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_TEXTURE0, GL_EXPAND_NORMAL_NV, GL_RGB);
glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, 0, 0, false, false, false);
glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
glEnable(GL_REGISTER_COMBINERS_NV);
)";

TEST(GlCallsDump, IsReadAsTheCalls) {
  const auto dump = parse_gl_calls({kDump, "dump"}, profiles::nv2a);
  ASSERT_TRUE(dump) << test::all_faults(dump);
  const auto calls = parse_gl_calls({kCalls, "calls"}, profiles::nv2a);
  ASSERT_TRUE(calls) << test::all_faults(calls);
  EXPECT_TRUE(*dump == *calls);
  ASSERT_EQ(dump.notes.size(), 1U);
  EXPECT_EQ(dump.notes[0].line, 2);
  EXPECT_EQ(dump.notes[0].message,
            "skipped 6 calls that set no combiners: glXMakeCurrent, glGetString, glBindTexture, glEnable, "
            "glShaderSource, glBegin");
}

TEST(GlCallsDump, NumbersNamesAndResultsAreOptional) {
  const auto expected = parse_gl_calls({"glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);", ""}, profiles::nv2a);
  ASSERT_TRUE(expected);
  for (const char* const text : {
           "7 glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2)",
           "7: glCombinerParameteriNV( GL_NUM_GENERAL_COMBINERS_NV, param=2 );",
           "glCombinerParameteriNV(pname = GL_NUM_GENERAL_COMBINERS_NV, 2) = 0;",
           "glCombinerParameteriNV(pname = GL_NUM_GENERAL_COMBINERS_NV, param = 2) = 0\n",
           "7 glCombinerParameterivNV(pname = GL_NUM_GENERAL_COMBINERS_NV, params = [2, 0])\r\n8 glFlush()\r\n",
           "1 glBegin(GL_POINTS);\n2 glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2); glDisable(0x8522);",
       }) {
    const auto read = parse_gl_calls({text, "dump"}, profiles::nv2a);
    ASSERT_TRUE(read) << text << '\n' << test::all_faults(read);
    EXPECT_TRUE(*read == *expected) << text;
  }
}

TEST(GlCallsDump, FaultsKeepTheirPlaces) {
  const auto read = parse_gl_calls({"1 glCombinerParameteriNV(pname = GL_NUM_GENERAL_COMBINERS, param = 99)\n"
                                    "2 glCombinerInputNV(stage = GL_COMBINER0_NV, portion =\n"
                                    "3 glEnable(cap = GL_LIGHTING)\n"
                                    "4 glFinalCombinerInputNV(variable = GL_VARIABLE_D_NV, input = GL_SPAER0_NV, "
                                    "mapping = GL_UNSIGNED_IDENTITY_NV, componentUsage = GL_RGB)\n",
                                    "dump"},
                                   profiles::nv2a);
  ASSERT_EQ(read.faults().size(), 3U) << test::all_faults(read);
  EXPECT_EQ(read.faults()[0].gl_error, GlError::invalid_value);
  EXPECT_EQ(read.faults()[1].line, 3);
  EXPECT_EQ(read.faults()[2].line, 4);
  EXPECT_TRUE(test::has(read.faults()[2].message, "did you mean 'GL_SPARE0_NV'?"));
}

// A chip without texture shaders refuses to enable them; without that their calls have no effect.
TEST(GlCallsDump, StagesOfAnotherChip) {
  const std::string set =
      "1 glCombinerParameteriNV(pname = GL_NUM_GENERAL_COMBINERS_NV, param = 2)\n"
      "2 glTexEnvi(target = GL_TEXTURE_SHADER_NV, pname = GL_SHADER_OPERATION_NV, param = GL_NONE)\n";
  TextureShaderState stages;
  EXPECT_TRUE(parse_gl_calls({set, "dump"}, profiles::geforce2, &stages));
  const auto enabled =
      parse_gl_calls({set + "3 glEnable(cap = GL_TEXTURE_SHADER_NV)\n", "dump"}, profiles::geforce2, &stages);
  ASSERT_EQ(enabled.faults().size(), 1U);
  EXPECT_EQ(enabled.faults()[0].gl_error, GlError::invalid_enum);
  EXPECT_EQ(enabled.faults()[0].line, 3);
}

TEST(GlCallsDump, OthersAreFaults) {
  for (const char* const text : {
           "1 glBegin(mode = GL_POINTS)\n2 glEnd()\n",          // sets no combiners
           "glBegin(GL_POINTS)\n",                              // has no number
           "glFlush(); 7 glEnable(GL_REGISTER_COMBINERS_NV);",  // the number does not begin the line
           "7\nglEnable(GL_REGISTER_COMBINERS_NV);",            // it stands alone
           "7glEnable(GL_REGISTER_COMBINERS_NV);",              // it is no number
           "-7 glEnable(GL_REGISTER_COMBINERS_NV);",            // it has a sign
           ".7 glEnable(GL_REGISTER_COMBINERS_NV);",            // it is no whole number
           "glEnable(cap == GL_REGISTER_COMBINERS_NV);",        // that is no name
           "glEnable(cap = );",                                 // there is no value
       }) {
    EXPECT_FALSE(parse_gl_calls({text, "dump"}, profiles::nv2a)) << text;
  }
}

}  // namespace
}  // namespace ninebit

// The faults of sources that cannot be read, and of choices that mean nothing.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/source_code.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

const std::string kSetCount = "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, ";

std::string faults_of(const std::string& text, const SourceSelection& selection = {},
                      const HardwareProfile& profile = profiles::nv2a) {
  const auto parsed = parse_source_code({text, "s"}, selection, profile);
  EXPECT_NE(parsed.ok(), !parsed.faults().empty());
  return test::all_faults(parsed);
}

TEST(SourceFaults, OfTheChoice) {
  const std::string two = "void a() { " + kSetCount + "2); }\nvoid A::b() { " + kSetCount + "3); }\nvoid B::b() { " +
                          kSetCount + "4); }\nint c;";
  EXPECT_EQ(
      faults_of(two),
      "s:1:6: several functions set combiners; choose by --function NAME: a (line 1), A::b (line 2), B::b (line 3)\n");
  EXPECT_EQ(faults_of(two, {{"a"}, {}}), "");
  EXPECT_EQ(faults_of(two, {{"A::b"}, {}}), "");
  EXPECT_EQ(faults_of(two, {{"b:3"}, {}}), "");
  EXPECT_EQ(faults_of(two, {{"b"}, {}}),
            "s:2:9: several functions are named 'b'; choose by --function A::b:2, B::b:3\n");
  EXPECT_EQ(faults_of(two, {{"A::bb"}, {}}),
            "s:1:1: no function 'A::bb'; did you mean 'A::b'?; combiners are set by a (line 1), A::b (line 2), B::b "
            "(line 3)\n");
  EXPECT_EQ(faults_of("void a() { " + kSetCount + "2); }\nvoid b() { c(); }", {{"b"}, {}}),
            "s:1:1: function 'b' sets no combiners; combiners are set by a (line 1)\n");
  EXPECT_EQ(faults_of("int main() { return 0; }"),
            "s:1:1: no call of the register combiners was found in this source\n");
  EXPECT_EQ(
      faults_of("void a() { " + kSetCount + "2); }", {{}, {{"x", "1 +"}}}),
      "s:1:1: the value '1 +' that is defined for 'x' cannot be read; expected a number, an enumerant, or several "
      "separated by commas\n");
}

TEST(SourceFaults, OfCalls) {
  EXPECT_EQ(faults_of("void a() {\n  " + kSetCount + "99);\n}"),
            "s:2:3: GL_INVALID_VALUE: profile nv2a has 8 general combiners\n");
  EXPECT_EQ(faults_of("void a() {\n  glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_SPAER0_NV, "
                      "GL_UNSIGNED_IDENTITY_NV, GL_RGB);\n}"),
            "s:2:64: 'GL_SPAER0_NV' is not an enumerant of the register combiners; did you mean 'GL_SPARE0_NV'?\n");
  EXPECT_EQ(faults_of("void a() {\n  glCombinerInptuNV(GL_COMBINER0_NV);\n  " + kSetCount + "2);\n}"),
            "s:2:3: 'glCombinerInptuNV' is not a call of the register combiners; did you mean 'glCombinerInputNV'?\n");
  // Java's array: the variable is asked for, and no test of it is decided.
  const std::string java =
      "void a() {\n  float[] c = {0, 0, 0, 1};\n  if (c != null) glCombinerParameterfvNV("
      "GL_CONSTANT_COLOR0_NV, c, 0);\n}";
  EXPECT_EQ(faults_of(java),
            "s:3:65: a value is not known: 'c' (line 3, 4 numbers); give it as in --define 'c=0,0,0,1'\n");
  EXPECT_EQ(faults_of("void a() {\n  glCombinerInputNV(GL_COMBINER0_NV GL_RGB);\n}"),
            "s:2:3: a call of the combiners cannot be read here: expected a statement, found 'GL_RGB'\n");
  EXPECT_EQ(faults_of("void a() {\n  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV);\n}"),
            "s:2:3: glCombinerParameteriNV takes 2 arguments, not 1\n");
  // A fault in a loop is one fault; all faults are reported.
  EXPECT_EQ(faults_of("void a() {\n  for (int i = 0; i < 9; i++) " + kSetCount +
                          "9);\n  glEnable(GL_PER_STAGE_CONSTANTS_NV);\n}",
                      {}, profiles::geforce2),
            "s:2:31: GL_INVALID_VALUE: profile geforce2 has 2 general combiners\n"
            "s:3:3: GL_INVALID_ENUM: profile geforce2 has no per-stage constants (NV_register_combiners2)\n");
}

TEST(SourceFaults, OfProgramsInStringsHaveTheirPlace) {
  EXPECT_EQ(faults_of("void a() {\n  nvparse(\"!!RC1.0\\n\"\n          \"{ rgb { spare0 = tex7; } }\\n\"\n  \"out.rgb "
                      "= zero;\");\n}"),
            "s:3:29: expected a register to read, found 'tex7'; did you mean 'tex0'?\n");
}

// All that a macro calls stands where it is used.
TEST(SourceFaults, AMisspelledCallOfAMacroIsFoundBehindAnotherCall) {
  const std::string both =
      "#define BOTH(x) setupCombiners(x); glCombinerParameteriNw(GL_NUM_GENERAL_COMBINERS_NV, x)\n";
  EXPECT_TRUE(test::has(faults_of(both + "void f() { " + kSetCount + "2); BOTH(1); }"),
                        "did you mean 'glCombinerParameteriNV'"));
}

TEST(SourceFaults, EndlessLoopsAndRecursionEnd) {
  EXPECT_EQ(faults_of("void a() { " + kSetCount + "2); while (1) { draw(); } }"), "");
  EXPECT_EQ(faults_of("void a() { " + kSetCount + "2); for (;;) ; }"), "");
  EXPECT_TRUE(test::has(faults_of("void a() { int i = 0; while (i >= 0) { i++; " + kSetCount + "2); } }"),
                        "runs for too long"));
  EXPECT_EQ(faults_of("int r(int n) { return r(n + 1); }\nvoid a() { r(0); " + kSetCount + "2); }"), "");
  EXPECT_NE(faults_of("void a() { a(); a(); " + kSetCount + "2); }"), "never ends");
  // Macros that double.
  std::string bomb = "#define A0 x\n";
  for (int i = 1; i < 60; ++i) {
    const std::string n = std::to_string(i), m = std::to_string(i - 1);
    bomb += "#define A" + n + " A" + m + " A" + m + "\n";
  }
  EXPECT_TRUE(test::has(faults_of(bomb + "void a() { " + kSetCount + "2); A59; }"), "more than"));
}

// Many functions that never end cost no more than ten of them.
TEST(SourceFaults, FunctionsThatRunForTooLongShareTheirSteps) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  constexpr int kFunctions = 200, kRun = 10;
  std::string text;
  for (int i = 0; i < kFunctions; ++i) {
    text += "void f" + std::to_string(i) + "() { int i; for (i = 0; i < 3; --i) " + kSetCount + "i); }\n";
  }
  int by_itself = 0, together = 0;
  for (const SourceFunction& one : find_source_functions({text, "s"}, {}, profiles::nv2a)) {
    for (const TextFault& fault : one.faults) {
      by_itself += fault.message.find("the function runs for too long") != std::string::npos ? 1 : 0;
      together += fault.message.find("a source's take at most 2,000,000 steps") != std::string::npos ? 1 : 0;
    }
  }
  EXPECT_EQ(by_itself, kRun - 1);
  EXPECT_EQ(together, kFunctions - by_itself);
  EXPECT_TRUE(test::has(faults_of(text, {.functions = {"f199"}}), "the function runs for too long"));
}

TEST(SourceFaults, DeepNestingIsRefusedNotFollowed) {
  constexpr std::size_t kDeep = test::cases_here(20'000U);
  for (const auto& [open, close] : std::vector<std::pair<std::string, std::string>>{{"(", ")"},
                                                                                    {"{", "}"},
                                                                                    {"[", "]"},
                                                                                    {"if (x) ", ";"},
                                                                                    {"-", "1"},
                                                                                    {"a.", "b"},
                                                                                    {"f(", ")"},
                                                                                    {"1 + ", "1"},
                                                                                    {"x ? ", ": 1"},
                                                                                    {"for (;;) ", ";"},
                                                                                    {"else if (1) ", ";"},
                                                                                    {"class A { ", "};"},
                                                                                    {"case 1: ", ";"},
                                                                                    {"do ", ";"},
                                                                                    {"\"!!RC1.0\" ", ";"}}) {
    std::string text = "void a() { " + kSetCount;
    for (std::size_t i = 0; i < kDeep; ++i) text += open;
    for (std::size_t i = 0; i < kDeep; ++i) text += close;
    const auto parsed = parse_source_code({text + "2); }", "s"}, {{"a"}, {}}, profiles::nv2a);
    EXPECT_LE(parsed.faults().size(), kMaxTextFaults) << open;
    std::string outside;
    for (std::size_t i = 0; i < kDeep; ++i) outside += open;
    (void)find_source_functions({outside + "\nvoid a() { " + kSetCount + "2); }", "s"}, {}, profiles::nv2a);
  }
}

}  // namespace
}  // namespace ninebit

// The constructs of a source that are understood, one by one, and the values that are asked for.
#include "ninebit/language/source_code.h"

#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

Parsed<CombinerState> parse(const std::string& text, const SourceSelection& selection = {}) {
  return parse_source_code({text, "s"}, selection, profiles::nv2a);
}

std::string notes_of(const Parsed<CombinerState>& parsed) {
  std::string all;
  for (const TextFault& note : parsed.notes) all += note.text() + "\n";
  return all;
}

const std::string kSet = "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, ";

// The number of general combiners after a function with this body.
int count(const std::string& body, const std::string& outside = "", const std::vector<Definition>& definitions = {}) {
  const auto parsed = parse(outside + "\nvoid f(int p, float *q) {\n" + body + "\n}\n", {{"f"}, definitions});
  EXPECT_TRUE(parsed) << body << "\n" << test::all_faults(parsed);
  return parsed ? parsed->num_general_combiners : 0;
}

// Constant colour 0 after a function with this body.
ColorF color(const std::string& body, const std::string& outside = "",
             const std::vector<Definition>& definitions = {}) {
  const auto parsed = parse(outside + "\nvoid f(float *p) {\n" + body + "\n}\n", {{"f"}, definitions});
  EXPECT_TRUE(parsed) << body << "\n" << test::all_faults(parsed);
  return parsed ? parsed->constant0 : ColorF{-1, -1, -1, -1};
}
const std::string kColor = "glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, ";

TEST(SourceCode, ExpressionsAreThoseOfC) {
  const std::vector<std::pair<const char*, int>> expressions{{"1 + 2 * 2", 5},
                                                             {"(1 + 2) * 2", 6},
                                                             {"0x10 >> 2 | 1", 5},
                                                             {"7 & ~4", 3},
                                                             {"8 / 3", 2},
                                                             {"11 % 4", 3},
                                                             {"1 ? 4 : 2", 4},
                                                             {"0 || 3 ? 3 : 1", 3},
                                                             {"(int)2.9", 2},
                                                             {"(GLint)(2 + 1)", 3},
                                                             {"int(3.5)", 3},
                                                             {"static_cast<GLint>(4)", 4},
                                                             {"-(-5)", 5},
                                                             {"!0 + 1", 2},
                                                             {"(2, 3)", 3},
                                                             {"010 - 4", 4},
                                                             {"1 << 1 << 1", 4},
                                                             {"5 > 4 == 1 ? 6 : 1", 6},
                                                             {"true + true", 2},
                                                             {"max(2, 3)", 3},
                                                             {"abs(-4)", 4},
                                                             {"'C' - 'A'", 2},
                                                             {"(const int) 3", 3},
                                                             {"1 != 2 ? 2 : 3", 2},
                                                             {"NULL == 0 ? 4 : 5", 4},
                                                             {"2 - 1 - 1 + 5", 5}};
  for (const auto& [text, wanted] : expressions) EXPECT_EQ(count(kSet + text + ");"), wanted) << text;
}

TEST(SourceCode, NamesAreVariablesConstantsEnumeratorsAndMacros) {
  EXPECT_EQ(count(kSet + "N);", "#define N 3"), 3);
  EXPECT_EQ(count(kSet + "N(2));", "#define N(x) ((x) + 1)"), 3);
  EXPECT_EQ(count("SET(3);", "#define SET(n) " + kSet + "n)"), 3);
  EXPECT_EQ(count("PARAM(GENERAL_COMBINERS, 3);",
                  "#define PARAM(n, ...) glCombinerParameteriNV(GL_NUM_##n##_NV, __VA_ARGS__)"),
            3);
  EXPECT_EQ(count(kSet + "B);", "#define A \\\n 3\n#define B A"), 3);
  EXPECT_EQ(count(kSet + "x);", "enum { a = 2, x, y };"), 3);
  EXPECT_EQ(count(kSet + "Mode::x);", "class Mode { public: enum T { w, x = 5 }; };"), 5);
  EXPECT_EQ(count(kSet + "k + 1);", "static const int k = 2;"), 3);
  EXPECT_EQ(count(kSet + "t[1][0]);", "const int t[2][2] = { { 1, 2 }, { 3, 4 } };"), 3);
  EXPECT_EQ(count(kSet + "t[1].n);", "struct entry { int m, n; };\nentry t[] = { { 1, 2 }, { 3, 4 } };"), 4);
  EXPECT_EQ(count("int i = 1, j; j = i++; i += j; " + kSet + "i);"), 3);
  EXPECT_EQ(count("int i, v[3]; i = 0; v[i++] = 7; v[i++] = 5; " + kSet + "v[1]);"), 5);
  EXPECT_EQ(count("state.stages = 4; " + kSet + "state.stages);"), 4);
  EXPECT_EQ(count("this->stages = 4; " + kSet + "stages);"), 4);
}

TEST(SourceCode, StatementsAreExecuted) {
  EXPECT_EQ(count("if (1 > 2) " + kSet + "3); else " + kSet + "4);"), 4);
  EXPECT_EQ(count("int i; for (i = 0; i < 8; i += 3) { } " + kSet + "i - 4);"), 5);
  EXPECT_EQ(count("int i = 0; while (i < 5) ++i; " + kSet + "i);"), 5);
  EXPECT_EQ(count("int i = 0; do { i++; } while (i < 3); " + kSet + "i);"), 3);
  EXPECT_EQ(count("for (int i = 1; ; i++) { if (i == 3) continue; if (i == 6) break; " + kSet + "i); }"), 5);
  EXPECT_EQ(count("switch (2) { case 1: " + kSet + "3); break; case 2: " + kSet + "4); case 3: " + kSet +
                  "5); break; default: " + kSet + "6); }"),
            5);
  EXPECT_EQ(count("switch (9) { case 1: " + kSet + "3); break; default: " + kSet + "6); }"), 6);
  EXPECT_EQ(count(kSet + "3); return; " + kSet + "4);"), 3);
  EXPECT_EQ(count("{ try { " + kSet + "3); } catch (...) { " + kSet + "4); } }"), 3);
  EXPECT_EQ(count("again: " + kSet + "3);"), 3);
  EXPECT_EQ(count("GLenum pname = GL_NUM_GENERAL_COMBINERS_NV; (*glCombinerParameteriNV)(pname, 3);"), 3);
  EXPECT_EQ(count("CHECK(" + kSet + "3));"), 3);
  EXPECT_EQ(count("if (glGetError() != GL_NO_ERROR) return; " + kSet + "3);"), 3);
  EXPECT_EQ(count("if (!glCombinerInputNV || glCombinerParameteriNV == NULL) return; " + kSet + "3);"), 3);
  EXPECT_EQ(count("GLint most; glGetIntegerv(GL_MAX_GENERAL_COMBINERS_NV, &most); " + kSet + "most);"), 8);
  EXPECT_EQ(count("if (hasExtension(\"GL_NV_register_combiners\") && GLEW_NV_register_combiners2) " + kSet + "3);"), 3);
}

TEST(SourceCode, FunctionsOfTheFileAreCalled) {
  EXPECT_EQ(count("set(3);", "void set(int n) { " + kSet + "n); }"), 3);
  EXPECT_EQ(count(kSet + "twice(2));", "static int twice(int n) { return n * 2; }"), 4);
  EXPECT_EQ(count("auto n = twice(2); " + kSet + "n);",
                  "int one(int n) { return n; }\nint twice(int n) { return one(n) * 2; }"),
            4);
  EXPECT_EQ(count("set();", "void set(int n = 5) { " + kSet + "n); }"), 5);
  EXPECT_EQ(count("set(2, 3);", "void set(int n) { " + kSet + "n); }\nvoid set(int a, int b) { " + kSet + "a + b); }"),
            5);
  EXPECT_EQ(
      count("int v[4]; fill(v); " + kSet + "v[3]);", "void fill(int *v) { for (int i = 0; i < 4; i++) v[i] = i + 1; }"),
      4);
  EXPECT_EQ(count(kSet + "depth(3));", "int depth(int n) { return n == 0 ? 2 : depth(n - 1) + 1; }"), 5);
  // A wrapper with the name of what it calls.
  EXPECT_EQ(count("CombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 3);",
                  "void CombinerParameteriNV(GLenum p, GLint v) { gl->CombinerParameteriNV(p, v); }"),
            3);
}

TEST(SourceCode, ArraysOfNumbersAreColours) {
  const ColorF wanted{0.25F, 0.5F, 0.75F, 1.0F};
  EXPECT_EQ(color("float c[4] = { .25f, .5, 3 / 4.0, 1 }; " + kColor + "c);"), wanted);
  EXPECT_EQ(color("float c[4]; c[0] = .25; c[1] = 2 * c[0]; c[2] = c[0] + c[1]; c[3] = 1; " + kColor + "&c[0]);"),
            wanted);
  EXPECT_EQ(color(kColor + "(GLfloat[]){ .25, .5, .75, 1 });"), wanted);
  EXPECT_EQ(
      color("vec4_t c; c[0] = .25; c[1] = .5; c[2] = .75; c[3] = 1; " + kColor + "c);", "typedef float vec4_t[4];"),
      wanted);
  EXPECT_EQ(color("float c[5] = { 9, .25, .5, .75, 1 }; " + kColor + "&c[1]);"), wanted);
  EXPECT_EQ(color("Vec4f c(.25, .5, .75, 1); " + kColor + "c.data());"), wanted);
  EXPECT_EQ(color("Color4 c = Color4(.25, .5, .75, 1); " + kColor + "&c.r);"), wanted);
  EXPECT_EQ(color("float c[4] = { .25, .5, .75 }; c[3] = 1; " + kColor + "(const GLfloat *) c);"), wanted);
  EXPECT_EQ(color("float m[2][4] = { { 0 }, { .25, .5, .75, 1 } }; " + kColor + "m[1]);"), wanted);
  EXPECT_EQ(color("float c[] = { .25, .5, .75, 1 }; glLightfv(GL_LIGHT0, GL_DIFFUSE, c); " + kColor + "c);"), wanted);
  // OpenGL reads four numbers.
  const auto three = parse("void f() { float c[3] = { 1, 1, 1 }; " + kColor + "c); }");
  ASSERT_TRUE(three);
  EXPECT_EQ(three->constant0, (ColorF{1, 1, 1, 0}));
  EXPECT_EQ(notes_of(three), "s:1:85: 'c' has 3 values; took 0 for the fourth, which OpenGL reads, too\n");
}

TEST(SourceCode, ConditionsOfThePreprocessor) {
  const std::string two = kSet + "2);\n", three = kSet + "3);\n";
  EXPECT_EQ(count("#if 1\n" + two + "#else\n" + three + "#endif"), 2);
  EXPECT_EQ(count("#if 0\n" + two + "#elif 2 > 1 && !defined(X)\n" + three + "#endif"), 3);
  EXPECT_EQ(count("#ifdef X\n" + two + "#else\n" + three + "#endif"), 3) << "as in C";
  EXPECT_EQ(count("#ifdef X\n" + two + "#else\n" + three + "#endif", "", {{"X", "1"}}), 2);
  EXPECT_EQ(count("#if X == 4\n" + two + "#else\n" + three + "#endif", "#define X 4"), 2);
  EXPECT_EQ(count("#ifdef GL_NV_register_combiners\n" + two + "#else\n" + three + "#endif"), 2);
  const auto only = parse("void f() {\n#ifdef USE_COMBINERS\n" + two + "#endif\n}");
  ASSERT_TRUE(only) << test::all_faults(only);
  EXPECT_EQ(only->num_general_combiners, 2);
  EXPECT_EQ(notes_of(only),
            "s:2:2: read the part of #ifdef USE_COMBINERS as if it were true: only there are combiners set\n");
  // Other calls are there without the condition.
  EXPECT_EQ(count(three + "#ifdef OLD_CODE\n" + two + "#endif"), 3);
  const auto skipped = parse("void f() {\n#if 0\n" + two + "#else\n" + three + "#endif\n}");
  ASSERT_TRUE(skipped);
  EXPECT_EQ(notes_of(skipped), "s:2:2: skipped calls of combiners: #if 0 is false\n");
  // The operators are C's, and names may stand for expressions.
  for (const char* condition : {"(X + 1) * 2 == 10", "X << 1 == 8 && X % 3 == 1", "(X & 6) ? X > 3 : 0", "TWICE == 8",
                                "X - 1 == 3", "!(X == 3)", "0x4 == X", "GL_NV_register_combiners"}) {
    EXPECT_EQ(count("#if " + std::string(condition) + "\n" + two + "#else\n" + three + "#endif",
                    "#define X 4\n#define TWICE 2 * X"),
              2)
        << condition;
  }
  // A definition that only a condition asks for was needed.
  EXPECT_EQ(notes_of(parse("void f() {\n#ifdef X\n" + two + "#endif\n}", {{}, {{"X", "1"}}})), "");
  EXPECT_EQ(notes_of(parse("void f() {\n" + two + "}", {{}, {{"X", "1"}}})),
            "s:1:1: the definition of 'X' was not needed\n");
}

// A name without a value that decides which calls are read is asked for, where it matters.
TEST(SourceCode, ConditionsOfThePreprocessorAskForNames) {
  const std::string two = kSet + "2);\n", three = kSet + "3);\n";
  const std::string asks =
      "void f() {\n#if MODE == 0\n" + two + "#endif\n#if MODE != 0\n" + three + "#endif\n}\nvoid g() {\n" + two + "}\n";
  const auto parsed = parse(asks, {.functions = {"f"}});
  EXPECT_EQ(test::all_faults(parsed),
            "s:2:2: a value is not known: 'MODE' (lines 2, 5); give it as in --define 'MODE=…'\n");
  EXPECT_TRUE(parse(asks, {.functions = {"g"}}));
  for (const auto& [value, wanted] : {std::pair("0", 2), std::pair("1", 3)}) {
    const auto defined = parse(asks, {.functions = {"f"}, .definitions = {{"MODE", value}}});
    ASSERT_TRUE(defined) << test::all_faults(defined);
    EXPECT_EQ(defined->num_general_combiners, wanted);
  }
  const auto functions = find_source_functions({asks, "s"}, {}, profiles::nv2a);
  ASSERT_EQ(functions.size(), 2U);
  EXPECT_EQ(functions[0].needs, std::vector<std::string>{"MODE"});
  EXPECT_TRUE(functions[1].needs.empty());
  // Whole functions, callers, and code outside of functions.
  const std::string whole =
      "#if MODE\nvoid h() {\n" + two + "}\n#else\nvoid h() {\n" + three + "}\n#endif\nvoid f() { h(); }\n";
  EXPECT_FALSE(parse(whole, {.functions = {"h"}}));
  EXPECT_FALSE(parse(whole, {.functions = {"f"}}));
  EXPECT_TRUE(parse(whole, {.functions = {"f"}, .definitions = {{"MODE", "1"}}}));
  EXPECT_FALSE(parse("#if MODE\n" + two + "#else\n" + three + "#endif\n"));
  // Conditions that decide about no call, or not alone, ask for nothing.
  EXPECT_EQ(count("#if MODE > 2\nint x;\n#else\nfloat x;\n#endif\n" + two), 2);
  EXPECT_EQ(count("#if defined(MODE) && MODE > 2\n" + three + "#else\n" + two + "#endif\n"), 2);
}

TEST(SourceCode, WhatIsNotKnownIsAskedForInOneFault) {
  const auto parsed = parse(
      "void f(int mode, const float *color) {\n"
      "  if (mode == 2) " +
      kSet +
      "2);\n"
      "  else " +
      kSet +
      "scene->stages + more());\n"
      "  " +
      kColor +
      "color);\n"
      "}");
  ASSERT_FALSE(parsed);
  EXPECT_EQ(
      test::all_faults(parsed),
      "s:2:7: 4 values are not known: 'color' (line 4, 4 numbers), 'mode' (line 2), 'more()' (line 3), 'scene.stages' "
      "(line 3); give each as in --define 'color=0,0,0,1' --define 'mode=…' --define 'more()=…'\n");
  const std::string text = "void f(int mode) { " + kSet + "scene->stages + more(1)); }";
  const auto given = parse(text, {{}, {{"scene->stages", "1"}, {"more( 1 )", "GL_TRUE + 1"}}});
  ASSERT_TRUE(given) << test::all_faults(given);
  EXPECT_EQ(given->num_general_combiners, 3);
  // A definition wins over the source, and its names are only equal to themselves.
  EXPECT_EQ(count("int n = 2; " + kSet + "n);", "", {{"n", "4"}}), 4);
  EXPECT_EQ(count("if (p == MODE_A) " + kSet + "2); else if (p == MODE_B) " + kSet + "3);", "", {{"p", "MODE_B"}}), 3);
  EXPECT_EQ(
      count("switch (p) { case MODE_A: " + kSet + "2); break; case MODE_B: " + kSet + "3); }", "", {{"p", "MODE_B"}}),
      3);
  EXPECT_EQ(color(kColor + "p);", "", {{"p", "{1, 0.5, 1 / 4.0, 0}"}}), (ColorF{1, 0.5F, 0.25F, 0}));
}

TEST(SourceCode, OnlyWhatMattersIsAskedFor) {
  // Conditions under which nothing is set, and values that go nowhere.
  EXPECT_EQ(count("if (p) q[0] = 1; int z = unknown(p); glBindTexture(GL_TEXTURE_2D, z); " + kSet + "3);"), 3);
  EXPECT_EQ(count("for (int i = 0; i < p; i++) draw(i); " + kSet + "3);"), 3);
  // A value that an unknown condition changes is asked for if it is used.
  const auto used = parse("void f(int p) { int n = 2; if (p) n = 3; " + kSet + "n); }");
  EXPECT_EQ(test::all_faults(used), "s:1:94: a value is not known: 'p' (line 1); give it as in --define 'p=…'\n");
  // Without one way there would be no program.
  const auto guard = parse("void f() {\n  if (!ready()) return;\n  " + kSet + "3);\n}");
  ASSERT_TRUE(guard) << test::all_faults(guard);
  EXPECT_EQ(notes_of(guard),
            "s:2:3: assumed that !ready() is false: else no combiners are set\n"
            "s:2:8: skipped calls that set no combiners, line 2: ready\n");
  const auto whole = parse("void f(bool fast) {\n  if (fast) { " + kSet + "3); }\n}");
  ASSERT_TRUE(whole) << test::all_faults(whole);
  EXPECT_EQ(notes_of(whole), "s:2:3: assumed that fast is true: only then are combiners set\n");
  // Arrays that another function may write.
  const auto written = parse("void f() { float c[4] = { 1, 1, 1, 1 }; normalize(c); " + kColor + "c); }");
  EXPECT_EQ(test::all_faults(written),
            "s:1:102: a value is not known: 'c' (line 1, 4 numbers); give it as in --define 'c=0,0,0,1'\n");
}

TEST(SourceCode, VariablesOfTheFileHaveTheirFirstValue) {
  const auto first = parse("int stages = 3;\nvoid f() { " + kSet + "stages); }");
  ASSERT_TRUE(first) << test::all_faults(first);
  EXPECT_EQ(notes_of(first), "s:1:5: took the initial value of 'stages', which is not a constant\n");
  EXPECT_EQ(notes_of(parse("const int stages = 3;\nvoid f() { " + kSet + "stages); }")), "");
  // Unless a function changes it.
  EXPECT_EQ(test::all_faults(parse("int stages = 3;\nvoid g() { stages++; }\nvoid f() { " + kSet + "stages); }")),
            "s:3:64: a value is not known: 'stages' (line 3); give it as in --define 'stages=…'\n");
}

// The values that are asked for suffice: the names of the fault, each defined as 1 or as four numbers.
void expect_asked(const std::string& text, const std::string& asked, const std::vector<Definition>& definitions,
                  int expected) {
  const auto found = parse(text, {{"f"}, {}});
  ASSERT_FALSE(found) << text;
  EXPECT_TRUE(test::has(test::all_faults(found), asked));
  const auto given = parse(text, {{"f"}, definitions});
  ASSERT_TRUE(given) << text << "\n" << test::all_faults(given);
  EXPECT_EQ(given->num_general_combiners, expected) << text;
}

TEST(SourceCode, WaysThatAreNotDecidedLeaveWhatTheyHaveInCommon) {
  EXPECT_EQ(count("int n; if (p) n = 3; else n = 3; " + kSet + "n);"), 3);
  EXPECT_EQ(count("int n = 2; for (int i = 0; i < p; i++) { int n = 5; n++; } " + kSet + "n);"), 2);
  expect_asked("int h(int m) { if (m > 0) return 3; return 2; }\nvoid f(int m) { " + kSet + "h(m)); }", "'m' (line 2)",
               {{"m", "1"}}, 3);
  expect_asked(
      "void f(int m) { int n = 1; switch (m) { case 1: n++; case 2: n++; break; default: n = 5; } " + kSet + "n); }",
      "'m' (line 1)", {{"m", "1"}}, 3);
  expect_asked("void f(int m) { int n = 1; while (m) { n++; if (n > 3) break; m--; } " + kSet + "n); }", "'m' (line 1)",
               {{"m", "2"}}, 3);
  expect_asked("int h(int m) { int n = 1; again: n++; if (m-- > 0) goto again; return n; }\nvoid f(int m) { " + kSet +
                   "h(m)); }",
               "", {{"m", "1"}}, 3);
  expect_asked("int h(int m) { for (int i = 0; i < 4; i++) { if (i == m) return i; } return 7; }\nvoid f(int m) { " +
                   kSet + "h(m)); }",
               "'m' (line 2)", {{"m", "2"}}, 2);
}

TEST(SourceCode, WhatIsNotModelledIsNotKnown) {
  const std::vector<std::pair<const char*, const char*>> cases{
      {"struct B { unsigned a : 2; };", "struct B b; b.a = 6; int n = b.a;"},
      {"union U { int i; float f; };", "union U u; u.f = 1; int n = u.i;"},
      {"", "volatile int n = 3;"},
      {"", "int n = 3; asm(\"nop\" : \"=r\"(n));"},
      {"", "int n = 3; int *q = &n; sscanf(s, \"%d\", q);"},
      {"void g(int &x);", "int n = 3; g(n);"},
      {"", "int n = 3; std::swap(n, m);"},
      {"struct V { int x; V(int a) : x(a + 1) {} };", "V v(2); int n = v.x;"},
      {"void t() { throw 3; }", "int n = 3; try { t(); n = 4; } catch (int e) { n = e; }"},
      {"", "float x = 3e9f; int n = (int) x;"},
      {"", "int n = 1 << 40;"},
      {"enum E { a, b };", "enum E e = a; int n = e - 1 < 0 ? 2 : 3;"},
      {"", "long l = 1; l <<= 33; int n = (int) (l >> 32);"},
      {"", "int a[2] = { 1, 2 }; a[p] = 3; int n = a[0];"},
      {"void g(int *q) { *q = 2; }", "int n = 3; int *q = p ? &n : 0; if (q) g(q);"}};
  for (const auto& [outside, body] : cases) {
    const auto found = parse(std::string(outside) + "\nvoid f(int p) { " + body + " " + kSet + "n); }", {{"f"}, {}});
    EXPECT_FALSE(found) << body;
  }
}

TEST(SourceCode, IncludedFilesAreRead) {
  const SourceInclude include = [](std::string_view name) -> std::optional<std::string> {
    if (name == "more.h") return "#define ONE 1\n#include \"types.h\"\n";
    if (name == "types.h") return "typedef unsigned char tiny;\nenum { TWO = ONE + 1 };\n";
    return std::nullopt;
  };
  const std::string text =
      "#include \"more.h\"\n#include \"missing.h\"\nvoid f() { tiny n = 256 + TWO; " + kSet + "n + ONE); }";
  const auto found = parse(text, {.functions = {}, .definitions = {}, .include = include});
  ASSERT_TRUE(found) << test::all_faults(found);
  EXPECT_EQ(found->num_general_combiners, 3);
  EXPECT_FALSE(parse(text));
  const SourceInclude itself = [](std::string_view) { return std::optional<std::string>("#include \"a.h\"\n"); };
  EXPECT_EQ(test::all_faults(parse("#include \"a.h\"\nvoid f() { " + kSet + "2); }",
                                   {.functions = {}, .definitions = {}, .include = itself})),
            "s:1:2: 'a.h' includes itself\n");
}

TEST(SourceCode, AFunctionThatDrawsHasSeveralPrograms) {
  const std::string text = "void f() { " + kSet +
                           "2); glDrawArrays(GL_TRIANGLES, 0, 3); glDrawArrays(GL_TRIANGLES, 0, 3); " + kSet +
                           "3); glDrawArrays(GL_TRIANGLES, 0, 3); }";
  EXPECT_EQ(test::all_faults(parse(text)),
            "s:1:1: draws with 2 programs; pick one with #1 to #2 behind the file's name\n");
  for (const std::size_t number : {1U, 2U}) {
    const auto found = parse(text, {.functions = {}, .definitions = {}, .program = number});
    ASSERT_TRUE(found) << test::all_faults(found);
    EXPECT_EQ(found->num_general_combiners, static_cast<int>(number) + 1);
  }
  EXPECT_EQ(test::all_faults(parse(text, {.functions = {}, .definitions = {}, .program = 3})),
            "s:1:1: has 2 programs, not 3\n");
}

}  // namespace
}  // namespace ninebit

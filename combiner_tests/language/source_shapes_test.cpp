// Shapes of data and of control flow in sources: pointers to structs, sizeof, designated initializers, unions, loops
// over elements, goto, line ends.
#include <gtest/gtest.h>

#include <string>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/source_code.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

Parsed<CombinerState> shape(const std::string& text, const SourceSelection& selection = {}) {
  return parse_source_code({text, "shape.c"}, selection, profiles::nv2a);
}

std::string set_input(const std::string& reg) {
  return "glFinalCombinerInputNV(GL_VARIABLE_D_NV, " + reg + ", GL_UNSIGNED_IDENTITY_NV, GL_RGB);";
}

std::string set_count(const std::string& number) {
  return "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, " + number + ");";
}

// The same state as after these calls.
void expect_calls(const std::string& text, const std::string& calls) {
  const auto found = shape(text);
  ASSERT_TRUE(found) << text << "\n" << test::all_faults(found);
  const auto expected = parse_gl_calls({calls, "calls"}, profiles::nv2a);
  ASSERT_TRUE(expected) << test::all_faults(expected);
  EXPECT_EQ(*found, *expected) << text;
}

void expect_fault_of(const std::string& text, const std::string& words) {
  const auto found = shape(text);
  ASSERT_FALSE(found) << text;
  EXPECT_TRUE(test::has(test::all_faults(found), words));
}

constexpr const char* kTable =
    "struct rc { GLenum c, d; GLenum in[2]; };\n"
    "static const struct rc t[] = {{GL_TEXTURE0_ARB, GL_SPARE0_NV, {GL_ZERO, GL_FOG}},\n"
    "                              {GL_TEXTURE1_ARB, GL_SPARE1_NV, {GL_FOG, GL_PRIMARY_COLOR_NV}}};\n";

TEST(SourceShapes, APointerToAStructOfATable) {
  const std::string table = kTable;
  for (const char* const first :
       {"const struct rc *p = t;", "const struct rc *p = &t[0];", "const struct rc *p; p = t;"}) {
    expect_calls(table + "void f() { " + first + set_input("p->d") + " }", set_input("GL_SPARE0_NV"));
    expect_calls(table + "void f() { " + first + set_input("(*p).d") + " }", set_input("GL_SPARE0_NV"));
    expect_calls(table + "void f() { " + first + set_input("p->in[1]") + " }", set_input("GL_FOG"));
    expect_calls(table + "void f() { " + first + set_input("p[1].d") + " }", set_input("GL_SPARE1_NV"));
  }
  for (const char* const second : {"const struct rc *p = t + 1;", "const struct rc *p = &t[1];"}) {
    expect_calls(table + "void f() { " + second + set_input("p->d") + " }", set_input("GL_SPARE1_NV"));
    expect_calls(table + "void f() { " + second + set_input("p->in[1]") + " }", set_input("GL_PRIMARY_COLOR_NV"));
  }
  expect_calls(table + "static void g(const struct rc *p) { " + set_input("p->d") + " }\nvoid f() { g(&t[1]); }",
               set_input("GL_SPARE1_NV"));
}

TEST(SourceShapes, SizeofCountsAllNumbers) {
  const std::string nested =
      "typedef struct { int a; float b[2]; } P;\n"
      "static const P t[] = {{1, {1, 2}}, {1, {1, 2}}, {2, {2, 2}}};\n";
  expect_calls(nested + "void f() { " + set_count("sizeof(t) / sizeof(t[0])") + " }", set_count("3"));
  expect_calls("void f() { float c[4]; " + set_count("sizeof(c) / sizeof(c[0])") + " }", set_count("4"));
}

TEST(SourceShapes, DesignatedInitializers) {
  const std::string designated =
      "struct D { int n; GLenum in[2]; GLenum out; };\n"
      "static const struct D d = {.out = GL_SPARE1_NV, .n = 2, .in = {GL_FOG, GL_ZERO}};\n"
      "static const GLenum e[] = {[1] = GL_SPARE1_NV, [0] = GL_FOG};\n";
  expect_calls(designated + "void f() { " + set_count("d.n") + set_input("d.out") + " }",
               set_count("2") + set_input("GL_SPARE1_NV"));
  expect_calls(designated + "void f() { " + set_input("d.in[0]") + " }", set_input("GL_FOG"));
  expect_calls(designated + "void f() { " + set_input("e[1]") + " }", set_input("GL_SPARE1_NV"));
}

TEST(SourceShapes, MembersOfAUnionAreNotGuessed) {
  const std::string text =
      "typedef union { float v[4]; struct { float r, g, b, a; }; } C;\n"
      "void f() { C c = {{.1f, .2f, .3f, 1}}; c.r = 1; glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, c.v); }";
  expect_fault_of(text, "'c.v'");
}

TEST(SourceShapes, LoopsOverElements) {
  expect_calls("void f() { for (int n : new int[] {1, 3}) " + set_count("n") + " }", set_count("3"));
  expect_calls("void f() { int all[] = {1, 2}; for (int n : all) { " + set_count("n") + " } }", set_count("2"));
  expect_calls("void f() { for (;;) { " + set_count("2") + " break; } }", set_count("2"));
  expect_fault_of("void f() { for (int n : list) { " + set_count("n") + " } }", "'list'");
}

TEST(SourceShapes, GotoIsFollowed) {
  expect_calls("void f() {\n goto end;\n " + set_count("2") + "\nend:\n " + set_count("3") + "\n}", set_count("3"));
  expect_calls("void f() { int i = 0; again: " + set_count("i + 1") + " if (++i < 3) goto again; }", set_count("3"));
  // Not into a block, nor back under a condition that is not known.
  expect_fault_of("void f() { goto in; { in: " + set_count("2") + " } }", "goto in leads into a block");
  const std::string endless = "int i = 1; again: " + set_count("i++") + " if (n) goto again;";
  expect_fault_of("void f(int n) { " + endless + " }", "'n'");
  expect_fault_of("void g(int n) { " + endless + " }\nvoid f() { g(count()); }", "'count()'");
  expect_fault_of(
      "void f(int n) {\n GLenum r = GL_FOG;\n if (n) goto out;\n r = GL_ZERO;\nout: " + set_input("r") + "\n}", "'n'");
  // One to the function's end, where something failed, is a return.
  expect_calls("int f() { " + set_count("2") + " if (0) goto end; " + set_count("3") + " goto end;\nend: return 1; }",
               set_count("3"));
}

TEST(SourceShapes, MarksAndLineEndsOfWindows) {
  expect_calls("\xEF\xBB\xBF#define REG GL_SPARE1_NV\r\nvoid f() { " + set_input("REG") + " }\r\n",
               set_input("GL_SPARE1_NV"));
  const std::string program =
      "const char *rc = \"!!RC1.0\\n\\\r\n{ rgb { spare0 = tex0; } }\\n\\\r\nout.rgb = spare0;\";\r\n"
      "void f() { nvparse(rc); }\r\n";
  const auto found = shape(program);
  ASSERT_TRUE(found) << test::all_faults(found);
  EXPECT_EQ(found->general[0].rgb.a.reg, Register::texture0);
}

}  // namespace
}  // namespace ninebit

// The faults of pixel shaders in assembly, with their places.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

void expect_shader_faults(const std::vector<test::TextAndFaults>& cases,
                          const HardwareProfile& profile = profiles::nv2a) {
  test::expect_faults(cases, [&](const std::string& text) { return parse_pixel_shader({text, ""}, profile); });
}

TEST(PixelShaderFaults, OfTheHeader) {
  expect_shader_faults({
      {"", "1:1: expected a version such as ps.1.1 or xps.1.1, but the text ends\n"},
      {"tex t0", "1:1: expected a version such as ps.1.1 or xps.1.1, found 'tex'\n"},
      {"; c\nps.1.7\n", "2:1: unknown version 'ps.1.7'; expected ps.1.0 to ps.1.4, or xps.1.1\n"},
      {"xps.1.3\n", "1:1: unknown version 'xps.1.3'; expected ps.1.0 to ps.1.4, or xps.1.1\n"},
      {"; c\nps.2.0\n", "2:1: this is a Direct3D pixel shader of version 2, which register combiners cannot run\n"},
      {"vs_1_1\n", "1:1: this is a Direct3D vertex shader, which register combiners cannot run\n"},
      {"ps.1.1\nmov r0, v0\nps.1.1", "3:1: expected one version, found 'ps.1.1'\n"},
      {"ps.1.1 /* mov r0, v0", "1:8: unterminated comment; expected */\n"},
  });
}

TEST(PixelShaderFaults, OfWords) {
  expect_shader_faults({
      {"ps.1.1\nmull r0, v0, v1\nmov r0, v0\n", "2:1: 'mull' is not an instruction of ps.1.1; did you mean 'mul'?\n"},
      {"ps.1.1\nmov_y2 r0, v0\n", "2:1: '_y2' is not a modifier of an instruction; expected _x2, _x4, _d2 or _sat\n"},
      {"ps.1.1\nmov_x2_d2 r0, v0\n", "2:1: 'mov_x2_d2' has two modifiers of one kind\n"},
      {"ps.1.1\nmov_x8 r0, v0\n", "2:1: ps.1.1 has no modifier _x8; it has _x2, _x4, _d2 and _sat\n"},
      {"ps.1.4\nmov_x8 r0, v0\n", "2:1: combiners cannot scale by _x8; they have _x2, _x4 and _d2\n"},
      {"ps.1.1\nmov_bias r0, v0\n", "2:1: ps.1.1 has no modifier _bias of an instruction; only xps.1.1 has it\n"},
      {"ps.1.1\ntex_x2 t0\nmov r0, v0\n", "2:1: 'tex' takes no modifier, found '_x2'\n"},
      {"ps.1.1\nmov r0, v0_bx3\n", "2:9: '_bx3' is not a modifier of a register; expected _bias, _bx2\n"},
      {"ps.1.1\nmov r0, v0_sat\n", "2:9: ps.1.1 has no modifier _sat of a register; only xps.1.1 has it\n"},
      {"ps.1.3\nmov r0, v0_x2\n", "2:9: ps.1.3 has no modifier _x2 of a register; only ps.1.4 has it\n"},
      {"ps.1.1\nmov r0, 1-v0_bx2\n", "2:9: 1-x takes no other modifier; found '_bx2'\n"},
      {"xps.1.1\nmov r0, zeroo\n", "2:9: 'zeroo' is not a register; did you mean 'zero'?\n"},
      {"ps.1.1\nmov r0, zero\n", "2:9: ps.1.1 has no register 'zero'; only xps.1.1 has it\n"},
      {"ps.1.1\nmov r2, v0\n", "2:5: ps.1.1 has only r0 to r1, found 'r2'\n"},
      {"ps.1.1\nmov r0, c[9].a\n", "2:9: ps.1.1 has only c0 to c7, found 'c'\n"},
      {"xps.1.1\n#include \"n.h\"\nmov r0, c[FADE]\n", "3:11: expected the number of a register, found 'FADE'\n"},
      {"xps.1.1\n#include \"n.h\"\nLAST\n",
       "3:1: 'LAST' is not an instruction of xps.1.1; an included file, which was not read, may define it\n"},
      {"ps.1.1\ntex t0\ntexbem t1, t12\nmov r0, t0\n", "3:12: ps.1.1 has only t0 to t3, found 't12'\n"},
      {"ps.1.1\ntex t0\ntexm3x3spec t3, t0, c12\nmov r0, t0\n", "3:21: ps.1.1 has only c0 to c7, found 'c12'\n"},
      {"ps.1.1\ntex t0\ntexm3x3spec t3, t0, c8\nmov r0, t0\n", "3:21: ps.1.1 has only c0 to c7, found 'c8'\n"},
      {"ps.1.1\nmov c0, v0\n", "2:5: ps.1.1 does not write 'c0'; it writes r and t registers\n"},
      {"ps.1.1\nmov v0, v1\nmov r0, v0", "2:5: ps.1.1 does not write 'v0'; it writes r and t registers\n"},
      {"ps.1.1\nmov r0_sat, v0\n",
       "2:5: a register that is written has no modifier, found '_sat'; modifiers of the result follow the "
       "instruction's "
       "name, as in add_sat\n"},
      {"ps.1.1\nmov r0.r, v0\n",
       "2:5: '.r': combiners write red, green and blue together; expected .rgb, .a or nothing\n"},
      {"ps.1.4\nmov r0, v0.r\n", "2:9: 'v0': combiners do not read red or green alone; expected .rgb, .a or .b\n"},
      {"ps.1.1\nmov r0, v0.bgr\n", "2:9: '.bgr' are not components that a combiner reads; expected .rgb, .a or .b\n"},
      {"ps.1.1\ndp4 r0, v0, v1\n", "2:1: ps.1.1 has no instruction 'dp4'; it begins with ps.1.2\n"},
      {"ps.1.4\ntex t0\nmov r0, v0", "2:1: ps.1.4 has no instruction 'tex'; its last version is ps.1.3\n"},
      {"ps.1.1\nxmma r0, r1, r1, v0, v0, v0, v0\n", "2:1: ps.1.1 has no instruction 'xmma'; only xps.1.1 has it\n"},
  });
}

TEST(PixelShaderFaults, OfTheGrammar) {
  expect_shader_faults({
      {"ps.1.1\nmov r0 v0\n", "2:8: expected ',', found 'v0'\n"},
      {"ps.1.1\nmov r0,\n", "3:1: expected a register, but the text ends\n"},
      {"ps.1.1\nmov r0, 2-v0\n", "2:9: expected a register, found '2'\n"},
      {"ps.1.1\nmov r0, 1+v0\n", "2:10: expected '-' after 1, as in 1-r0, found '+'\n"},
      {"ps.1.1\nmov r0, v0, v1\n", "2:11: expected the next instruction after the 2 arguments of mov, found ','\n"},
      {"ps.1.1\n= r0\nmov r0, v0", "2:1: expected an instruction, found '='\n"},
      {"ps.1.1\ndef c0, 1, x, 0, 0\nmov r0, c0", "2:12: expected a number, found 'x'\n"},
      {"ps.1.1\ndef c0, 1, 1e, 0, 0\nmov r0, c0", "2:12: '1e' is not a number\n"},
      {"ps.1.1\ndef r0, 1, 1, 0, 0\nmov r0, v0", "2:1: expected a constant such as c0 after def, found 'r0'\n"},
      {"ps.1.1\ndef c0, 1, 1, 0, 0\ndef c0, 1, 1, 0, 0\nmov r0, c0", "3:5: 'c0' is defined twice\n"},
      {"ps.1.1\n#defin X 1\nmov r0, v0\n", "2:2: '#defin' is not a line of the preprocessor; did you mean 'define'?\n"},
      {"ps.1.1\n#define F(x) x\nmov r0, F(v0)\n", ""},
      {"ps.1.1\n#if 1\nmov r0, v0\n", "2:1: unterminated condition; expected #endif\n"},
      {"ps.1.1\n#endif\nmov r0, v0\n", "2:1: '#endif' without #if\n"},
      {"ps.1.1\n#if 1\nmov r0, v0\n#else\n#elif 1\n#endif\n", "5:1: '#elif' after #else\n"},
      {"ps.1.1\n#if 1\nmov r0, v0\n#else\n#else\n#endif\n", "5:1: '#else' after #else\n"},
      {"ps.1.1\n#ifndef\n#endif\nmov r0, v0\n", "2:1: expected a name after #ifndef\n"},
      {"ps.1.1\n#undef\nmov r0, v0\n", "2:2: expected a name after #undef\n"},
      {"ps.1.1\n#define M 1\n#if M = 1\n#endif\nmov r0, v0\n", "3:1: #if: expected an operator; found '='\n"},
      {"ps.1.1\n#if\n#endif\nmov r0, v0\n",
       "2:1: #if: expected a number, a name or defined(NAME); found the end of the line\n"},
      {"ps.1.1\n#define L " + std::string(600'000, '0') + "\n#if L + L\n#endif\nmov r0, v0\n",
       "3:1: #if: the condition is longer than 1 MiB with names replaced\n"},
      {"ps.1.1\n#if 1 / 0\n#endif\nmov r0, v0\n", "2:1: #if: 1 / 0 has no value\n"},
      {"ps.1.1\nmvo r0, v0\nmov r0, v9\nmov r0, v0, \n",
       "2:1: 'mvo' is not an instruction of ps.1.1; did you mean 'mov'?\n3:9: ps.1.1 has only v0 to v1, found 'v9'\n"
       "4:11: expected the next instruction after the 2 arguments of mov, found ','\n"},
  });
}

TEST(PixelShaderFaults, OfDirect3DsRules) {
  expect_shader_faults({
      {"ps.1.1\nmov r1, v0\n", "2:1: no instruction writes r0, which is the result of ps.1.1\n"},
      {"ps.1.1\nmov r0, r1\n", "2:9: 'r1' is read before it is written\n"},
      {"ps.1.1\nmov r0.rgb, v0\nmov r0, r0\n", "3:9: 'r0' is read where only its red, green and blue were written\n"},
      {"ps.1.1\nmov r0, t1\n", "2:9: 't1' is read, but no texture instruction before loads it, such as tex t1\n"},
      {"ps.1.1\nmov r0, v0\ntex t0\n", "3:1: texture instructions come before arithmetic ones in ps.1.1\n"},
      {"ps.1.1\ntex t0\ntexbem t1, t0\nadd r0, t1, t0\n",
       "4:13: 't0' was read by texbem; ps.1.1 lets no other instruction read it\n"},
      {"ps.1.1\nmov r0.rgb, v0\n+mul r0, v0, v1\n",
       "3:2: of two instructions that '+' joins, one writes .rgb and one writes .a; both write .rgb\n"},
      {"ps.1.1\n+mov r0, v0\n", "2:2: '+' joins two arithmetic instructions; expected one before it that has no '+'\n"},
      {"ps.1.1\ntex t0\ntex t1\ntex t2\nmad r0, t0, t1, t2\n",
       "5:1: an instruction of ps.1.1 reads at most 2 t registers, found 3\n"},
      {"ps.1.4\nmov r0, t0\n",
       "2:9: arithmetic instructions of ps.1.4 do not read t registers; load 't0' with texld or texcrd\n"},
      {"ps.1.1\nmov r0, v0\nmov r0, v0\nmov r0, v0\nmov r0, v0\nmov r0, v0\nmov r0, v0\nmov r0, v0\nmov r0, v0\n"
       "mov r0, v0\n",
       "10:1: ps.1.1 has at most 8 arithmetic instructions\n"},
      {"xps.1.1\nmov r0, v0\nxfc zero, zero, zero, r0, zero, zero, r0.a\nmov r0, v0\n",
       "4:1: xfc must be the last instruction\n"},
  });
}

TEST(PixelShaderFaults, OfWhatCombinersDoNotHave) {
  expect_shader_faults({
      {"ps.1.1\nmad r0, c0, c1, c2\n",
       "2:1: an instruction of ps.1.1 reads at most 2 constants, found 3\n"
       "2:17: 'c2' is a third constant: a general combiner reads two\n"},
      {"xps.1.1\nmov r0, sum\n", "2:9: GL_INVALID_ENUM: 'sum' can be read by xfc alone\n"},
      {"xps.1.1\nmov r0, fog\n", "2:9: GL_INVALID_OPERATION: fog's alpha can be read by xfc alone\n"},
      {"xps.1.1\nxmma r0, r0, discard, v0, v0, v0, v0\n",
       "2:1: GL_INVALID_OPERATION: 'xmma' writes one register twice\n"},
      {"xps.1.1\nxfc sum, zero, v0, prod, prod, zero, r0_bx2\n",
       "2:5: GL_INVALID_OPERATION: 'sum' can be read as B, C or D of xfc alone\n"
       "2:26: GL_INVALID_OPERATION: 'prod' can be read as A, B, C or D of xfc alone\n"
       "2:38: registers of xfc take no modifier but 1-x, found 'r0_bx2'\n"},
      {"ps.1.1\nmov r0, v0.b\n", "2:9: 'v0'.b: combiners read blue alone only where .a is written\n"},
      {"ps.1.1\ndef c0, 1, -1, 0, 0\nmov r0, c0_bias\n",
       "3:9: 'c0_bias' is below 0, where combiners can only read it or its negative\n"},
      {"ps.1.1\ndef c0, 1, -1, 0, 0\nlrp r0, c0, v0, v1\n",
       "3:9: the weight of lrp, 'c0', has values below 0, which lrp reads as 0\n"},
      {"ps.1.1\nmov_sat r0, -v0\nmul r0, -r0, 1-v0\n",
       "3:1: 'mul' negates a register that was saturated, and combiners cannot; expected it without '-'\n"},
      {"ps.1.1\nlrp r0, v0_bx2, v0, v1\n", "2:9: the weight of lrp, 'v0_bx2', takes no modifier but 1-x\n"},
      {"ps.1.1\nmov r0, v0\ncnd r0, v0.a, v0, v1\n", "3:9: cnd tests r0.a in ps.1.1, found 'v0'\n"},
      {"ps.1.2\nmov r1, v0\ncmp r0, r1, v0, v1\n",
       "3:9: 'cmp' tests each component of 'r1'; the mux of combiners tests spare0's alpha alone: expected one "
       "component, such as r1.a\n"},
      {"ps.1.2\nmov r0, v0\ncmp r0.rgb, r0.a, v0, v1\n",
       "3:1: 'cmp' needs spare0's alpha for its test, which holds a value that is still read; expected a test of "
       "r0.a\n"},
      {"ps.1.4\ntexcrd r0.rgb, t0\nadd r0.rgb, r0, v0\nphase\ntexld r1, r0\nmov r0, r1\n",
       "5:1: 'texld' reads a texture at computed coordinates: combiners run after all textures are read\n"},
      {"ps.1.4\ntexld r4, t0\nmov r0, r4\n",
       "2:7: 'r4' loads a fifth or sixth texture; combiners have four, for r0 to r3\n"},
      {"ps.1.4\nadd r0, v0_x2, v1\n",
       "2:1: 'add' adds a register with _x2 to one without it; combiners scale only the result\n"},
  });
  expect_shader_faults(
      {
          {"ps.1.1\ntex t2\nmov r0, t2\n",
           "3:9: GL_INVALID_ENUM: 't2' is beyond the 2 texture units of profile geforce2\n"},
          {"ps.1.1\ndef c0, 1, -1, 0, 0\ndef c1, 1, 1, 1, 1\nmul r0, c0, c1\n",
           "4:13: 'c1' is a third constant: a general combiner reads two, and with profile geforce2 all read the same "
           "two\n"},
          {"ps.1.1\ndef c0, 1, -1, 0, 0\ndef c1, 1, -1, 1, 1\nmul r0, c0, c1\n",
           "4:13: 'c1' has values below 0 and above 0, which takes two constants of the combiners, which read no more "
           "than "
           "two; expected (x + 1) / 2, read as c1_bx2\n"},
          {"ps.1.1\ndef c0, 1, -1, 0, 0\ntex t0\ntex t1\nmov r1, v0\nadd r1, r1, v1\nmad r0, t0, t1, c0\n",
           "7:17: 'c0' has values below 0 and above 0, which takes a register that the shader does not use, and there "
           "is "
           "none; expected (x + 1) / 2, read as c0_bx2\n"},
          {"ps.1.1\nmul r0, v0, c0\nmul r0, r0, c1\nmul r0, r0, c2\n",
           "4:1: GL_INVALID_VALUE: too many general combiners; profile geforce2 has 2, and this instruction needs "
           "another\n4:13: 'c2' is a third constant: a general combiner reads two, and with profile geforce2 all read "
           "the "
           "same two\n"},
      },
      profiles::geforce2);
}

TEST(PixelShaderFaults, HostileTextsEnd) {
  std::string names = "xps.1.1\n#define a0 \n";
  for (int i = 1; i < 40; ++i) {
    const std::string before = " a" + std::to_string(i - 1);
    names += "#define a" + std::to_string(i) + before + before + "\n";
  }
  const auto doubled = parse_pixel_shader({names + "a31\nmov r0, v0\n", ""}, profiles::nv2a);
  ASSERT_FALSE(doubled);
  EXPECT_EQ(doubled.faults().front().message, "the text is longer than 1048576 words");
  std::string many = "ps.1.1\n";
  for (int i = 0; i < 5000; ++i) many += "mov r0, v" + std::to_string(2 + i % 7) + "\n";
  EXPECT_EQ(parse_pixel_shader({many, ""}, profiles::nv2a).faults().size(), kMaxTextFaults);
  std::string deep = "ps.1.1\n";
  for (int i = 0; i < 40; ++i) deep += "#if 1\n";
  EXPECT_EQ(parse_pixel_shader({deep + "mov r0, v0\n", ""}, profiles::nv2a).faults().back().message,
            "unterminated condition; expected #endif");
}

// Limits of instructions, as Direct3D counts and reads them.
TEST(PixelShaderFaults, LimitsOfInstructions) {
  const std::string loads = "\ntex t0\ntex t1\ntex t2\n";
  expect_shader_faults({
      {"ps.1.1" + loads + "mad r0, t0, t1, t2\n",
       "5:1: an instruction of ps.1.1 reads at most 2 t registers, found 3\n"},
      {"ps.1.2" + loads + "mad r0, t0, t1, t2\n", ""},
      {"ps.1.3" + loads + "mad r0, t0, t1, t2\n", ""},
      // The second of a pair does not see what the first one writes.
      {"ps.1.1\nmov r0.rgb, v0\n+mov r0.a, r0.b\n", "3:12: 'r0' is read before it is written\n"},
  });
  // ps.1.4 counts its instructions in each phase.
  std::string five;
  for (int i = 0; i < 5; ++i) five += "mul r0, r0, v0\n";
  const std::string phases = "ps.1.4\ntexld r0, t0\n" + five + "phase\n" + five;
  const auto parsed = parse_pixel_shader({phases, ""}, profiles::nv2a);
  ASSERT_EQ(parsed.faults().size(), 1U) << test::all_faults(parsed);
  EXPECT_TRUE(test::has(parsed.faults()[0].message, "too many general combiners"));
}

// A body that a condition without a value leaves out would vanish without a word.
TEST(PixelShaderFaults, WhatAConditionNeedsIsAskedFor) {
  const std::string both = "ps.1.1\ntex t0\n#if MODE == 0\nmov r0, t0\n#endif\n#if MODE != 0\nmul r0, t0, v0\n#endif\n";
  EXPECT_EQ(test::all_faults(parse_pixel_shader({both, ""}, profiles::nv2a)),
            "3:1: 'MODE' is not defined, and #if MODE == 0 depends on it; give it as in --define 'MODE=…', or by "
            "#define\n");
  // Text that is read in spite of a fault hides no other fault.
  const std::string after = "ps.1.1\n#if MODE > 1\nmov r0, t0\n#endif\nmov r0, v0\n";
  EXPECT_EQ(parse_pixel_shader({after, ""}, profiles::nv2a).faults().size(), 1U);
  const std::string chained = "ps.1.1\n#if 0\n#elif X\nmov r0, v1\n#endif\nmov r0, v0\n";
  EXPECT_EQ(test::all_faults(parse_pixel_shader({chained, ""}, profiles::nv2a)),
            "3:1: 'X' is not defined, and #elif X depends on it; give it as in --define 'X=…', or by #define\n");
  for (const char* condition : {"#if 1\n#elif X\n", "#if defined(X) && X > 2\n#else\n", "#ifdef X\n#else\n",
                                "#if 0\n#if X\n#endif\n#else\n", "#if 1 || X\n", "#if 1 ? 2 : X\n"}) {
    const auto parsed =
        parse_pixel_shader({"ps.1.1\n" + std::string(condition) + "mov r0, v0\n#endif\n", ""}, profiles::nv2a);
    EXPECT_TRUE(parsed) << condition << test::all_faults(parsed);
  }
}

}  // namespace
}  // namespace ninebit

// The faults of programs in !!RC1.0, with their places.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/language/rc10.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

using Rc10Fault = test::TextAndFaults;

// On the line after the header, before `out.rgb = spare0;`.
Rc10Fault general(const std::string& text, const char* faults) {
  return {"!!RC1.0\n" + text + "\nout.rgb = spare0;", faults};
}
Rc10Fault rgb(const std::string& statements, const char* faults) {
  return general("{rgb{\n" + statements + "\n}}", faults);
}
Rc10Fault alpha(const std::string& statements, const char* faults) {
  return general("{alpha{\n" + statements + "\n}}", faults);
}
Rc10Fault last(const std::string& statements, const char* faults) {
  return {"!!RC1.0\n" + statements, faults};
}

void expect(const std::vector<Rc10Fault>& cases, const HardwareProfile& profile = profiles::nv2a) {
  test::expect_faults(cases, [&](const std::string& text) { return parse_rc10({text, ""}, profile); });
}

TEST(Rc10Faults, OfTheWholeProgram) {
  expect({
      {"", "1:1: expected !!RC1.0 at the beginning; only blanks and comments may come before it\n"},
      {"; !!RC1.0 out.a = zero;",
       "1:1: expected !!RC1.0 at the beginning; only blanks and comments may come before it\n"},
      {"// a comment\n!!rc1.0 out.a = zero;", "2:1: unknown part '!!rc1.0'; expected !!RC1.0 or !!TS1.0\n"},
      {"!!TS1.0\ntexture_2d();\n", "1:1: this is an NV texture shader, which register combiners cannot run\n"},
      {"!!ARBfp1.0\nEND\n", "1:1: this is an ARB fragment program, which register combiners cannot run\n"},
      {"!!TS1.0\ntexture_2d();\n!!RC1.0", "3:8: expected out.rgb or out.a, but the text ends\n"},
      {"!!RC1.0 out.a = zero; // !!XXX\n  !!XXX", "2:3: unknown part '!!XXX'; expected !!RC1.0 or !!TS1.0\n"},
      {"/* !!RC1.0 out.a = zero;", "1:1: unterminated comment; expected */\n"},
      {"!!RC1.0", "1:8: expected out.rgb or out.a, but the text ends\n"},
      {"!!RC1.0 {rgb{spare0=tex0;}}\n", "2:1: expected out.rgb or out.a, but the text ends\n"},
      {"!!RC1.0 clamp_color_sum();", "1:27: expected out.rgb or out.a, but the text ends\n"},
      {"!!RC1.0 out.a = zero; /* ", "1:23: unterminated comment; expected */\n"},
      {"!!RC1.0 { rgb { /* ", "1:17: unterminated comment; expected */\n"},
  });
  expect({
      general("}", "2:1: expected a constant, a general combiner in braces, or out.rgb or out.a, found '}'\n"),
      general("}}}}", "2:1: expected a constant, a general combiner in braces, or out.rgb or out.a, found '}'\n"),
      general("hello;", "2:1: expected a constant, a general combiner in braces, or out.rgb or out.a, found 'hello'\n"),
      general("out.a = zero; {rgb{spare0=tex0;}}", "2:15: general combiners must come before the final combiner\n"),
      last("out.a = zero; const0=(0,0,0,0);", "2:15: constants must come before the general combiners\n"),
      last("out.a = zero; }", "2:15: expected a statement of the final combiner, found '}'\n"),
  });
}

TEST(Rc10Faults, OfConstants) {
  expect({
      general("const0=(0,0,0,0); const0=(1,1,1,1);", "2:19: the global constant 'const0' is set twice\n"),
      general("{const1=(0,0,0,0); const1=(1,1,1,1); rgb{spare0=tex0;}}",
              "2:20: the local constant 'const1' is set twice\n"),
      general("{rgb{spare0=tex0;} const1=(0,0,0,0);}",
              "2:20: a general combiner's constants must come before its portions\n"),
      general("const0.rgb = (0,0,0,0);",
              "2:1: expected a constant, a general combiner in braces, or out.rgb or out.a, found 'const0.rgb'\n"),
      general("const0 = (0,0,0);", "2:16: expected ',', found ')'\n"),
      general("const0 = (0,0,0,0,0);", "2:18: expected ')', found ','\n"),
      general("const0 = (0,0,0,1e5);", "2:17: expected a number without exponent, found '1e5'\n"),
      general("const0 = (1.0f,0,0,0);", "2:11: expected a number without exponent, found '1.0f'\n"),
      general("const0 = (- 1,0,0,0);", "2:11: expected a number without exponent, found '-'\n"),
      general("const0 = (., 0,0,0);", "2:11: expected a number without exponent, found '.'\n"),
  });
  expect({general("{const1=(0,0,0,0); rgb{spare0=tex0;}}",
                  "2:2: GL_INVALID_ENUM: profile geforce2 has no per-stage constants "
                  "(NV_register_combiners2)\n")},
         profiles::geforce2);
}

TEST(Rc10Faults, OfStages) {
  expect({
      general("{}", "2:2: expected an rgb or alpha portion, found '}'\n"),
      general("{rgb{}}", "2:6: expected a statement, found '}'\n"),
      general("{rgb{spare0=tex0;} rgb{spare1=tex0;}}", "2:20: the general combiner already has an rgb portion\n"),
      general("{spare0=tex0;}",
              "2:2: expected rgb, alpha or a constant, found 'spare0'\n"
              "2:14: expected an rgb or alpha portion, found '}'\n"),
      general("{rgb spare0=tex0;}", "2:6: expected '{', found 'spare0'\n"),
      {"!!RC1.0 {rgb{spare0=tex0;} out.a=zero;",
       "1:28: expected rgb, alpha or a constant, found 'out.a'\n"
       "1:39: expected '}', but the text ends\n"
       "1:39: expected out.rgb or out.a, but the text ends\n"},
  });
  expect({general("{rgb{spare0=tex0;}}{rgb{spare0=tex0;}}{rgb{x}}{rgb{y}}",
                  "2:39: GL_INVALID_VALUE: too many general combiners; profile geforce2 has 2\n")},
         profiles::geforce2);
  expect({rgb("spare0 = tex1 * tex2;\ntex3 = tex0;",
              "3:17: GL_INVALID_ENUM: 'tex2' is beyond the 2 texture units of profile geforce2\n"
              "4:1: GL_INVALID_ENUM: 'tex3' is beyond the 2 texture units of profile geforce2\n"),
          last("out.a = tex2;", "2:9: GL_INVALID_ENUM: 'tex2' is beyond the 2 texture units of profile geforce2\n")},
         profiles::geforce2);
}

TEST(Rc10Faults, OfStatements) {
  expect({
      rgb("spare0 = tex0\nspare1 = tex1;", "4:1: expected ';', found 'spare1'\n"),
      rgb("spare0 = tex0", "4:1: expected ';', found '}'\n"),
      rgb("spare0 tex0;", "3:8: expected '=', found 'tex0'\n"),
      rgb("spare0 = ;", "3:10: expected a register to read, found ';'\n"),
      rgb("spare0 = tex0 + tex1;", "3:15: expected ';', found '+'\n"),
      rgb("spare0 = tex0 * ;\nspare1 = tex4;\ncol0 = sum();",
          "3:17: expected a register to read, found ';'\n"
          "4:10: expected a register to read, found 'tex4'; did you mean 'tex0'?\n"
          "5:8: 'sum' must come after two products; 'discard = zero;' can be one\n"),
      rgb("spare0 = tex0.r;", "3:15: expected a register to read, found 'r'\n"),
      rgb("spare0 = tex0.alpha;", "3:10: expected a register to read, found 'tex0.alpha'; did you mean 'tex0.a'?\n"),
      rgb("spare0 = tex0.rgba;", "3:10: expected a register to read, found 'tex0.rgba'\n"),
      rgb("spare0 = color_sum;", "3:10: GL_INVALID_ENUM: 'color_sum' can be read by the final combiner alone\n"),
      rgb("final_product = tex0;", "3:1: GL_INVALID_ENUM: 'final_product' belongs to the final combiner\n"),
      rgb("spare0 = -unsigned(tex0);",
          "3:11: 'unsigned' cannot be negated; expand, half_bias and plain registers can\n"),
      rgb("spare0 = expand(-tex0);", "3:17: expected a register to read, found '-'\n"),
      rgb("spare0 = expand tex0;", "3:17: expected '(', found 'tex0'\n"),
      rgb("spare0 = tex0 * 0.5;", "3:17: expected a register to read, found '0.5'\n"),
      rgb("spare0 = tex0 @ tex1;", "3:15: expected ';', found '@'\n"),
      rgb("spare0 = tex0; scale_by_two(); spare1 = tex1;",
          "3:32: scale and bias must be the last statement of a portion, and there can be only one\n"),
      rgb("spare0 = tex0; scale_by_two(); scale_by_four();",
          "3:32: scale and bias must be the last statement of a portion, and there can be only one\n"),
      rgb("spare0 = tex0; scale_by_two;", "3:28: expected '(', found ';'\n"),
      rgb("spare0 = tex0; scale_by_eight();",
          "3:16: expected a register to write, or a scale, found 'scale_by_eight'\n"),
      rgb("spare0 = tex0; spare1 = tex0; col0 = tex0;",
          "3:38: a portion has at most two products, then sum() or mux()\n"),
      rgb("spare0 = sum();", "3:10: 'sum' must come after two products; 'discard = zero;' can be one\n"),
      rgb("spare0 = tex0; spare1 = mux();", "3:25: 'mux' must come after two products; 'discard = zero;' can be one\n"),
      rgb("spare0 = tex0 . tex1; spare1 = tex0; col0 = sum();",
          "3:45: !!RC1.0 does not allow sum() after a dot product\n"),
      rgb("spare0 = tex0; spare1 = tex0 . tex1; col0 = mux();",
          "3:45: !!RC1.0 does not allow mux() after a dot product\n"),
      rgb("spare0 = tex0; spare1 = tex0; col0 = sum(); col1 = mux();",
          "3:52: a portion has at most one sum() or mux()\n"),
      rgb("spare0 = tex0; discard = tex0; col0 = sum(); col1 = tex0;",
          "3:53: sum() or mux() must be the last output of a portion\n"),
  });
}

TEST(Rc10Faults, OfRegistersInGeneralCombiners) {
  expect({
      rgb("const0 = tex0; zero = tex0;",
          "3:1: GL_INVALID_ENUM: 'const0' is read-only\n3:16: GL_INVALID_ENUM: 'zero' is read-only\n"),
      rgb("one = tex0; fog = tex0;",
          "3:1: GL_INVALID_ENUM: 'one' is read-only\n3:13: GL_INVALID_ENUM: 'fog' is read-only\n"),
      rgb("spare0 = tex0; spare0.rgb = tex1;",
          "3:16: GL_INVALID_OPERATION: 'spare0.rgb' is written twice in one portion\n"),
      rgb("spare0 = tex0; discard = tex1; spare0 = sum();",
          "3:32: GL_INVALID_OPERATION: 'spare0' is written twice in one portion\n"),
      rgb("discard = tex0; discard = tex1; discard = sum();", ""),
      rgb("spare0 = discard;", "3:10: GL_INVALID_ENUM: discard cannot be read\n"),
      rgb("spare0 = tex0.b * col0.a;",
          "3:10: GL_INVALID_OPERATION: 'tex0.b' cannot be used in an rgb portion; expected .rgb or .a\n"),
      rgb("spare0.b = tex0;",  // GL is not told the suffix of what is written
          "3:1: 'spare0.b' cannot be used in an rgb portion; expected .rgb or .a\n"),
      rgb("spare0 = fog.a;", "3:10: GL_INVALID_OPERATION: fog's alpha can be read by the final combiner alone\n"),
      alpha("spare0 = fog;", "3:10: GL_INVALID_OPERATION: fog's alpha can be read by the final combiner alone\n"),
      alpha("spare0 = tex0.rgb;",
            "3:10: GL_INVALID_OPERATION: 'tex0.rgb' cannot be used in an alpha portion; expected .a or .b\n"),
      alpha("spare0.rgb = tex0;", "3:1: 'spare0.rgb' cannot be used in an alpha portion; expected .a or .b\n"),
      alpha("spare0 = tex0 . tex1;", "3:15: GL_INVALID_VALUE: an alpha portion has no dot product\n"),
  });
}

TEST(Rc10Faults, OfTheFinalCombiner) {
  expect({
      last("out.a = zero; out.a = one;", "2:15: 'out.a' appears twice\n"),
      last("out.rgb = zero; out.rgb = one;", "2:17: 'out.rgb' appears twice\n"),
      last("clamp_color_sum(); clamp_color_sum(); out.a = zero;", "2:20: 'clamp_color_sum' appears twice\n"),
      last("out.a = zero; final_product = tex0 * tex1;", "2:15: 'final_product' must come before out.rgb and out.a\n"),
      last("out.b = zero;",
           "2:1: expected a constant, a general combiner in braces, or out.rgb or out.a, found 'out.b'; did you mean "
           "'out.a'?\n"
           "2:14: expected out.rgb or out.a, but the text ends\n"),
      last("out.rgb = -tex0;",
           "2:11: GL_INVALID_ENUM: the final combiner has only the mappings unsigned and unsigned_invert, not '-'\n"),
      last("out.a = expand(tex0);",
           "2:9: GL_INVALID_ENUM: the final combiner has only the mappings unsigned and unsigned_invert, not "
           "'expand'\n"),
      last("out.rgb = tex0 + tex1 * tex2;", "2:23: expected ';', found '*'\n"),
      last("out.rgb = tex0 * tex1 * tex2;", "2:23: expected ';', found '*'\n"),
      last("out.rgb = lerp(tex0, tex1);", "2:26: expected ',', found ')'\n"),
      last("out.rgb = lerp(tex0, tex1, tex2) * col0;", "2:34: expected ';', found '*'\n"),
      last("out.rgb = discard; out.a = discard;",
           "2:11: GL_INVALID_ENUM: 'discard' cannot be read\n2:28: GL_INVALID_ENUM: 'discard' cannot be read\n"),
      last("out.rgb = tex0.b;",
           "2:11: GL_INVALID_OPERATION: 'tex0.b' cannot be used in out.rgb; expected .rgb or .a\n"),
      last("out.a = tex0.rgb;", "2:9: GL_INVALID_OPERATION: 'tex0.rgb' cannot be used in out.a; expected .a or .b\n"),
      last("out.a = color_sum;", "2:9: GL_INVALID_OPERATION: 'color_sum' has no alpha, which out.a needs\n"),
      last("final_product = tex0 * tex1; out.a = final_product;",
           "2:38: GL_INVALID_OPERATION: 'final_product' has no alpha, which out.a needs\n"),
      last("final_product = color_sum * tex0.b; out.a = zero;",
           "2:17: GL_INVALID_OPERATION: 'color_sum' is not a valid input of final_product\n"
           "2:29: GL_INVALID_OPERATION: 'tex0.b' cannot be used in final_product; expected .rgb or .a\n"),
      last("final_product = final_product * discard; out.a = zero;",
           "2:17: GL_INVALID_OPERATION: 'final_product' is not a valid input of final_product\n2:33: GL_INVALID_ENUM: "
           "'discard' "
           "cannot be read\n"),
      last("final_product = tex0; out.a = zero;", "2:21: expected '*', found ';'\n"),
      last("out.rgb = tex0 * final_product;", "2:18: final_product is used but not set\n"),
      last("out.rgb = lerp(color_sum, tex0, tex1);",
           "2:16: GL_INVALID_OPERATION: color_sum can be neither the weight of lerp nor both factors of a product\n"),
      last("out.rgb = color_sum * color_sum;",
           "2:11: GL_INVALID_OPERATION: color_sum can be neither the weight of lerp nor both factors of a product\n"),
  });
}

TEST(Rc10Faults, HaveAnEnd) {
  std::string text = "!!RC1.0\n";
  for (int i = 0; i < 1000; ++i) text += "hello;\n";
  const auto result = parse_rc10({text, ""}, profiles::geforce2);
  ASSERT_EQ(result.faults().size(), kMaxTextFaults);
  EXPECT_EQ(result.faults().back().line, 101);
}

TEST(Rc10Faults, AreFewForMegabytesOfNonsense) {
  if (ninebit::test::kSanitized || ninebit::test::kCoverage) GTEST_SKIP() << "shows how long a text takes";
  for (const char c : {'(', '{', '}', '+', '\0', '\xFF', '0', '.', 'x', '!', ','}) {
    for (const char* const before :
         {"!!RC1.0 ", "!!RC1.0 {rgb{spare0 = ", "!!RC1.0 out.rgb = tex0 * ", "!!RC1.0 const0 = ("}) {
      // One has all bytes that a text may have.
      const bool is_largest = c == '{' && before == std::string("!!RC1.0 ");
      std::string text = before;
      text.resize(is_largest ? kMaxSourceBytes : kMaxSourceBytes / 64, c);
      const auto result = parse_rc10({text, ""}, profiles::geforce2);
      EXPECT_GE(result.faults().size(), 1U) << before << c;
      EXPECT_LE(result.faults().size(), 4U) << before << c;
    }
  }
  expect({{std::string(kMaxSourceBytes + 1, '{'), "1:1: the text has 16777217 bytes; the limit is 16777216\n"}});
}

}  // namespace
}  // namespace ninebit

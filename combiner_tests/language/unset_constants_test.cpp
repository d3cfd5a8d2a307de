// Constants that a program reads and does not set, in every form.
#include <gtest/gtest.h>

#include "combiner_tests/support/has.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/json.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_code.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

using Names = std::vector<std::string>;

// The names of the constants that are not set; {"refused"} for a text that is.
Names unset(const Parsed<CombinerState>& parsed, const HardwareProfile& profile = profiles::geforce2) {
  if (!parsed) return {"refused: " + parsed.error().text()};
  Names names;
  for (const ConstantName name : unset_constants(normalize(*parsed, profile))) names.push_back(name_of_constant(name));
  return names;
}

CombinerState rc10_of(const std::string& body, const HardwareProfile& profile = profiles::geforce2) {
  return parse_rc10({"!!RC1.0\n" + body, ""}, profile).value();
}

const std::string kReadsBoth = "{ rgb { spare0 = tex0 * const0; } }\nout.rgb = spare0 * const1;\nout.a = zero;\n";

TEST(UnsetConstants, EachFormKnowsWhatItSets) {
  const auto rc10 = [](const std::string& body) {
    return unset(parse_rc10({"!!RC1.0\n" + body, ""}, profiles::geforce2));
  };
  EXPECT_EQ(rc10(kReadsBoth), (Names{"const0", "const1"}));
  EXPECT_EQ(rc10("const1 = (0, 0, 0, 0);\n" + kReadsBoth), Names{"const0"});
  EXPECT_EQ(rc10("out.rgb = tex0;\nout.a = zero;\n"), Names{});
  const std::string input =
      "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_CONSTANT_COLOR0_NV, GL_SIGNED_IDENTITY_NV, "
      "GL_RGB);\n";
  const std::string set =
      "glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, (const GLfloat[]){0.0f, 0.0f, 0.0f, 0.0f});\n";
  EXPECT_EQ(unset(parse_gl_calls({input, ""}, profiles::geforce2)), Names{"const0"});
  EXPECT_EQ(unset(parse_gl_calls({set + input, ""}, profiles::geforce2)), Names{});
  const auto source = [](const std::string& calls) {
    return unset(parse_source_code({"void setup(void) {\n" + calls + "}\n", ""}, {}, profiles::geforce2));
  };
  EXPECT_EQ(source(input), Names{"const0"});
  EXPECT_EQ(source(input + set), Names{});
  const std::string nvparse =
      "nvparse(\"!!RC1.0\\nconst0 = (0, 0, 0, 0);\\nout.rgb = const0 * const1;\\nout.a = zero;\");\n";
  EXPECT_EQ(source(nvparse), Names{"const1"});
  const std::string json =
      R"({"ninebit": "program", "version": 1, "final_combiner": {"d": {"input": "constant_color0"}})";
  EXPECT_EQ(unset(parse_json_program({json + "}", ""}, profiles::geforce2)), Names{"const0"});
  EXPECT_EQ(unset(parse_json_program({json + ", \"constant_color0\": [0, 0, 0, 0]}", ""}, profiles::geforce2)),
            Names{});
  const auto shader = [](const std::string& body) {
    return unset(parse_pixel_shader({"ps.1.1\n" + body, ""}, profiles::geforce2));
  };
  EXPECT_EQ(shader("tex t0\nmul r0, t0, c5\n"), Names{"const5"});
  EXPECT_EQ(shader("def c5, 0, 0, 0, 0\ntex t0\nmul r0, t0, c5\nadd r0, r0, c1\n"), Names{"const1"});
}

TEST(UnsetConstants, OfAGeneralCombinersOwn) {
  // The first has a constant of its own, so that all have; the second does not set its own.
  const CombinerState state = rc10_of(
      "{ const0 = (1, 1, 1, 1); rgb { spare0 = tex0 * const0; } }\n{ rgb { spare0 = spare0 * const0; } }\n"
      "out.rgb = spare0 * const0;\nout.a = zero;\n",
      profiles::nv2a);
  EXPECT_EQ(unset(state, profiles::nv2a), (Names{"stage1.const0", "const0"}));
  for (std::size_t i = 0; i < kConstantNames; ++i) {
    const auto name = static_cast<ConstantName>(i);
    EXPECT_EQ(constant_called(name_of_constant(name)), name);
  }
  EXPECT_EQ(constant_called("const16"), std::nullopt);
}

// The printed text leaves the same constants unset, and sets those that are 0.
TEST(UnsetConstants, StayUnsetInEveryPrintedForm) {
  const std::vector<std::string> bodies{
      kReadsBoth, "const0 = (0, 0, 0, 0);\n" + kReadsBoth, "const1 = (0, 0, 0, 0);\n" + kReadsBoth,
      "const0 = (0, 0, 0, 0);\nconst1 = (1, 0, 0, 0);\n" + kReadsBoth,
      "{ const0 = (0, 0, 0, 0); rgb { spare0 = tex0 * const0; } }\n{ rgb { spare0 = spare0 * const0; } }\n"
      "const0 = (0, 1, 0, 1);\nout.rgb = spare0 * const0;\nout.a = zero;\n",
      // Nothing that is set makes constants the general combiners' own, but a constant that nothing reads.
      "{ const1 = (0, 0, 0, 0); rgb { spare0 = tex0 * const0; } }\n{ rgb { spare0 = spare0 * const0; } }\n"
      "out.rgb = spare0 * const0;\nout.a = zero;\n"};
  for (const std::string& body : bodies) {
    SCOPED_TRACE(body);
    const HardwareProfile& profile = profiles::nv2a;
    const CombinerState state = rc10_of(body, profile);
    const Names expected = unset(state, profile);
    EXPECT_EQ(unset(parse_rc10({*print_rc10(state, profile), ""}, profile), profile), expected)
        << *print_rc10(state, profile);
    EXPECT_EQ(unset(parse_gl_calls({*print_gl_calls(state, profile), ""}, profile), profile), expected);
    EXPECT_EQ(unset(parse_json_program({print_json_program(state), ""}, profile), profile), expected);
    const auto words = encode_register_words(state, ChipClass::nv20, profile);
    EXPECT_EQ(unset(decode_register_words(*words, "", ChipClass::nv20, profile), profile), expected);
  }
  const std::string shader = "ps.1.1\ndef c1, 0.5, 0, 0, 0\ntex t0\nmul r0, t0, c2\nadd r0, r0, c1\n";
  const CombinerState read = parse_pixel_shader({shader, ""}, profiles::geforce2).value();
  EXPECT_EQ(unset(read), Names{"const2"});
  const auto printed = print_pixel_shader(read, profiles::geforce2);
  ASSERT_TRUE(printed.ok());
  EXPECT_EQ(unset(parse_pixel_shader({*printed, ""}, profiles::geforce2)), Names{"const2"}) << *printed;
  EXPECT_FALSE(has(*printed, "def c2"));
}

TEST(UnsetConstants, AreNotFoldedInExplanations) {
  const auto explained = [](const std::string& body) {
    return print_explanation(explain(normalize(rc10_of(body), profiles::geforce2), profiles::geforce2));
  };
  const std::string text = explained("out.rgb = tex0 * const0;\nout.a = const1.a;\n");
  EXPECT_TRUE(has(text, "rgb = tex0 × const0\n"));
  EXPECT_TRUE(has(text, "alpha = const1.a\n"));
  EXPECT_TRUE(has(text, "const0 is not set\n"));
  const std::string zero = explained("const0 = (0, 0, 0, 0);\nout.rgb = tex0 * const0;\nout.a = zero;\n");
  EXPECT_TRUE(has(zero, "rgb = 0\n"));
  const CombinerState shader = parse_pixel_shader({"ps.1.1\ntex t0\nmul r0, t0, c5\n", ""}, profiles::geforce2).value();
  const std::string other = print_explanation(explain(normalize(shader, profiles::geforce2), profiles::geforce2));
  EXPECT_TRUE(has(other, "const0 is const5, which is not set\n"));
}

}  // namespace
}  // namespace ninebit::test

// Pixel shaders in assembly mean the same as !!RC1.0 texts and words of the Xbox that were made by hand.
#include "ninebit/language/pixel_shader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/source_code.h"
#include "ninebit/language/xbox_pixel_shader.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

Program program_of_shader(std::string_view text, const HardwareProfile& profile) {
  const auto parsed = parse_pixel_shader({text, ""}, profile);
  EXPECT_TRUE(parsed) << text << "\n" << test::all_faults(parsed);
  return parsed ? normalize(*parsed, profile) : Program{};
}

std::string shader_notes(std::string_view text) {
  std::string all;
  for (const TextFault& note : parse_pixel_shader({text, ""}, profiles::nv2a).notes) all += note.text() + "\n";
  return all;
}

struct SameMeaning {
  std::string shader;  // after ps.1.1 and tex t0 to t3
  std::string stages;  // of the !!RC1.0 text
};

void expect_same(const std::vector<SameMeaning>& cases, const std::string& header, const HardwareProfile& profile,
                 const std::string& final = "out.rgb = spare0;\nout.a = spare0;\n") {
  for (const SameMeaning& c : cases) {
    const std::string rc10 = "!!RC1.0\n" + c.stages + final;
    const auto expected = parse_rc10({rc10, ""}, profile);
    ASSERT_TRUE(expected) << rc10 << test::all_faults(expected);
    EXPECT_EQ(program_of_shader(header + c.shader, profile), normalize(*expected, profile)) << c.shader << "\n" << rc10;
  }
}

TEST(PixelShader, AnInstructionIsAGeneralCombiner) {
  expect_same(
      {
          {"mov r0, t0", "{ rgb { spare0 = tex0; } alpha { spare0 = tex0; } }\n"},
          {"add r0, t0, v0",
           "{ rgb { discard = tex0; discard = col0; spare0 = sum(); }\n"
           "  alpha { discard = tex0; discard = col0; spare0 = sum(); } }\n"},
          {"sub r0.rgb, t0, v1", "{ rgb { discard = tex0; discard = col1 * expand(zero); spare0 = sum(); } }\n"},
          {"sub r0.rgb, t0, 1-v1",
           "{ rgb { discard = tex0; discard = unsigned_invert(col1) * expand(zero); spare0 = sum(); } }\n"},
          {"mul_x2 r0.rgb, t0, t1\n+mov_d2 r0.a, v0",
           "{ rgb { spare0 = tex0 * tex1; scale_by_two(); } alpha { spare0 = col0; scale_by_one_half(); } }\n"},
          {"mad_x4 r0.rgb, t0, 1-t1, -v0.a",
           "{ rgb { discard = tex0 * unsigned_invert(tex1); discard = one * -col0.a; spare0 = sum(); scale_by_four(); "
           "} }\n"},
          {"lrp r0.rgb, v0.a, t0, t1",
           "{ rgb { discard = unsigned(col0.a) * tex0; discard = tex1 * unsigned_invert(col0.a); spare0 = sum(); } "
           "}\n"},
          {"lrp r0.rgb, 1-v0, t0, t1",
           "{ rgb { discard = unsigned_invert(col0) * tex0; discard = tex1 * unsigned(col0); spare0 = sum(); } }\n"},
          {"dp3 r0.rgb, t0_bx2, -v0_bx2\n+mul r0.a, t0.b, t1_bias",
           "{ rgb { spare0 = expand(tex0) . -expand(col0); } alpha { spare0 = tex0.b * half_bias(tex1); } }\n"},
          {"mov r0, t0\ncnd r0.rgb, r0.a, t1, -t0\n",
           "{ rgb { spare0 = tex0; } alpha { spare0 = tex0; } }\n"
           "{ rgb { discard = -tex0; discard = tex1; spare0 = mux(); } }\n"},
          {"mov r1.a, t0\nmul r0.rgb, t0, r1.a\n+mov r0.a, r1.a",
           "{ alpha { spare1 = tex0; } }\n{ rgb { spare0 = tex0 * spare1.a; } alpha { spare0 = spare1; } }\n"},
          {"mul t0, t0, v0\nmov r0, t0.rgb",
           "{ rgb { tex0 = tex0 * col0; } alpha { tex0 = tex0 * col0; } }\n"
           "{ rgb { spare0 = tex0; } alpha { spare0 = tex0.b; } }\n"},
      },
      "ps.1.1\ntex t0\ntex t1\n", profiles::geforce2);
}

TEST(PixelShader, ASaturatedRegisterIsReadWithoutItsSign) {
  expect_same(
      {
          {"sub_sat r0.rgb, t0, t1\nmul r0.rgb, r0, v0",
           "{ rgb { discard = tex0; discard = tex1 * expand(zero); spare0 = sum(); } }\n{ rgb { spare0 = "
           "unsigned(spare0) * col0; } "
           "}\n"},
          {"sub_sat r0.rgb, t0, t1\nmov r0.rgb, -r0",
           "{ rgb { discard = tex0; discard = tex1 * expand(zero); spare0 = sum(); } }\n"
           "{ rgb { spare0 = unsigned(spare0) * expand(zero); } }\n"},
          {"sub_sat r0, t0, t1\nsub r0.rgb, t0, r0.a",
           "{ rgb { discard = tex0; discard = tex1 * expand(zero); spare0 = sum(); }\n"
           "  alpha { discard = tex0; discard = tex1 * expand(zero); spare0 = sum(); } }\n"
           "{ rgb { discard = tex0; discard = unsigned(spare0.a) * expand(zero); spare0 = sum(); } }\n"},
          {"sub_sat r0.rgb, t0, t1\nmul r0.rgb, -r0, t1",
           "{ rgb { discard = tex0; discard = tex1 * expand(zero); spare0 = sum(); } }\n{ rgb { spare0 = "
           "unsigned(spare0) * -tex1; } "
           "}\n"},
      },
      "ps.1.1\ntex t0\ntex t1\n", profiles::geforce2);
}

TEST(PixelShader, ConstantsBelongToAStageWhereThereAreMoreThanTwo) {
  expect_same({{"mul r0.rgb, c3, t0\nmad r0.rgb, c5, r0, c3",
                "const0 = (1, 0.5, 0, 0);\nconst1 = (0, 0, 0, 1);\n{ rgb { spare0 = const0 * tex0; } }\n"
                "{ rgb { discard = const1 * spare0; discard = one * const0; spare0 = sum(); } }\n"}},
              "ps.1.1\ndef c3, 1, .5, 0, 0\ndef c5, 0, 0, 0, 1.0f\ntex t0\n", profiles::geforce2);
  expect_same({{"mul r0.rgb, c1, t0\nmad r0.rgb, c2, r0, c0",
                "{ const0 = (0, 1, 0, 0); rgb { spare0 = const0 * tex0; } }\n"
                "{ const0 = (0, 0, 1, 0); const1 = (1, 0, 0, 0);\n"
                "  rgb { discard = const0 * spare0; discard = one * const1; spare0 = sum(); } }\n"}},
              "ps.1.1\ndef c0, 1, 0, 0, 0\ndef c1, 0, 1, 0, 0\ndef c2, 0, 0, 1, 0\ntex t0\n", profiles::nv2a);
  // A number below 0 is stored as its negative: -0.5 is -127, the nearest with halves up, as 0.5 is 128.
  expect_same({{"add r0.rgb, t0, c0",
                "const0 = (0.498, 0, 0.25, 0);\n{ rgb { discard = tex0; discard = -const0; spare0 = sum(); } }\n"}},
              "ps.1.1\ndef c0, -0.5, 0, -0.25, 0\ntex t0\n", profiles::geforce2);
}

TEST(PixelShader, AConstantWithMixedSignsIsTheDifferenceOfTwo) {
  const std::string two =
      "{ const0 = (1, 0, 0, 1); const1 = (0, 0.498, 1, 0);\n"
      "  rgb { discard = const0; discard = -const1; spare1 = sum(); }\n"
      "  alpha { discard = const0; discard = -const1; spare1 = sum(); } }\n";
  // The register keeps the constant for later instructions; one that is negated is read as its negative.
  expect_same({{"mul r0, t0, c1\nadd r0, r0, -c1",
                two + "{ rgb { spare0 = tex0 * spare1; } alpha { spare0 = tex0 * spare1; } }\n"
                      "{ rgb { discard = spare0; discard = -spare1; spare0 = sum(); }\n"
                      "  alpha { discard = spare0; discard = -spare1; spare0 = sum(); } }\n"},
               {"mov r1, c1\nmul r0, t0, r1",
                "{ const0 = (1, 0, 0, 1); const1 = (0, 0.498, 1, 0);\n"
                "  rgb { discard = const0; discard = -const1; tex3 = sum(); }\n"
                "  alpha { discard = const0; discard = -const1; tex3 = sum(); } }\n"
                "{ rgb { spare1 = tex3; } alpha { spare1 = tex3; } }\n"
                "{ rgb { spare0 = tex0 * spare1; } alpha { spare0 = tex0 * spare1; } }\n"}},
              "ps.1.1\ndef c0, 1, 1, 1, 1\ndef c1, 1.25, -0.5, -1.5, 1\ntex t0\n", profiles::nv2a);
}

TEST(PixelShader, ConstantsWithMixedSignsGiveTheColorsOfDirect3DsReferenceDrivers) {
  // 128, 128, 0 there.
  const Program program = program_of_shader(
      "ps.1.1\ndef c1, 1.25, -0.5, -1.5, 1\ndef c2, -0.5, 1.25, 2, 1\nmov r0, c1\nadd r0, r0, c2\n", profiles::nv2a);
  EXPECT_EQ(evaluate(program, {}), (Rgba9{128, 128, 0, 255}));
}

TEST(PixelShader, AConstantWithMixedSignsKeepsThemWhereASaturatedDotProductWas) {
  RegisterFile in;
  in[Register::texture0] = {200, 200, 200, 200};
  for (const Register reg : {Register::primary, Register::secondary, Register::texture1, Register::texture2}) {
    in[reg] = {255, 255, 255, 255};
  }
  in[Register::texture3] = in[Register::primary];
  const std::string begin =
      "ps.1.1\ndef c0, 1, -0.5, 0, 0\ntex t0\ntex t1\ntex t2\ntex t3\nmov r0, t0\ndp3_sat r0.a, t0, v0\n";
  // With the second shader, no register is free but the one that holds the dot product.
  for (const std::string& rest : std::vector<std::string>{
           "add r0.rgb, r0, c0\n", "add r0.rgb, r0, c0\nlrp r0.rgb, t1, r0, t2\nlrp r0.rgb, t3, r0, v1\n"}) {
    const Program program = program_of_shader(begin + rest, profiles::nv2a);
    EXPECT_EQ(evaluate(program, in), (Rgba9{255, 73, 200, 255})) << rest;
  }
}

TEST(PixelShader, ADotProductOfAllComponentsReachesAlpha) {
  // The NV2A writes blue to alpha; a GeForce 2 reads blue where alpha is meant.
  CombinerState state;
  state.general[0].rgb = {
      {Register::texture0, InputMapping::signed_identity},
      {Register::primary, InputMapping::signed_identity},
      {},
      {},
      {.ab = Register::spare0, .sum = Register::discard, .ab_dot_product = true, .ab_blue_to_alpha = true}};
  state.general[0].alpha.out.sum = Register::discard;
  state.final_combiner.a = state.final_combiner.b = state.final_combiner.c = {};
  state.final_combiner.d.reg = Register::spare0;
  EXPECT_EQ(program_of_shader("ps.1.1\ntex t0\ndp3 r0, t0, v0\n", profiles::nv2a), normalize(state, profiles::nv2a));
  expect_same({{"dp3 r0, t0, v0\nmul r0, t0, r0.a",
                "{ rgb { spare0 = tex0 . col0; } }\n"
                "{ rgb { spare0 = tex0 * spare0; } alpha { spare0 = tex0 * spare0.b; } }\n"},
               {"dp3 r0, t0, v0\nmul r0.rgb, t0, v0",
                "{ rgb { spare0 = tex0 . col0; } }\n"
                "{ rgb { spare0 = tex0 * col0; } alpha { spare0 = spare0.b; } }\n"}},
              "ps.1.1\ntex t0\n", profiles::geforce2);
  expect_same({{"dp3 r0, t0, v0", "{ rgb { spare0 = tex0 . col0; } }\n"}}, "ps.1.1\ntex t0\n", profiles::geforce2,
              "out.rgb = spare0;\nout.a = spare0.b;\n");
  // Into alpha alone: the colour goes to a register that nothing reads.
  expect_same({{"mov r0.rgb, t0\ndp3 r0.a, t0, v0", "{ rgb { spare0 = tex0; } }\n{ rgb { spare1 = tex0 . col0; } }\n"}},
              "ps.1.1\ntex t0\n", profiles::geforce2, "out.rgb = spare0;\nout.a = spare1.b;\n");
}

TEST(PixelShader, CmpTestsOneComponentInTwoStages) {
  const std::string text = "ps.1.2\ntex t0\ntex t1\nmov r1, t0\nsub r1.a, t0, t1\ncmp r0, r1.a, t0, v0\n";
  const Program program = program_of_shader(text, profiles::nv2a);
  for (const int difference : {-255, -1, 0, 1, 255}) {
    RegisterFile registers;
    registers[Register::texture0] = {10, 20, 30, static_cast<std::int16_t>(std::max(difference, 0))};
    registers[Register::texture1] = {0, 0, 0, static_cast<std::int16_t>(std::max(-difference, 0))};
    registers[Register::primary] = {200, 210, 220, 230};
    const Rgba9 expected = difference >= 0 ? registers[Register::texture0] : registers[Register::primary];
    EXPECT_EQ(evaluate_fragment(program, registers).color, expected) << difference;
  }
  EXPECT_EQ(program.num_general_combiners, 4);
}

TEST(PixelShader, Dp4AddsTheProductOfAlphas) {
  const Program program = program_of_shader("ps.1.2\ntex t0\ndp4 r0, t0, v0\n", profiles::nv2a);
  RegisterFile registers;
  registers[Register::texture0] = {51, 0, 0, 102};
  registers[Register::primary] = {255, 255, 255, 255};
  EXPECT_EQ(evaluate_fragment(program, registers).color, (Rgba9{153, 153, 153, 153}));
  EXPECT_EQ(program.num_general_combiners, 2);
}

TEST(PixelShader, TheXboxsInstructionsSetEveryInput) {
  expect_same(
      {
          {"xmma_x2 r0, r1.rgb, discard, t0, -v0_bias, fog, 1-zero",
           "{ rgb { spare0 = tex0 * -half_bias(col0); spare1 = fog; scale_by_two(); }\n"
           "  alpha { spare0 = tex0 * -half_bias(col0); scale_by_two(); } }\n"},
          {"xdd r0.rgb, r1.rgb, t0, t1, v0_sat, v1\nmov_bx2 r0.rgb, r1",
           "{ rgb { spare0 = tex0 . tex1; spare1 = unsigned(col0) . col1; } }\n"
           "{ rgb { spare0 = spare1; bias_by_negative_one_half_scale_by_two(); } }\n"},
          {"xdm r0.rgb, r1, t0, t1, texture2, color1\nmov_bias r0, r1",
           "{ rgb { spare0 = tex0 . tex1; spare1 = tex2 * col1; } alpha { discard = zero; spare1 = tex2 * col1; } }\n"
           "{ rgb { spare0 = spare1; bias_by_negative_one_half(); } alpha { spare0 = spare1; "
           "bias_by_negative_one_half(); } }\n"},
      },
      "xps.1.1\n", profiles::nv2a);
}

TEST(PixelShader, TheXboxsTextGivesTheXboxsWords) {
  const std::string text =
      "; luminance over a mask\nXPS.1.1\ndef c2, 0.25f, 0.5f, 0.125f, 1\ntex t0\ntex t1\n"
      "dp3 r0, c2, t0\nxmmc r1.rgb, discard, v0, r0, t1_bx2, -t0, One\n"
      "xfc 1 - fog.a, sum, PROD, zero, c2, v1.a, r0.b ; seven inputs\n";
  const std::string words =
      "PSRGBInputs[0] = 0xc1c80000\nPSRGBOutputs[0] = 0x000820c0\nPSConstant0[0] = 0xff408020\n"
      "PSRGBInputs[1] = 0xcc49e820\nPSRGBOutputs[1] = 0x000044d0\nPSAlphaInputs[1] = 0xdc59f830\n"
      "PSAlphaOutputs[1] = 0x00004400\nPSFinalCombinerInputsABCD = 0x330e0f00\nPSFinalCombinerInputsEFG = 0x01150c80\n"
      "PSFinalCombinerConstant0 = 0xff408020\nPSCombinerCount = 0x00011102\n";
  const auto expected = parse_xbox_pixel_shader({words, ""}, profiles::nv2a);
  ASSERT_TRUE(expected) << test::all_faults(expected);
  const auto parsed = parse_pixel_shader({text, ""}, profiles::nv2a);
  ASSERT_TRUE(parsed) << test::all_faults(parsed);
  const Program want = normalize(*expected, profiles::nv2a), found = normalize(*parsed, profiles::nv2a);
  EXPECT_EQ(found.general[0], want.general[0]);
  EXPECT_EQ(found.general[1], want.general[1]);
  EXPECT_EQ(found.final_combiner, want.final_combiner);
  EXPECT_EQ(found, want);
}

TEST(PixelShader, Ps14UsesTheTexturesRegisters) {
  expect_same({{"texld r0, t0\ntexld r1, t1_dz.xyw\nmul r2, r0, r1\nmad r0, r2, v0, r1",
                "{ rgb { spare0 = tex0 * tex1; } alpha { spare0 = tex0 * tex1; } }\n"
                "{ rgb { discard = spare0 * col0; discard = one * tex1; tex0 = sum(); }\n"
                "  alpha { discard = spare0 * col0; discard = one * tex1; tex0 = sum(); } }\n"},
               {"texld r0, t0\nphase\ntexld r1, t0\nmul_x2 r0, r0_x2, r1",
                "{ rgb { tex0 = tex0 * tex1; scale_by_four(); } alpha { tex0 = tex0 * tex1; scale_by_four(); } }\n"}},
              "ps.1.4\n", profiles::nv2a, "out.rgb = tex0;\nout.a = tex0;\n");
}

TEST(PixelShader, NamesAndConditionsOfThePreprocessorAreReplaced) {
  const std::string text =
      "#define FADE c0.a\n#define LIT mul r0, t0, \\\n  FADE\n#ifdef DAY\nbroken\n#elif 0\nbroken\n#else\n#define LAST "
      "add r0, "
      "r0, v0\n#endif\n#if !defined(NIGHT)\nps.1.1\n#endif\ndef c0, 0, 0, 0, 1\ntex t0 LIT\nLAST\n";
  EXPECT_EQ(program_of_shader(text, profiles::nv2a),
            program_of_shader("ps_1_1 def c0, 0, 0, 0, 1 tex t0 mul r0, t0, c0.a add r0, r0, v0", profiles::nv2a));
}

TEST(PixelShader, ANameIsNotReplacedInItself) {
  EXPECT_EQ(program_of_shader("ps.1.1\n#define v0 1-v0\nmov r0, v0\n", profiles::nv2a),
            program_of_shader("ps.1.1\nmov r0, 1-v0\n", profiles::nv2a));
}

TEST(PixelShader, ModifiersOfOne) {
  const auto is = [](const char* from, const char* rc10) {
    const std::string stage = std::string("!!RC1.0\n{ rgb { spare0 = ") + rc10 + "; } alpha { spare0 = " + rc10 +
                              "; } }\nout.rgb = spare0;\nout.a = spare0;\n";
    const auto expected = parse_rc10({stage, ""}, profiles::nv2a);
    ASSERT_TRUE(expected) << test::all_faults(expected);
    EXPECT_EQ(program_of_shader(std::string("xps.1.1\nmov r0, ") + from + "\n", profiles::nv2a),
              normalize(*expected, profiles::nv2a))
        << from;
  };
  is("one_bias", "-half_bias(zero)");
  is("one_bx2", "unsigned_invert(zero)");
  is("one", "unsigned_invert(zero)");
}

// Definitions are macros that no line of the text replaces.
TEST(PixelShader, DefinitionsOfTheCaller) {
  const std::string text =
      "ps.1.1\n#ifndef MODE\n#define MODE 0\n#endif\n#if MODE == 0\nmov r0, v0\n#elif MODE == 1\nmov r0, "
      "v1\n#else\nmov "
      "r0, SOURCE\n#endif\n";
  const auto with = [](const std::string& shader, const std::vector<Definition>& definitions) {
    const auto parsed = parse_pixel_shader({shader, ""}, profiles::nv2a, definitions);
    EXPECT_TRUE(parsed) << test::all_faults(parsed);
    EXPECT_TRUE(parsed.notes.empty());
    return parsed ? normalize(*parsed, profiles::nv2a) : Program{};
  };
  const auto plain = [](const char* shader) { return program_of_shader(shader, profiles::nv2a); };
  EXPECT_EQ(with(text, {}), plain("ps.1.1\nmov r0, v0"));
  EXPECT_EQ(with(text, {{"MODE", "1"}}), plain("ps.1.1\nmov r0, v1"));
  EXPECT_EQ(with(text, {{"MODE", "2"}, {"SOURCE", "1 - v0"}}), plain("ps.1.1\nmov r0, 1-v0"));
  for (const char* line : {"#define MODE 0\n", "#undef MODE\n"}) {
    const std::string own = "ps.1.1\n" + std::string(line) + "#if MODE == 1\nmov r0, v1\n#endif\n";
    EXPECT_EQ(with(own, {{"MODE", "0"}, {"MODE", "1"}}), plain("ps.1.1\nmov r0, v1")) << "the last one counts";
  }
  const auto unused = parse_pixel_shader({"ps.1.1\nmov r0, v0", "f"}, profiles::nv2a, {{"MODE", "1"}});
  ASSERT_EQ(unused.notes.size(), 1U);
  EXPECT_EQ(unused.notes[0].text(), "f:1:1: the definition of 'MODE' was not needed");
  EXPECT_EQ(test::all_faults(parse_pixel_shader({"ps.1.1\nmov r0, v0", ""}, profiles::nv2a, {{"MODE", "1 /* one"}})),
            "1:1: the definition of 'MODE': unterminated comment; expected */\n");
  // A source's definitions reach the shaders in it.
  const std::string source = "void f() { nvparse(\"ps.1.1\\n#if MODE == 1\\nmov r0, v1\\n#endif\\n\"); }\n";
  const auto loaded =
      parse_source_code({source, ""}, {.functions = {}, .definitions = {{"MODE", "1"}}}, profiles::nv2a);
  ASSERT_TRUE(loaded) << test::all_faults(loaded);
  EXPECT_TRUE(loaded.notes.empty());
  EXPECT_EQ(normalize(*loaded, profiles::nv2a), plain("ps.1.1\nmov r0, v1"));
  EXPECT_FALSE(parse_source_code({source, ""}, {}, profiles::nv2a));
}

// The equations of a shader whose included files are these, or its faults.
std::string with_files(const std::string& shader, const std::vector<std::pair<std::string, std::string>>& files) {
  const SourceInclude include = [&](std::string_view name) -> std::optional<std::string> {
    for (const auto& [file, text] : files) {
      if (file == name) return text;
    }
    return std::nullopt;
  };
  const auto parsed = parse_pixel_shader({shader, "f"}, profiles::nv2a, {}, include);
  if (!parsed) return test::all_faults(parsed);
  const auto expected = parse_pixel_shader({"ps.1.1\ntex t0\nmul r0, t0, v0\nadd r0, r0, v1\n", ""}, profiles::nv2a);
  return normalize(*parsed, profiles::nv2a) == normalize(*expected, profiles::nv2a) ? "same" : "another";
}

TEST(PixelShader, IncludedFilesAreRead) {
  const std::string whole = "ps.1.1\ntex t0\n#include \"body.h\"\n";
  EXPECT_EQ(with_files(whole, {{"body.h", "; of two lines\nmul r0, t0, v0\nadd r0, r0, v1"}}), "same");
  EXPECT_EQ(with_files(whole + "add r0, r0, v1\n", {{"body.h", "mul r0, t0, v0 // one"}}), "same");
  EXPECT_EQ(with_files("ps.1.1\n#include \"names.h\"\ntex t0\nLIGHT(v0)\nadd r0, r0, v1\n",
                       {{"names.h", "#pragma once\n#include \"more.h\"\n"},
                        {"more.h", "#include \"names.h\"\n#define LIGHT(C) mul r0, t0, C\n"}}),
            "same");
  EXPECT_EQ(with_files(whole, {{"body.h",
                                "#ifndef BODY\n#define BODY\n#define MUL mul r0, t0, v0\n#include "
                                "\"body.h\"\nMUL\nadd r0, r0, v1\n#endif\n"}}),
            "same");
}

TEST(PixelShader, FaultsOfIncludedFilesAreNamed) {
  const std::string whole = "ps.1.1\ntex t0\n#include \"a.h\"\nmul r0, t0, v0\n";
  EXPECT_EQ(with_files(whole, {}),
            "f:3:1: '\"a.h\"' was not read; expected a text below the folder of this file, or --allow-outside\n");
  EXPECT_EQ(with_files(whole, {{"a.h", "#include \"b.h\"\n"}}),
            "f:3:1: '\"b.h\"' was not read; expected a text below the folder of this file, or --allow-outside\n");
  EXPECT_EQ(with_files(whole, {{"a.h", "#include \"b.h\"\n"}, {"b.h", "#include \"a.h\"\n"}}),
            "f:3:2: 'a.h' includes itself\n");
  EXPECT_EQ(with_files(whole, {{"a.h", "/* open"}}), "a.h:1:1: unterminated comment; expected */\n");
  EXPECT_EQ(with_files(whole, {{"a.h", "#iff 1\n"}}),
            "f:3:2: 'a.h': '#iff' is not a line of the preprocessor; did you mean 'if'?\n");
  EXPECT_EQ(with_files(whole, {{"a.h", "#if MODE\n#endif\n"}}),
            "f:3:2: 'a.h': 'MODE' is not defined, and a condition depends on it\n");
  EXPECT_EQ(with_files(whole, {{"a.h", "mull r0, t0, v0\n"}}),
            "f:3:2: 'mull' is not an instruction of ps.1.1; did you mean 'mul'?\n");
}

TEST(PixelShader, ConditionsEndInTheirFile) {
  const std::string whole = "ps.1.1\ntex t0\n#include \"a.h\"\n", body = "mul r0, t0, v0\nadd r0, r0, v1\n";
  EXPECT_EQ(with_files(whole + body, {{"a.h", "\n\n\n#if 1\n#if 1\n"}}),
            "f:3:2: 'a.h': unterminated condition; expected #endif\n");
  // The condition of one file has no #else in another.
  EXPECT_EQ(with_files(whole + "#else\n" + body, {{"a.h", "#if 0\n"}}),
            "f:3:2: 'a.h': unterminated condition; expected #endif\nf:4:1: '#else' without #if\n");
  EXPECT_EQ(with_files("ps.1.1\ntex t0\n#if 1\n#include \"a.h\"\n" + body + "#endif\n", {{"a.h", "#endif\n"}}),
            "f:4:2: 'a.h': '#endif' without #if\n");
}

TEST(PixelShader, IncludedFilesHaveLimits) {
  std::size_t reads = 0;
  std::string text = "\n";
  const SourceInclude include = [&](std::string_view) -> std::optional<std::string> {
    ++reads;
    return text;
  };
  const auto faults = [&](std::size_t includes) {
    std::string shader = "ps.1.1\n";
    for (std::size_t i = 0; i < includes; ++i) shader += "#include \"a.h\"\n";
    reads = 0;
    return test::all_faults(parse_pixel_shader({shader + "mov r0, v0\n", "f"}, profiles::nv2a, {}, include));
  };
  EXPECT_EQ(faults(200), "");
  EXPECT_EQ(faults(300),
            "f:202:2: 'a.h' is one included file too many; expected at most 16 inside of each other, and 200 in all\n");
  EXPECT_EQ(reads, 200U);
  // All files together may be as long as one text.
  text.assign(kMaxSourceBytes / 2, '\n');
  EXPECT_EQ(faults(2), "");
  EXPECT_EQ(faults(9), "f:4:2: 'a.h' makes the included files longer than 16777216 bytes together\n");
  EXPECT_EQ(reads, 3U);
  text = "#include \"a.h\"\n#include \"a.h\"\n";
  EXPECT_EQ(faults(1), "f:2:2: 'a.h' includes itself\n");
  EXPECT_EQ(reads, 16U);
}

TEST(PixelShader, NotesSayWhatIsLeftToOthers) {
  EXPECT_EQ(shader_notes("ps.1.1\ntex t0\ntexbem t1, t0\nmul r0.rgb, t1, c4\nadd r0.rgb, r0, c0\n"),
            "2:1: tex and texbem are executed before the combiners, and skipped; t0 and t1 hold the result\n"
            "2:1: r0.a is not written; it begins as texture 0's alpha\n"
            "4:17: c0 and c4 are not defined here; the application sets them\n");
  EXPECT_EQ(shader_notes("xps.1.1\n#include \"names.h\"\ndef c0, 2, 0, -1, 0\nmov r0, c0"),
            "2:1: skipped '\"names.h\"'; its names are not known\n3:5: c0 is clamped to 0 to 1\n");
  EXPECT_EQ(shader_notes("#pragma once\n#include <d3d8.h>\nps.1.1\nmov r0, v0"),
            "2:1: skipped '<d3d8.h>'; its names are not known\n");
  EXPECT_EQ(shader_notes("ps.1.1\nmov r0, v0"), "");
}

TEST(PixelShader, IsFoundInStringsAndSources) {
  const std::string plain = "ps.1.1\ntex t0\nmul r0, t0, v0\n";
  const Program expected = program_of_shader(plain, profiles::geforce2);
  EXPECT_EQ(
      program_of_shader("const char* lit =\n  \"ps.1.1\\n\"\n  // the base\n  \"tex t0\\n\"\n  \"mul r0, t0, v0\\n\";",
                        profiles::geforce2),
      expected);
  EXPECT_EQ(program_of_shader("!!PS1.0\nmul r0, t0, v0\n", profiles::geforce2), expected);
  const std::string source =
      "static const char glow[] = \"xps.1.1\\nmov r0, v0\\n\";\nvoid lit() {\n  nvparse(\"!!PS1.0\\n\"\n    \"mul r0, "
      "t0, "
      "v0\\n\");\n}\n";
  ASSERT_TRUE(is_source_code(source));
  const auto loaded = parse_source_code({source, ""}, {.functions = {"lit"}}, profiles::geforce2);
  ASSERT_TRUE(loaded) << test::all_faults(loaded);
  EXPECT_EQ(normalize(*loaded, profiles::geforce2), expected);
  const auto named = parse_source_code({source, ""}, {.functions = {"glow"}}, profiles::geforce2);
  ASSERT_TRUE(named) << test::all_faults(named);
  EXPECT_EQ(normalize(*named, profiles::geforce2), program_of_shader("xps.1.1\nmov r0, v0", profiles::geforce2));
}

TEST(PixelShader, IsKnownByItsHeader) {
  for (const char* text :
       {"ps.1.1", "; c\n// c\n/* c */ ps_1_4\n", "#define X\n\nXPS.1.1", "!!PS1.0\n", "\xEF\xBB\xBFps.1.0"}) {
    EXPECT_TRUE(is_pixel_shader(text)) << text;
  }
  for (const char* text : {"", "ps.2.0", "; c\nps_3_0", "vs.1.1", "ps = 1", "!!RC1.0", "tex t0", "maps.1.1"}) {
    EXPECT_FALSE(is_pixel_shader(text)) << text;
  }
}

}  // namespace
}  // namespace ninebit

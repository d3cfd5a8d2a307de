// Forms that are detected, and words that combiners do not read on their way through the forms that keep them.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/language/register_log_shapes.h"
#include "combiner_tests/language/xbox_shapes.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/temp_folder.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/json.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/program_text.h"
#include "ninebit/language/xbox_pixel_shader.h"

namespace ninebit::test {
namespace {

const HardwareProfile& kFormsProfile = profiles::nv2a;

std::string text_of(const std::vector<RegisterWord>& words) {
  std::string text;
  for (const RegisterWord& word : words) text += word.name + '=' + hex(word.value) + ' ';
  return text;
}

TEST(ProgramForms, ADumpOfCallsIsReadAsCalls) {
  EXPECT_EQ(form_of("1235 glCombinerParameteriNV(pname = GL_NUM_GENERAL_COMBINERS_NV, param = 2)\n"
                    "1236 glEnable(cap = GL_REGISTER_COMBINERS_NV)\n"),
            ProgramForm::gl);
}

// The program of a text in its detected form.
Parsed<TextProgram> read_as(ProgramForm form, std::string_view text) {
  EXPECT_EQ(form_of(text), form) << text;
  return parse_program({text, "f"}, form, kFormsProfile);
}

void expect_same(const Parsed<TextProgram>& found, const Parsed<TextProgram>& expected) {
  ASSERT_TRUE(found) << all_faults(found);
  ASSERT_TRUE(expected) << all_faults(expected);
  EXPECT_EQ(found->state, expected->state);
}

TEST(ProgramForms, ABracketedPrefixBeforeEachLineIsIgnored) {
  const std::string calls =
      "glCombinerParameteriNV(pname=0x854e, param=1)\n"
      "glCombinerInputNV(stage=0x8550, portion=0x1907, variable=0x8523, input=0x84c0, mapping=0x8536, "
      "componentUsage=0x1907)\n";
  const std::string shader =
      "xps.1.1\nxmma t0,discard,discard, t0,c0,0.000000f,0.000000f ; d0=s0*s1\n"
      "+xmma r0.a,discard,discard, v0.a,t0.a,0.000000f,0.000000f\n"
      "xfc 0.000000f, 0.000000f, 0.000000f, t0, 0.000000f, 0.000000f, r0.a\n";
  const auto prefixed = [](const std::string& prefix, std::string text) {
    for (std::size_t at = 0; at < text.size(); at = text.find('\n', at) + 1) {
      text.insert(at, prefix);
    }
    return text;
  };
  expect_same(read_as(ProgramForm::gl, prefixed("[NVRC] ", calls)), read_as(ProgramForm::gl, calls));
  expect_same(read_as(ProgramForm::ps, prefixed("[0x27A0] ", shader)), read_as(ProgramForm::ps, shader));
  const auto faulty = read_as(ProgramForm::gl, "[12] glEnable(0x8522);\n\n[13] glBar();\n");
  ASSERT_EQ(faulty.faults().size(), 1U) << all_faults(faulty);
  EXPECT_EQ(faulty.faults()[0].line, 3);
  EXPECT_EQ(faulty.faults()[0].column, 6);
  // A second prefix, a line without one, and JSON.
  EXPECT_FALSE(read_as(ProgramForm::gl, "[a] [b] glEnable(0x8522);\n"));
  EXPECT_FALSE(read_as(ProgramForm::gl, "[12] glEnable(0x8522);\nglDisable(0x8522);\n"));
  EXPECT_EQ(form_of("[\"a\"]\n"), ProgramForm::words_json);
}

TEST(ProgramForms, CxbxPrintsNumbersForZeroOneAndAHalf) {
  const auto same = [](const std::string& numbers, const std::string& registers) {
    const std::string begin = "xps.1.1\nxmma discard,discard,r0, t0,", end = "\nxfc zero,zero,zero,r0,zero,zero,r0.a\n";
    expect_same(read_as(ProgramForm::ps, begin + numbers + end), read_as(ProgramForm::ps, begin + registers + end));
  };
  same("1.000000f, t1, 0.000000f", "one, t1, zero");
  same("-1.000000f, t1, 0.500000f", "-one, t1, -zero_bias");
  same("-0.500000f, t1, v0", "zero_bias, t1, v0");
  const auto faulty = read_as(ProgramForm::ps, "xps.1.1\nxmma r0,discard,discard, t0,0.25f,zero,zero\n");
  ASSERT_EQ(faulty.faults().size(), 1U);
  EXPECT_TRUE(has(faulty.faults()[0].message, "one of the numbers 0.0, 0.5 and 1.0, found '0.25f'"));
}

TEST(ProgramForms, WordsAreReadByRegistersAddressesAndMembers) {
  const auto expected = read_as(ProgramForm::words,
                                "RC_ENABLE = 0x00011101\nRC_IN_RGB[0] = 0x08040000\nRC_OUT_RGB[0] = 0x000000c0\n"
                                "RC_FINAL0 = 12\nRC_FINAL1 = 7296\n");
  expect_same(read_as(ProgramForm::words,
                      "NV_PGRAPH_COMBINECTL = 0x00011101\nNV_PGRAPH_COMBINECOLORI0 = 0x08040000\n"
                      "NV_PGRAPH_COMBINECOLORO0 = 0x000000c0\nNV_PGRAPH_COMBINESPECFOG0 = 12\n"
                      "NV_PGRAPH_COMBINESPECFOG1 = 7296\n"),
              expected);
  expect_same(read_as(ProgramForm::words,
                      "0x401940 = 0x00011101\n0x401900 = 0x08040000\n0x401920 = 0x000000c0\n0x401944 = 12\n"
                      "0x401948 = 7296\n"),
              expected);
  // Lists with colons, and nv2a-trace's with addresses and both forms of a value; detected, too.
  for (const char* const text :
       {"NV_PGRAPH_COMBINECTL: 0x00011101\nNV_PGRAPH_COMBINECOLORI0: 0x08040000\nNV_PGRAPH_COMBINECOLORO0: 0xc0\n"
        "NV_PGRAPH_COMBINESPECFOG0: 0xc\nNV_PGRAPH_COMBINESPECFOG1: 7296\n",
        "0x401940: 0x00011101\n0x401900: 0x08040000\n0x401920: 0xc0\n0x401944: 0xc\n0x401948: 7296\n",
        "NV_PGRAPH_CTX_CONTROL<0x400144> (1 <0x1>)\nNV_PGRAPH_COMBINECTL<0x401940> (69889 <0x11101>)\n"
        "NV_PGRAPH_COMBINECOLORI0<0x401900> (134479872 <0x8040000>)\nNV_PGRAPH_COMBINECOLORO0<0x401920> (192 <0xC0>)\n"
        "NV_PGRAPH_COMBINESPECFOG0<0x401944> (12 <0xc>)\nNV_PGRAPH_COMBINESPECFOG1<0x401948> (7296 <0x1C80>)\n"}) {
    expect_same(read_as(ProgramForm::words, text), expected);
    EXPECT_EQ(detected_form(text), ProgramForm::words) << text;
  }
  for (const char* const text :
       {"NV_PGRAPH_COMBINECTL<0x401940> (69889 <0x11102>)\n", "NV_PGRAPH_COMBINECTL<0x401944> (69889 <0x11101>)\n",
        "NV_PGRAPH_COMBINECTL<0x401940> (69889)\n", "NV_PGRAPH_COMBINECTL<0x401940>\n"}) {
    EXPECT_FALSE(read_as(ProgramForm::words, text)) << text;
  }
  const auto printed = read_as(ProgramForm::words,
                               "$1 = {combiner_control = 69889, shader_stage_program = 33, other_stage_input = 69632,\n"
                               "  final_inputs_0 = 0xc, final_inputs_1 = 7296, rgb_inputs = {134479872}, rgb_outputs = "
                               "{192}, alpha_test = false, rect_tex = {false, true}, border = {{0, 1}, {2, 3}}}\n");
  expect_same(printed, expected);
  EXPECT_EQ(text_of(printed->other_words),
            "PSTextureModes=0x00000021 PSInputTexture=0x00011000 PSDotMapping=0x00000000 ");
  const std::string small = "$1 = {combiner_control = 0x11102}";
  expect_same(read_as(ProgramForm::words, "\xEF\xBB\xBF# dump of {xemu}\n/* 1 */ " + small),
              read_as(ProgramForm::words, small));
  expect_same(read_as(ProgramForm::words, "\xEF\xBB\xBF/* words */ RC_ENABLE = 0x11102\n"),
              read_as(ProgramForm::words, small));
  // The words of stage 1, by index and by address.
  expect_same(read_as(ProgramForm::words, "NV_PGRAPH_COMBINECOLORI0[1] = 1\nNV_PGRAPH_COMBINEFACTOR1[7] = 2\n"),
              read_as(ProgramForm::words, "0x401904 = 1\n0X4018BC = 2\n"));
  for (const char* text : {"0x401950 = 1\n", "0x1940 = 1\n", "$1 = {a = 1}\n", "$1 = {combiner_control = {1}\n",
                           "$1 = {rgb_inputs = {1, x}}\n", "$1 = {combiner_control = 1.5}\n",
                           "$1 = {combiner_control = 1}\n$2 = {combiner_control = 1}\n"}) {
    EXPECT_FALSE(read_as(ProgramForm::words, text)) << text;
  }
  std::string many = "$1 = {rgb_inputs = {";
  for (int i = 0; i < 100'000; ++i) many += "0,";
  EXPECT_FALSE(read_as(ProgramForm::words, many + "0}}"));
}

TEST(ProgramForms, AssembledShadersAreRead) {
  const auto expected = read_as(ProgramForm::ps,
                                "ps.1.1\ndef c0, 0.2, 0.2, 0.2, 1\ntex t0\nmul_x2_sat r0.rgb, t0, c0\n"
                                "+mov r0.a, 1-t0\n");
  const std::string words =
      "0xffff0101, 0x00000051, 0xa00f0000, 0x3e4ccccd, 0x3e4ccccd, 0x3e4ccccd, 0x3f800000,\n"
      "0x0002fffe, 0x12345678, 0x00000000, 0x00000042, 0xb00f0000, 0x00000005, 0x81170000, 0xb0e40000, 0xa0e40000,\n"
      "0x40000001, 0x80080000, 0xb6e40000, 0x0000ffff";
  expect_same(read_as(ProgramForm::tokens, "// ps\nstatic const DWORD shader[] = {\n" + words + " };\n"), expected);
  std::string file, bytes;
  for (std::size_t at = words.find("0x"); at != std::string::npos; at = words.find("0x", at + 1)) {
    const auto value = static_cast<std::uint32_t>(std::stoul(words.substr(at, 10), nullptr, 16));
    for (int low = 0; low < 32; low += 8) {
      file += static_cast<char>(value >> low & 255);
      bytes += (bytes.empty() ? "" : ", ") + std::to_string(value >> low & 255);
    }
  }
  expect_same(read_as(ProgramForm::tokens, file), expected);
  expect_same(read_as(ProgramForm::tokens, "const BYTE g_ps[] = { " + bytes + " };"), expected);
  const auto mov = read_as(ProgramForm::tokens, "ffff0101 00000001 800f0000 90e40000 0000ffff");
  const std::string array = "DWORD a[] = {0xffff0101, 1, 0x800f0000, 0x90e40000, 0xffff";
  expect_same(read_as(ProgramForm::tokens, array + "};\nunsigned int a_len = 20;\n#endif\n"), mov);
  expect_same(read_as(ProgramForm::tokens, "#if 0\n// compiled\n    ps_1_1\n    mov r0, v0\n#endif\n" + array + "};"),
              mov);
  // 50000000 is a number of def in decimal, and too large for it in hexadecimal.
  EXPECT_TRUE(
      read_as(ProgramForm::tokens, "4294902017, 81, 2685337600, 50000000, 0, 0, 0, 1, 2148466688, 2699296768, 65535"));
  EXPECT_FALSE(is_shader_tokens("1, 1, 255, 255, 255, 255, 0, 0"));
  const std::pair<const char*, const char*> refused[] = {
      {"const DWORD vs[] = { 0xfffe0101, 0x0000ffff };",
       "an assembled vertex shader (vs.1.1), which register combiners"},
      {"ffff0200 0000ffff", "an assembled pixel shader (ps.2.0), which register combiners cannot run"},
      {"static const unsigned long ps[3] = { 4294902017UL, 1, 65535 };", "'mov', which has 2 parameters; found 0"},
      {"ffff0101 00000042 b00f0000", "the tokens have no end; expected 0x0000ffff"},
      {"ffff0101 00000033 0000ffff", "the token 0x00000033 is not an instruction of ps.1.1"},
      {"ffff0101 00000001 830f0000 90e40000 0000ffff", "they have _x2, _x4 and _d2"},
      {"ffff0101 00000001 800f0002 90e40000 0000ffff", "names a register that ps.1.1 does not have"},
      {"ffff0101 00000001 800f0000 90e40000 0000ffff 00000000",
       "the token 0x00000000 stands behind the end of the shader"},
      {"DWORD a[] = {0xffff0101, 1, 0x800f0000, 0x90e40000, 0xffff}; DWORD b[] = {1};", "expected one shader"},
      {"DWORD a[] = {0xffff0101, 1, 0x800f0000,\n#if 0\n0x90e40000,\n#else\n0x90e40001,\n#endif\n0xffff};",
       "2:1: expected a number of 32 bits or '}'; found '#'"},
      {"DWORD a[] = {0xffff0101, 1, 0x800f0000, 0x90e40000, 0xffff}; /* DWORD b[] = {1};",
       "1:62: unterminated comment; expected */"},
      {"DWORD a[] = {0xffff0101, 1, 0x800f0000, 0x90e40000, 0xffff}; mov r0, t0", "1:62: more text stands behind"},
      {"DWORD a[] = {0xffff0101, 1, 0x800f0000, 0x90e40000, 0xffff, garbage -5 };\nfoo bar;",
       "1:61: expected a number of 32 bits or '}'; found 'garbage'"},
      {"DWORD a[] = {0xffff0101, 1, 0x1ffffffff, 0x90e40000, 0xffff };",
       "1:29: expected a number of 32 bits or '}'; found '0x1ffffffff'"},
      {"DWORD a[] = {0xffff0101, 0xffff", "expected a number of 32 bits or '}'; found the end of the text"},
      {"ffff0101 00000001 800f0000 90e4000 0000ffff",
       "1:28: expected a number of 32 bits or the end of the text; found '90e4000'"},
      {"BYTE a[] = {1, 1, 255, 255, 255, 256, 0, 0};", "1:34: the value does not fit in 8 bits"},
      {"BYTE a[] = {1, 1, 255, 255, 255, 255};", "1:29: the last token has 2 of 4 bytes"},
      {"\x01\x01\xff\xff\xff", "1:5: the last token has 1 of 4 bytes"},
      {"ffff0101 00000001 800f0000 901b0000 0000ffff", "reads components in an order that combiners do not have"},
      {"ffff0101 00000001 800f0000 80e40001 0000ffff", "'r1' is read before it is written"}};
  for (const auto& [text, words_of_fault] : refused) {
    const auto program = read_as(ProgramForm::tokens, text);
    EXPECT_TRUE(has(all_faults(program), words_of_fault)) << text;
  }
}

// docs/languages.md lists every form.
TEST(ProgramForms, AreInTheManual) {
  const std::string manual = read_bytes(NINEBIT_SOURCE_DIR "/docs/languages.md");
  std::string from;
  for (const std::string& name : read_form_names()) from += (from.empty() ? "" : "|") + name;
  EXPECT_TRUE(has(manual, "`--from " + from + "`")) << from;
  for (const std::string& name : written_form_names()) {
    EXPECT_TRUE(has(manual, "`" + name + "`")) << name;
  }
}

TEST(ProgramForms, EveryShapeOfADefinitionAndEveryLogIsDetected) {
  for (int i = 0; i < cases_here(50); ++i) {
    Random random(121, static_cast<std::uint64_t>(i));
    const Words words = random_words(random);
    for (const Shape& shape : all_shapes()) {
      const std::string text = shape.text(words);
      ASSERT_EQ(form_of(text), ProgramForm::xbox) << shape.name << '\n' << text;
    }
    const Trace trace = random_trace(random);
    for (const TraceStyle& style : all_styles()) {
      const std::string text = style.text(trace);
      ASSERT_EQ(form_of(text), ProgramForm::log) << style.name << '\n' << text;
    }
  }
}

TEST(ProgramForms, OtherFormsAreDetectedAsBefore) {
  const std::pair<const char*, ProgramForm> texts[] = {
      {"", ProgramForm::gl},
      {"glEnable(GL_REGISTER_COMBINERS_NV);", ProgramForm::gl},
      {"// PSRGBInputs\nglEnable(GL_REGISTER_COMBINERS_NV);", ProgramForm::gl},
      {"/* c */ !!RC1.0\n", ProgramForm::rc10},
      {"; c\n#define X\nps.1.1\n", ProgramForm::ps},
      {"XPS.1.1\n", ProgramForm::ps},
      {"ps_1_4\n", ProgramForm::ps},
      {"!!PS1.0\n", ProgramForm::ps},
      {"\"ps.1.1\\n\"\n\"mov r0, v0\\n\"", ProgramForm::source},
      {"ps.2.0\n", ProgramForm::gl},
      {"RC_IN_RGB[0] = 0x08040000\n", ProgramForm::words},
      {"SET_COMBINER_COLOR_ICW[0] = 0x08040000\nNV097_SET_BEGIN_END = 5\n", ProgramForm::words},
      {"{\"RC_IN_RGB[0]\": \"0x08040000\"}", ProgramForm::words_json},
      {"{\"ninebit\": \"program\", \"version\": 1}", ProgramForm::json},
      {"{}", ProgramForm::words_json},
      {"PSRGBInputs[0] = 0x08040000\n", ProgramForm::xbox},
      {"PSRGBInput[0] = 0x08040000\n", ProgramForm::xbox},
      {"{ 0x1, 0x2 }", ProgramForm::xbox},
      {"class,method,data\n0x97,0x1e60,0x101\n", ProgramForm::log},
  };
  for (const auto& [text, form] : texts) EXPECT_EQ(form_of(text), form) << text;
}

TEST(ProgramForms, OtherWordsGoThroughWordsAndJson) {
  for (int i = 0; i < (kSlowBuild ? 100 : 600); ++i) {
    Random random(122, static_cast<std::uint64_t>(i));
    const auto first = parse_program({as_bytes(random_words(random)), ""}, ProgramForm::xbox, kFormsProfile);
    ASSERT_TRUE(first) << all_faults(first);
    const CombinerState& state = first->state;
    const std::vector<RegisterWord>& words = first->other_words;
    const std::pair<ProgramForm, std::string> texts[] = {
        {ProgramForm::words, *print_register_words(state, ChipClass::nv20, kFormsProfile, words)},
        {ProgramForm::words_json, *print_json_register_words(state, ChipClass::nv20, kFormsProfile, words)},
        {ProgramForm::json, print_json_program(state, words)},
        {ProgramForm::xbox, *print_xbox_pixel_shader(state, kFormsProfile, words)},
    };
    for (const auto& [form, text] : texts) {
      ASSERT_EQ(form_of(text), form) << text;
      const auto back = parse_program({text, ""}, form, kFormsProfile);
      ASSERT_TRUE(back) << all_faults(back) << text;
      ASSERT_EQ(text_of(back->other_words), text_of(words)) << text;
      ASSERT_EQ(normalize(back->state, kFormsProfile), normalize(state, kFormsProfile)) << text;
    }
    EXPECT_FALSE(has(*print_register_words(state, ChipClass::nv20, kFormsProfile), "PSTextureModes"));
  }
}

TEST(ProgramForms, OtherWordsHaveTheirMethodsNames) {
  std::vector<RegisterWord> found;
  const std::string text =
      "NV097_SET_SHADER_STAGE_PROGRAM = 1\nTEX_SHADER_CULL_MODE = 2\nSET_DOT_RGBMAPPING = "
      "3\nNV20_3D_TEX_SHADER_PREVIOUS = 4\n"
      "psc0mapping = 5\n";
  ASSERT_TRUE(parse_register_words({text, ""}, ChipClass::nv20, kFormsProfile, &found));
  EXPECT_EQ(text_of(found),
            "PSTextureModes=0x00000001 PSCompareMode=0x00000002 PSDotMapping=0x00000003 PSInputTexture=0x00000004 "
            "PSC0Mapping=0x00000005 ");
  EXPECT_EQ(found[1].place.line, 2);
  const auto twice =
      parse_register_words({"PSTextureModes = 1\nTEX_SHADER_OP = 1", "f"}, ChipClass::nv20, kFormsProfile);
  EXPECT_EQ(all_faults(twice), "f:2:1: PSTextureModes was given before, in line 1\n");
  const auto nv10 = parse_register_words({"PSTextureModes = 1", "f"}, ChipClass::nv10, profiles::geforce2);
  EXPECT_EQ(all_faults(nv10), "f:1:1: PSTextureModes is a word of NV20, not of NV10\n");
  const auto json = parse_json_program(
      {R"({"ninebit": "program", "version": 1, "other_words": {"PSTextureMode": 1}})", "f"}, kFormsProfile);
  EXPECT_EQ(all_faults(json),
            "f:1:54: unknown word \"PSTextureMode\"; expected PSTextureModes, …; did you mean 'PSTextureModes'?\n");
}

TEST(ProgramForms, ASetUpOfALogIsPickedByItsNumber) {
  const std::string log = "method,data\n0x1e60,0x101\n0x17fc,5\n0x17fc,0\n0x1e60,0x102\n0x17fc,5\n0x17fc,0\n";
  EXPECT_EQ(parse_program({log, "f"}, ProgramForm::log, kFormsProfile, {.setup = 1})->state.num_general_combiners, 1);
  EXPECT_EQ(parse_program({log, "f"}, ProgramForm::log, kFormsProfile, {.setup = 2})->state.num_general_combiners, 2);
  EXPECT_FALSE(parse_program({log, "f"}, ProgramForm::log, kFormsProfile));
  EXPECT_FALSE(parse_program({log, "f"}, ProgramForm::log, kFormsProfile, {.setup = 3}));
  const auto faulty = parse_program({"method,data\n?,1\n", "f"}, ProgramForm::log, kFormsProfile);
  EXPECT_EQ(all_faults(faulty).substr(0, 26), "f:2:1: '?' is not a method");
}

}  // namespace
}  // namespace ninebit::test

// The Xbox's pixel shader definition: its shapes, macros, missing words, and every fault.
#include "ninebit/language/xbox_pixel_shader.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <ctime>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/language/xbox_shapes.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

const HardwareProfile& kShaderProfile = profiles::nv2a;

std::vector<RegisterWord> other_words_of(const std::string& text) {
  std::vector<RegisterWord> found;
  const auto parsed = parse_xbox_pixel_shader({text, "psd"}, kShaderProfile, &found);
  EXPECT_TRUE(parsed) << text << all_faults(parsed);
  return found;
}

// The value of an expression: as a word that is kept as it is.
std::uint32_t value_of(const std::string& expression) {
  const std::string text = "PSCombinerCount = 1;\nPSC0Mapping = " + expression;
  for (const RegisterWord& word : other_words_of(text)) {
    if (word.name == "PSC0Mapping") return word.value;
  }
  ADD_FAILURE() << expression;
  return 0;
}

TEST(XboxPixelShader, EveryShapeGivesTheStateOfItsRegisterWords) {
  for (int i = 0; i < (kSlowBuild ? 15 : 100); ++i) {
    Random random(81, static_cast<std::uint64_t>(i));
    const Words words = random_words(random);
    const auto expected = parse_register_words({as_register_words(words), ""}, ChipClass::nv20, kShaderProfile);
    ASSERT_TRUE(expected) << all_faults(expected);
    for (const Shape& shape : all_shapes()) {
      const std::string text = shape.text(words);
      ASSERT_TRUE(is_xbox_pixel_shader(text)) << shape.name << '\n' << text;
      std::vector<RegisterWord> other_words;
      const auto parsed = parse_xbox_pixel_shader({text, ""}, kShaderProfile, &other_words);
      ASSERT_TRUE(parsed) << "state " << i << ", " << shape.name << ": " << all_faults(parsed) << text;
      ASSERT_EQ(*parsed, *expected) << "state " << i << ", " << shape.name << '\n' << text;
      ASSERT_TRUE(parsed.notes.empty()) << shape.name << ": " << parsed.notes[0].text();
      ASSERT_EQ(other_words.size(), kOtherWordNames.size()) << shape.name;
      for (std::size_t k = 0; k < other_words.size(); ++k) {
        const auto member = std::find_if(kMembers.begin(), kMembers.end(),
                                         [&](const Member& one) { return one.name == other_words[k].name; });
        ASSERT_EQ(other_words[k].name, kOtherWordNames[k]);
        ASSERT_EQ(other_words[k].value, words[member->first]) << shape.name << ", " << member->name;
      }
    }
  }
}

TEST(XboxPixelShader, PrintedInitializersGiveTheSameProgramAndWords) {
  for (int i = 0; i < (kSlowBuild ? 60 : 1000); ++i) {
    Random random(82, static_cast<std::uint64_t>(i));
    std::vector<RegisterWord> words, again;
    const auto first = parse_xbox_pixel_shader({as_bytes(random_words(random)), ""}, kShaderProfile, &words);
    ASSERT_TRUE(first) << all_faults(first);
    const auto text = print_xbox_pixel_shader(*first, kShaderProfile, words);
    ASSERT_TRUE(text) << text.error().message;
    const auto back = parse_xbox_pixel_shader({*text, "printed"}, kShaderProfile, &again);
    ASSERT_TRUE(back) << all_faults(back) << *text;
    ASSERT_TRUE(back.notes.empty()) << back.notes[0].text();
    ASSERT_EQ(normalize(*back, kShaderProfile), normalize(*first, kShaderProfile)) << "state " << i << '\n' << *text;
    for (std::size_t k = 0; k < words.size(); ++k) ASSERT_EQ(again[k].value, words[k].value) << words[k].name << *text;
    ASSERT_EQ(*print_xbox_pixel_shader(*back, kShaderProfile, again), *text) << "state " << i;
  }
}

// '*' stands for as many rows as the offsets around it leave room for.
TEST(XboxPixelShader, RepeatedRowsOfADump) {
  const std::string zeros = " 0000 0000 0000 0000 0000 0000 0000 0000\n";
  const std::string last = " 0000 0000 0100 0000 2143 0000 0000 0000\n";
  const auto words = other_words_of("00000000:" + zeros + "*\n000000d0:" + last + "000000e0:" + zeros);
  for (const RegisterWord& word : words)
    EXPECT_EQ(word.value, word.name == "PSTextureModes" ? 0x4321U : 0U) << word.name;
  ASSERT_EQ(words.size(), kOtherWordNames.size());
  // A row is missing behind it, and one row too many is there.
  const auto jumps =
      parse_xbox_pixel_shader({"00000000:" + zeros + "*\n000000d0:" + zeros + "000000f0:" + zeros, ""}, kShaderProfile);
  ASSERT_EQ(jumps.faults().size(), 1U) << all_faults(jumps);
  EXPECT_TRUE(has(jumps.faults()[0].message, "the offsets do not fit the rows")) << all_faults(jumps);
}

TEST(XboxPixelShader, MissingWordsAreZeroAndNotGlsDefaults) {
  const auto parsed = parse_xbox_pixel_shader({"psd.PSCombinerCount = 0x11102;\n", ""}, kShaderProfile);
  ASSERT_TRUE(parsed) << all_faults(parsed);
  const CombinerState& state = *parsed;
  EXPECT_EQ(state.num_general_combiners, 2);
  // GL's default writes the sum to spare0; a word of 0 discards all.
  for (const GeneralCombiner& stage : state.general) {
    EXPECT_EQ(stage.rgb.out.sum, Register::discard);
    EXPECT_EQ(stage.alpha.out.sum, Register::discard);
    EXPECT_EQ(stage.rgb.a.reg, Register::zero);
  }
  // Two words of 0 leave the final combiner out.
  EXPECT_EQ(state.final_combiner.d.reg, Register::spare0);
  EXPECT_EQ(state.final_combiner.g.reg, Register::spare0);
  EXPECT_FALSE(
      parse_register_words({"PSCombinerCount = 0x11102\n", ""}, ChipClass::nv20, kShaderProfile)->general[0].rgb.out ==
      state.general[0].rgb.out);
  for (const RegisterWord& word : other_words_of("PSCombinerCount = 1")) EXPECT_EQ(word.value, 0U) << word.name;
}

TEST(XboxPixelShader, MacrosHaveTheValuesOfTheHeaders) {
  const std::pair<const char*, std::uint32_t> values[] = {
      {"PS_COMBINERINPUTS(PS_REGISTER_T0 | PS_CHANNEL_RGB | PS_INPUTMAPPING_EXPAND_NORMAL, PS_REGISTER_C0, "
       "PS_REGISTER_ZERO | PS_INPUTMAPPING_UNSIGNED_INVERT, PS_REGISTER_R1 | PS_CHANNEL_ALPHA)",
       0x4801201d},
      {"PS_COMBINERINPUTS(PS_REGISTER_ONE, PS_REGISTER_NEGATIVE_ONE, PS_REGISTER_ONE_HALF, "
       "PS_REGISTER_NEGATIVE_ONE_HALF)",
       0x2040a080},
      {"PS_COMBINERINPUTS(PS_REGISTER_V1R0_SUM, PS_REGISTER_EF_PROD, PS_REGISTER_FOG | PS_CHANNEL_ALPHA, "
       "PS_FINALCOMBINERSETTING_CLAMP_SUM | PS_FINALCOMBINERSETTING_COMPLEMENT_V1)",
       0x0e0f13c0},
      {"PS_COMBINEROUTPUTS(PS_REGISTER_R0, PS_REGISTER_R1, PS_REGISTER_T2, PS_COMBINEROUTPUT_SHIFTLEFT_2 | "
       "PS_COMBINEROUTPUT_AB_DOT_PRODUCT | PS_COMBINEROUTPUT_AB_CD_MUX)",
       0x00026acd},
      {"PS_COMBINEROUTPUTS(PS_REGISTER_DISCARD, PS_REGISTER_DISCARD, PS_REGISTER_V0, "
       "PS_COMBINEROUTPUT_SHIFTLEFT_1_BIAS | PS_COMBINEROUTPUT_CD_DOT_PRODUCT | PS_COMBINEROUTPUT_AB_BLUE_TO_ALPHA)",
       0x00099400},
      {"PS_COMBINERCOUNT(7, PS_COMBINERCOUNT_MUX_MSB | PS_COMBINERCOUNT_UNIQUE_C0 | PS_COMBINERCOUNT_UNIQUE_C1)",
       0x00011107},
      {"PS_TEXTUREMODES(PS_TEXTUREMODES_PROJECT2D, PS_TEXTUREMODES_BUMPENVMAP, PS_TEXTUREMODES_DOTPRODUCT, "
       "PS_TEXTUREMODES_DOT_RFLCT_SPEC_CONST)",
       1 | 6 << 5 | 0x11 << 10 | 0x12 << 15},
      {"PS_DOTMAPPING(0, PS_DOTMAPPING_MINUS1_TO_1_D3D, PS_DOTMAPPING_HILO_1, PS_DOTMAPPING_HILO_HEMISPHERE)", 0x741},
      {"PS_COMPAREMODE(PS_COMPAREMODE_S_GE | PS_COMPAREMODE_T_GE, 0, PS_COMPAREMODE_Q_GE, PS_COMPAREMODE_R_GE)",
       0x4803},
      {"PS_INPUTTEXTURE(0, 0, 1, 2)", 0x00210000},
      {"PS_CONSTANTMAPPING(0, 1, 2, 3, 4, 5, 6, 15)", 0xf6543210},
      {"PS_CONSTANTMAPPING(16, 17, 0, 0, 0, 0, 0, 0)", 0x10},  // the macro cuts, as in C
      {"PS_FINALCOMBINERCONSTANTS(3, 12, PS_GLOBALFLAGS_TEXMODE_ADJUST)", 0x1c3},
      {"D3DCOLOR_ARGB(1, 2, 3, 255)", 0x010203ff},
      {"D3DCOLOR_RGBA(1, 2, 3, 255)", 0xff010203},
      {"D3DCOLOR_XRGB(1, 2, 3)", 0xff010203},
  };
  for (const auto& [expression, value] : values) EXPECT_EQ(value_of(expression), value) << expression;
}

TEST(XboxPixelShader, ExpressionsFollowC) {
  const std::pair<const char*, std::uint32_t> values[] = {
      {"0x10 | 0x2 | 1", 0x13},
      {"1 << 4 | 3", 0x13},
      {"1 << (4 | 3)", 0x80},
      {"1 << 2 + 3", 0x20},  // + binds closer
      {"0xff & ~0xf", 0xf0},
      {"6 ^ 3 & 1", 7},
      {"10 - 3 - 2", 5},
      {"0xf0 >> 4", 0xf},
      {"0xf0000000 << 4", 0},
      {"~0", 0xffffffff},
      {"-1", 0xffffffff},
      {"- - 1 + + 2", 3},
      {"((((7))))", 7},
      {"(DWORD)0x80000000UL", 0x80000000},
      {"~0 >> 4", 0x0fffffff},
      {"~0xffffffff", 0},
      {"(unsigned long)(017 + 9)", 24},
      {"4294967295", 0xffffffff},
      {"0X1fL", 0x1f},
  };
  for (const auto& [expression, value] : values) EXPECT_EQ(value_of(expression), value) << expression;
}

TEST(XboxPixelShader, PublishedHabits) {
  // Bits that are added, blanks anywhere, a second statement in a line, words of other case.
  const std::string text =
      "D3DPIXELSHADERDEF psd;\n"
      "memset(&psd, 0, sizeof(psd));\n"
      "psd.PSRGBInputs[ 0 ]=PS_COMBINERINPUTS( PS_REGISTER_T0|PS_CHANNEL_RGB,\n"
      "                                        PS_REGISTER_V0|PS_CHANNEL_RGB, 0, 0 ); psd.psrgboutputs[0] =\n"
      "  PS_COMBINEROUTPUTS(PS_REGISTER_R0, 0, 0, 0)  # the product\n"
      "psd.PSRGBOutputs[0] |= PS_COMBINEROUTPUT_SHIFTLEFT_1 << 12;\n"
      "psd.PSAlphaOutputs[1] |= 0;;\n"
      "psd.PSConstant0 = { 1, [3] = 2, };\n"
      "psd.PSCombinerCount = PS_COMBINERCOUNT(1, 0);\n";
  const auto parsed = parse_xbox_pixel_shader({text, "psd"}, kShaderProfile);
  ASSERT_TRUE(parsed) << all_faults(parsed);
  const auto words = parse_register_words(
      {"RC_IN_RGB[0] = 0x08040000\nRC_OUT_RGB[0] = 0x000100c0\nRC_ENABLE = 1\nRC_IN_ALPHA[0] = 0\nRC_OUT_ALPHA[0] = 0\n"
       "RC_FINAL0 = 0\nRC_FINAL1 = 0\n",
       ""},
      ChipClass::nv20, kShaderProfile);
  ASSERT_TRUE(words) << all_faults(words);
  EXPECT_EQ(normalize(*parsed, kShaderProfile), normalize(*words, kShaderProfile));
}

TEST(XboxPixelShader, CallsAreSkippedAndNoted) {
  const std::string text =
      "PSCombinerCount = 1;\nm_pDevice->CreatePixelShader( &psd, f(&shader)[2] );\nassert(hr == S_OK);\nXMemSet(&psd, "
      "0, 240);\n";
  const auto parsed = parse_xbox_pixel_shader({text, "f"}, kShaderProfile);
  ASSERT_TRUE(parsed) << all_faults(parsed);
  ASSERT_EQ(parsed.notes.size(), 2U);
  EXPECT_EQ(parsed.notes[0].text(), "f:2:1: the call of CreatePixelShader is skipped");
  EXPECT_EQ(parsed.notes[1].text(), "f:3:1: the call of assert is skipped");
}

TEST(XboxPixelShader, AFewWordsInBracesAreNoted) {
  const auto few = parse_xbox_pixel_shader({"D3DPIXELSHADERDEF psd = { {0}, 0xc, 0x1c80 };", "f"}, kShaderProfile);
  EXPECT_FALSE(few);  // no general combiner
  ASSERT_EQ(few.notes.size(), 1U);
  EXPECT_EQ(few.notes[0].text(), "f:1:25: the first 10 of 60 words are given; the others are 0");
  EXPECT_TRUE(parse_xbox_pixel_shader({"D3DPIXELSHADERDEF psd = {0};", "f"}, kShaderProfile).notes.empty());
  const auto designated =
      parse_xbox_pixel_shader({"D3DPIXELSHADERDEF psd = {.PSCombinerCount = 1};", "f"}, kShaderProfile);
  ASSERT_TRUE(designated) << all_faults(designated);
  EXPECT_TRUE(designated.notes.empty());
  const auto older = parse_xbox_pixel_shader({"PSCombinerCount = 1", "f"}, profiles::geforce2);
  ASSERT_TRUE(older) << all_faults(older);
  ASSERT_EQ(older.notes.size(), 1U);
  EXPECT_TRUE(has(older.notes[0].message, "nv2a is the Xbox's profile"));
}

void expect_refused(const PlacedFault& fault, std::string_view text) {
  expect_fault(parse_xbox_pixel_shader({text, "f"}, kShaderProfile), fault, text);
}

TEST(XboxPixelShader, EveryFaultHasItsPlace) {
  const std::pair<const char*, PlacedFault> faults[] = {
      {"", {1, 1, "expected a D3DPIXELSHADERDEF"}},
      {"psd.PSRGBInput[0] = 1;",
       {1, 5, "'PSRGBInput' is not a member of D3DPIXELSHADERDEF; did you mean 'PSRGBInputs'?"}},
      {"psd.RC_IN_RGB[0] = 1;", {1, 5, "register words are another form: --from words"}},
      {"psd.Banana = 1;", {1, 5, "'Banana' is not a member of D3DPIXELSHADERDEF"}},
      {"psd.PSRGBInputs[8] = 1;", {1, 5, "PSRGBInputs[8] is out of range; expected an index from 0 to 7"}},
      {"psd.PSRGBInputs = 1;", {1, 5, "PSRGBInputs needs an index from 0 to 7"}},
      {"psd.PSTextureModes[0] = 1;", {1, 5, "PSTextureModes is one word; expected no index"}},
      {"psd.PSRGBInputs[0][1] = 1;", {1, 19, "expected '='; found '['"}},
      {"psd.PSDotMapping = PS_DOTMAPPING(8, 0, 0, 0);",
       {1, 34, "argument 1 of PS_DOTMAPPING is 0x08; expected 0 to 0x07"}},
      {"psd.PSRGBInputs[0] 1;", {1, 20, "expected '=' after PSRGBInputs; found '1'"}},
      {"psd.PSRGBInputs[0] = ;", {1, 22, "expected a value; found ';'"}},
      {"psd.PSRGBInputs[0] = 0xfffffffff;", {1, 22, "the value does not fit in 32 bits"}},
      {"psd.PSRGBInputs[0] = 0x8040000g;", {1, 22, "'0x8040000g' is not a number"}},
      {"psd.PSRGBInputs[0] = 1 << 32;", {1, 24, "a shift by 32 bits is out of range; expected 0 to 31"}},
      {"psd.PSRGBInputs[0] = 0xffffffff + 1;", {1, 33, "does not fit in 32 bits"}},
      {"psd.PSRGBInputs[0] = (1;", {1, 24, "expected ')'; found ';'"}},
      {"psd.PSRGBInputs[0] = PS_REGISTER_T5;",
       {1, 22, "unknown name 'PS_REGISTER_T5'; did you mean 'PS_REGISTER_T0'?"}},
      {"psd.PSRGBInputs[0] = PS_COMBINERINPUT(1, 2, 3, 4);", {1, 22, "did you mean 'PS_COMBINERINPUTS'?"}},
      {"psd.PSRGBInputs[0] = PS_COMBINERINPUTS(1, 2, 3);", {1, 22, "PS_COMBINERINPUTS has 3 arguments; expected 4"}},
      {"psd.PSRGBInputs[0] = PS_COMBINERINPUTS(1, 2, 3, 4, 5);", {1, 22, "has 5 arguments; expected 4"}},
      {"psd.PSRGBInputs[0] = PS_COMBINERINPUTS;", {1, 39, "expected '(' and the 4 arguments of PS_COMBINERINPUTS"}},
      {"psd.PSRGBInputs[0] = PS_COMBINERINPUTS(1, 0x100, 3, 4);",
       {1, 43, "argument 2 of PS_COMBINERINPUTS is 0x0100; expected 0 to 0xff"}},
      {"psd.PSRGBOutputs[0] = PS_COMBINEROUTPUTS(16, 0, 0, 0);",
       {1, 42, "argument 1 of PS_COMBINEROUTPUTS is 0x10; expected 0 to 0x0f"}},
      {"psd.PSTextureModes = PS_TEXTUREMODES(0, 32, 0, 0);", {1, 41, "expected 0 to 0x1f"}},
      {"a.PSCombinerCount = 1;\nb.PSTextureModes = 1;",
       {2, 3, "a member of 'b', but of 'a' in line 1; a text has one definition"}},
      {"PSCombinerCount = 1\nPSCombinerCount = 1", {2, 1, "PSCombinerCount was given before, in line 1"}},
      {"#include <xtl.h>\nPSCombinerCount = 1", {1, 1, "lines of the preprocessor are not read"}},
      {"PSCombinerCount = 1; /* open", {1, 22, "unterminated comment; expected */"}},
      {"psd.PSConstant0[0] = (BYTE)0x1ff;", {1, 28, "the value does not fit in 8 bits"}},
      {"psd.PSConstant0[0] = 1 | (WORD)(1 << 16);", {1, 32, "the value does not fit in 16 bits"}},
      {"PSCombinerCount = 1; // one\rPSNoSuchThing = 1", {1, 29, "'PSNoSuchThing'"}},
      {"D3DPIXELSHADERDEF psd = {1, 2\nPS_REGISTER_C0, 3};", {2, 1, "expected ',' or '}' after a word"}},
      {"D3DPIXELSHADERDEF psd = {1, 2", {1, 30, "expected ',' or '}' after a word; found the end of the text"}},
      {"D3DPIXELSHADERDEF psd = {{1, 2, 3, 4, 5, 6, 7, 8, 9}};", {1, 51, "PSAlphaInputs has 8 words; found more: '9'"}},
      {"D3DPIXELSHADERDEF psd = {{0}, {1, 2}};", {1, 35, "PSFinalCombinerInputsABCD has 1 word; found more: '2'"}},
      {"D3DPIXELSHADERDEF psd = {1, {2}};", {1, 29, "'{' within PSAlphaInputs; expected PSAlphaInputs[1]"}},
      {"D3DPIXELSHADERDEF psd = {.PSConstant2 = {0}};", {1, 27, "did you mean 'PSConstant0'?"}},
      {"D3DPIXELSHADERDEF psd = {.PSConstant0 = {[8] = 1}};", {1, 42, "PSConstant0[8] is out of range"}},
      {"D3DPIXELSHADERDEF psd = {0};\nD3DPIXELSHADERDEF b = {0};",
       {2, 23, "a second definition; the first is in line 1"}},
      {"D3DPIXELSHADERDEF psd = f();", {1, 25, "expected '{' and the words of the definition"}},
      {"{1 2}", {1, 4, "expected ',' or '}' after a word; found '2'"}},
      {"psd.PSCombinerCount = 1;\n}", {2, 1, "expected a D3DPIXELSHADERDEF"}},
      {"glEnable(GL_REGISTER_COMBINERS_NV);", {1, 1, "expected a D3DPIXELSHADERDEF"}},
      {"D3DPIXELSHADERDEF psd;", {1, 1, "expected a D3DPIXELSHADERDEF"}},
      {"memset(&psd, 0xff, 240);\nPSCombinerCount = 1", {1, 14, "expected 0, as memset is read only to clear"}},
      {"psd.PSCombinerCount(", {1, 21, "expected ')'; found the end of the text"}},
      {"psd. = 1;", {1, 6, "expected a member of D3DPIXELSHADERDEF; found '='"}},
      {"0x1 0x2 0x3 0x4", {1, 13, "4 words of 32 bits; expected the 60 of a D3DPIXELSHADERDEF"}},
      {"00 01 02 03 04", {1, 13, "5 bytes; expected the 240 of a D3DPIXELSHADERDEF"}},
      {"00000000 00000001 00000002 00000003 0000",
       {1, 37, "'0000' is not a number of this list; expected 8 hexadecimal"}},
      {"0x1, 0x2, 0x3, 0x4, 17", {1, 21, "'17' is not a number of this list; expected 0x and up to 8"}},
      {"00 01 02 03\n*\n04 05 06 07", {2, 1, "'*' stands for repeated rows, but not for how many; expected offsets"}},
      {"0000: 00 01 02 03\n*\n", {2, 1, "'*' stands for repeated rows, but not for how many; expected offsets"}},
      {"0000: 00 01 02 03\n*\n0006: 04 05", {2, 1, "but the offsets do not fit the rows"}},
      {"0000: 00 01 02 03\n*\nfffffffffffffff0: 04", {2, 1, "more than 1000 bytes"}},
      {"DWORD ps[3] = { 1, 2, 3 };", {1, 23, "3 words of 32 bits; expected the 60 of a D3DPIXELSHADERDEF"}},
      {"const BYTE ps[] = {1, 2};", {1, 23, "2 bytes; expected the 240 of a D3DPIXELSHADERDEF"}},
      {"WORD ps[] = {};", {1, 13, "0 words of 16 bits; expected the 120 of a D3DPIXELSHADERDEF"}},
      {"DWORD ps[] = {1 2};", {1, 17, "expected ',' or '}' after a number; found '2'"}},
      {"DWORD ps[] = {1, 2", {1, 19, "expected ',' or '}' after a number; found the end of the text"}},
      {"DWORD ps[] = {1, {2}};", {1, 18, "expected a value; found '{'"}},
  };
  for (const auto& [text, fault] : faults) expect_refused(fault, text);
}

TEST(XboxPixelShader, BytesOfAnotherCountAreRefused) {
  Random random(83);
  const std::string bytes = as_bytes(random_words(random));
  expect_refused({1, 1, "239 bytes; expected the 240 of one D3DPIXELSHADERDEF"},
                 std::string_view(bytes).substr(0, 239));
  expect_refused({1, 1, "480 bytes, which are 2 definitions; expected the 240"}, bytes + bytes);
  EXPECT_FALSE(is_xbox_pixel_shader(bytes + bytes));
}

TEST(XboxPixelShader, AFileOfTheDevelopmentKitHasAMagicBefore) {
  Random random(85);
  const std::string bytes = as_bytes(random_words(random)), file = "PSB0" + bytes;
  ASSERT_TRUE(is_xbox_pixel_shader(file));
  const auto expected = parse_xbox_pixel_shader({bytes, ""}, profiles::nv2a);
  const auto program = parse_xbox_pixel_shader({file, ""}, profiles::nv2a);
  ASSERT_TRUE(expected && program) << all_faults(program);
  EXPECT_EQ(*program, *expected);
  expect_refused({1, 1, "a file 'PSB0' of 243 bytes; expected 244, the magic and one D3DPIXELSHADERDEF"},
                 std::string_view(file).substr(0, 243));
  expect_refused({1, 1, "a file 'PSB0' of 484 bytes; expected 244"}, file + bytes);
}

TEST(XboxPixelShader, CountsOfListsAreChecked) {
  Random random(84);
  const Words words = random_words(random);
  for (const Shape& shape : all_shapes()) {
    std::string text = shape.text(words);
    const bool is_list = text.find('=') == std::string::npos && text.find('{') == std::string::npos &&
                         std::string(shape.name) != "binary";
    if (!is_list) continue;
    text = text.substr(0, text.size() / 2);
    const auto parsed = parse_xbox_pixel_shader({text, ""}, kShaderProfile);
    EXPECT_FALSE(parsed) << shape.name;
    EXPECT_TRUE(has(all_faults(parsed), "of a D3DPIXELSHADERDEF")) << shape.name;
  }
}

TEST(XboxPixelShader, WhatTheChipOrOpenGlRefusesIsAtItsWord) {
  const std::pair<const char*, PlacedFault> faults[] = {
      {"psd.PSCombinerCount = 9;", {1, 5, "GL_INVALID_VALUE: PSCombinerCount = 0x00000009: bits 3..0"}},
      {"psd.PSTextureModes = 0;", {1, 1, "GL_INVALID_VALUE: PSCombinerCount = 0x00000000"}},
      {"psd.PSCombinerCount = 1;\npsd.PSRGBInputs[3] = 0x06000000;", {2, 5, "PSRGBInputs[3] = 0x06000000: variable A"}},
      {"psd.PSCombinerCount = 1;\npsd.PSRGBOutputs[0] = 0xccc;", {2, 5, "GL_INVALID_OPERATION"}},
      {"psd.PSCombinerCount = 1;\npsd.PSAlphaOutputs[0] = 0x00100000;",
       {2, 5, "PSAlphaOutputs[0] = 0x00100000: bit 20"}},
      {"psd.PSCombinerCount = 1;\npsd.PSFinalCombinerInputsABCD = 0x40000000;", {2, 5, "bit 30 must be 0"}},
  };
  for (const auto& [text, fault] : faults) expect_refused(fault, text);
  // Every fault of a text that is a definition has GL's error, so `validate` can answer with 1.
  const auto refused = parse_xbox_pixel_shader({"PSCombinerCount = 9", ""}, kShaderProfile);
  ASSERT_EQ(refused.faults().size(), 1U);
  EXPECT_EQ(refused.faults()[0].gl_error, GlError::invalid_value);
}

TEST(XboxPixelShader, AllFaultsComeAtOnce) {
  const std::string text =
      "psd.PSRGBInput[0] = 1;\npsd.PSTextureModes = PS_TEXTUREMODE(1) | PS_NOTHING;\npsd.PSRGBOutputs[9] = 0x1g;\n"
      "psd.PSCombinerCount = (1;\npsd.PSDotMapping 3;\npsd.PSInputTexture = 1;\npsd.PSInputTexture = 1;\n";
  const auto parsed = parse_xbox_pixel_shader({text, "f"}, kShaderProfile);
  std::vector<int> lines;
  for (const TextFault& fault : parsed.faults()) lines.push_back(fault.line);
  EXPECT_EQ(lines, (std::vector<int>{1, 2, 2, 3, 3, 4, 5, 7})) << all_faults(parsed);
}

TEST(XboxPixelShader, OtherWordsAreExplained) {
  const auto said = [](const char* name, std::uint32_t value) {
    std::string text;
    for (const std::string& phrase : explain_other_word({name, value, {}})) text += phrase + '\n';
    return text;
  };
  EXPECT_EQ(said("PSTextureModes", 1 | 1 << 5 | 3 << 10 | 0x13U << 15 | 1U << 31),
            "textures 0 to 1: PROJECT2D (2D, projective)\ntexture 2: CUBEMAP (cube map)\n"
            "texture 3: reserved mode 0x13\nunknown bit 31\n");
  EXPECT_EQ(said("PSDotMapping", 0x741), "texture 1: MINUS1_TO_1_D3D\ntexture 2: HILO_1\ntexture 3: HILO_HEMISPHERE\n");
  EXPECT_EQ(said("PSCompareMode", 0x000f),
            "texture 0: a clip plane keeps s ≥ 0, t ≥ 0, r ≥ 0, q ≥ 0\n"
            "textures 1 to 3: a clip plane keeps s < 0, t < 0, r < 0, q < 0\n");
  EXPECT_EQ(said("PSInputTexture", 0x00210000),
            "texture 1: reads texture 0\ntexture 2: reads texture 1\ntexture 3: reads texture 2\n");
  EXPECT_EQ(said("PSC1Mapping", 0xfffffff3),
            "stage 0: const1 is Direct3D's c3\nstages 1 to 7: const1 is Direct3D's c15, or none\n");
  EXPECT_EQ(said("PSFinalCombinerConstants", 0x1c3),
            "final combiner: const0 is Direct3D's c3\nfinal combiner: const1 is Direct3D's c12\n"
            "texture modes follow the kind of the texture that is set\n");
  EXPECT_EQ(said("RC_ENABLE", 1), "");
}

TEST(XboxPixelShader, OtherTextsAreNot) {
  for (const char* text : {"", "{}", "{\"ninebit\": \"program\"}", "!!RC1.0\n", "glCombinerInputNV(1, 2, 3, 4, 5, 6);",
                           "RC_IN_RGB[0] = 0x08040000", "const GLfloat PSALM[4] = {1, 0, 0, 1};", "# only a comment",
                           "face off", "[1, 2]", "12 34", "PS_COMBINERINPUTS(1, 2, 3, 4)"}) {
    EXPECT_FALSE(is_xbox_pixel_shader(text)) << text;
  }
}

// A mark without a word in its line is a comment, whatever begins the next line.
TEST(XboxPixelShader, ADirectiveStandsInTheLineOfItsMark) {
  for (const char* const mark : {"#", "# ", "#/*", "#R\"(", "# a line"}) {
    const std::string text =
        "D3DPIXELSHADERDEF line;\n" + std::string(mark) + "\nline.PSCombinerCount = 1;\nline.PSDotMapping = 0;\n";
    const auto parsed = parse_xbox_pixel_shader({text, ""}, kShaderProfile);
    EXPECT_TRUE(parsed) << mark << all_faults(parsed);
  }
  const auto directive = parse_xbox_pixel_shader({"# /* a */ line 1\nPSCombinerCount = 1", ""}, kShaderProfile);
  ASSERT_FALSE(directive);
  EXPECT_TRUE(has(all_faults(directive), "lines of the preprocessor are not read"));
}

// Sources that grow take as much longer as they grow.
TEST(XboxPixelShader, HostileSourcesTakeLinearTime) {
  const std::string beginnings[] = {"PSCombinerCount = ", "D3DPIXELSHADERDEF psd = {", "DWORD ps[] = {", "psd", ""};
  const std::string repeated[] = {"(",
                                  "{",
                                  "-",
                                  "~",
                                  "PS_COMBINERINPUTS(",
                                  "1 | ",
                                  "a.",
                                  ".PSConstant0 = ",
                                  "/* ",
                                  " ",
                                  "\n",
                                  "#\n",
                                  "#/*\n",
                                  "#R\"(\n",
                                  "R\"",
                                  "0x0 ",
                                  "00 ",
                                  "[",
                                  "1,",
                                  "PSRGBInputs[0] = PS_REGISTER_X ",
                                  "PS_REGISTER_TO(",
                                  "0000:",
                                  "|",
                                  "static ",
                                  "memset() ",
                                  "memset(a ",
                                  "f();",
                                  "PSDotMapping |= 1 ",
                                  "0000 00 00 00 00\n*\n",
                                  "00-00 ",
                                  "DWORD a[] = {1, 2};",
                                  "0  00 "};
  constexpr std::size_t kBytes = std::size_t{1} << (kSlowBuild ? 14 : 17);
  for (const std::string& beginning : beginnings) {
    for (const std::string& piece : repeated) {
      std::string text = beginning;
      while (text.size() < kBytes) text += piece;
      const std::clock_t start = std::clock();
      const auto parsed = parse_xbox_pixel_shader({text, ""}, kShaderProfile);
      (void)is_xbox_pixel_shader(text);
      EXPECT_LT(std::clock() - start, CLOCKS_PER_SEC) << "processor time: " << beginning << piece;
      EXPECT_LE(parsed.faults().size(), kMaxTextFaults);
      EXPECT_NE(bool(parsed), !parsed.faults().empty()) << beginning << piece;
    }
  }
}

}  // namespace
}  // namespace ninebit::test

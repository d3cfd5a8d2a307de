// Register words: the sets that the hardware loads itself, names, defaults, and every fault.
#include "ninebit/language/register_words.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/hardware/csv.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"

namespace ninebit::test {
namespace {

const HardwareProfile& kCard = profiles::geforce2;
const HardwareProfile& kXbox = profiles::nv2a;

CombinerState decoded(const std::string& text, ChipClass chip = ChipClass::nv10) {
  const HardwareProfile& profile = chip == ChipClass::nv10 ? kCard : kXbox;
  const auto parsed = parse_register_words({text, "words"}, chip, profile);
  EXPECT_TRUE(parsed) << text << all_faults(parsed);
  return parsed ? *parsed : CombinerState{};
}

// The meanings of nv10_rc_words_d3d5.csv as formulas on codes; t: texture 0, v: primary, s: spare0 before the stage.
struct Meaning {
  std::function<int(int t, int ta, int v, int s)> rgb;
  std::function<int(int ta, int va)> alpha;
};
int product(int x, int y) {
  return x * y / 255;
}
const std::map<std::string, Meaning> kMeanings{
    {"DECAL", {[](int t, int, int, int) { return t; }, [](int ta, int) { return ta; }}},
    {"COPY", {[](int t, int, int, int) { return t; }, [](int ta, int) { return ta; }}},
    {"MODULATE", {[](int t, int, int v, int) { return product(t, v); }, [](int ta, int) { return ta; }}},
    {"DECALALPHA",
     {[](int t, int ta, int v, int) { return (t * ta + v * (255 - ta)) / 255; }, [](int, int va) { return va; }}},
    {"MODULATEALPHA",
     {[](int t, int, int v, int) { return product(t, v); }, [](int ta, int va) { return product(ta, va); }}},
    {"DECALMASK", {[](int t, int, int v, int s) { return s >= 128 ? t : v; }, [](int, int va) { return va; }}},
    {"MODULATEMASK",
     {[](int t, int, int v, int s) { return s >= 128 ? product(v, t) : v; }, [](int, int va) { return va; }}},
    {"ADD", {[](int t, int, int v, int) { return std::min(t + v, 255); }, [](int, int va) { return va; }}},
};

// Ways in which the same hardware ends: plain, with specular, with fog, with both.
struct Ending {
  const char* word;
  std::function<int(int color, int specular, int fog, int factor)> rgb;
};
int mixed(int a, int b, int c) {
  return (2 * (a * b + (255 - a) * c) + 255) / 510;
}
const Ending kEndings[] = {
    {"0x0000000c", [](int color, int, int, int) { return color; }},
    {"0x0000000e", [](int color, int specular, int, int) { return std::min(color + specular, 255); }},
    {"0x130c0300", [](int color, int, int fog, int factor) { return mixed(factor, color, fog); }},
    {"0x130e0300",
     [](int color, int specular, int fog, int factor) { return mixed(factor, std::min(color + specular, 255), fog); }},
};

TEST(RegisterWords, TheSetsOfTheDirect3d5ClassMeanWhatTheirTableSays) {
  int sets = 0, differing = 0;
  for (const auto& row : read_hardware_table("nv10_rc_words_d3d5")) {
    const Meaning& meaning = kMeanings.at(row.at("name"));
    for (const Ending& ending : kEndings) {
      const CombinerState state =
          decoded("rc_in_alpha0 = " + row.at("rc_in_alpha0") + "\nrc_in_color0 = " + row.at("rc_in_color0") +
                  "\nrc_out_alpha0 = " + row.at("rc_out_alpha0") + "\nrc_out_color0 = " + row.at("rc_out_color0") +
                  "\nrc_final_a = " + ending.word + "\nrc_final_b = 0x00001c80\n");
      const auto program = compile(state, kCard);
      ASSERT_TRUE(program.ok()) << program.error().message;
      ASSERT_EQ(program->num_general_combiners, 1);
      for (int i = 0; i < 2000; ++i) {
        Random random(7, static_cast<std::uint64_t>(i));
        RegisterFile registers = random_registers(random, kCard);
        const auto code = [&](Register r, int c) {
          return std::max<int>(registers[r][static_cast<std::size_t>(c)], 0);
        };
        const int mux = registers[Register::spare0][kAlpha];
        Rgba9 general{}, color{};
        for (int c = 0; c < 3; ++c) {
          const int value = meaning.rgb(code(Register::texture0, c), code(Register::texture0, kAlpha),
                                        code(Register::primary, c), mux);
          general[static_cast<std::size_t>(c)] = static_cast<s9>(value);
          color[static_cast<std::size_t>(c)] = static_cast<s9>(
              ending.rgb(value, code(Register::secondary, c), code(Register::fog, c), code(Register::fog, kAlpha)));
        }
        general[kAlpha] = color[kAlpha] =
            static_cast<s9>(meaning.alpha(code(Register::texture0, kAlpha), code(Register::primary, kAlpha)));
        evaluate_general(*program, registers);
        ASSERT_EQ(registers[Register::spare0], general) << row.at("name") << ", case " << i;
        ASSERT_EQ(evaluate_final(*program, registers), color) << row.at("name") << ' ' << ending.word << ", case " << i;
        differing += general != Rgba9{} ? 1 : 0;
      }
    }
    ++sets;
  }
  EXPECT_EQ(sets, 8);
  EXPECT_GT(differing, 8 * 4 * 1000);
}

TEST(RegisterWords, NoWordsAreTheDefaults) {
  for (const char* text : {"", "\n\n", "# nothing\r\n  // here\n\t"}) {
    EXPECT_EQ(decoded(text), CombinerState{});
    EXPECT_EQ(decoded(text, ChipClass::nv20), CombinerState{});
  }
}

TEST(RegisterWords, TheDefaultsInWordsAreTheKnownNumbers) {
  EXPECT_EQ(print_register_words({}, ChipClass::nv10, kCard).value(),
            "RC_IN_ALPHA[0] = 0x14301010\n"
            "RC_IN_RGB[0] = 0x04200000\n"
            "RC_OUT_ALPHA[0] = 0x00000c00\n"
            "RC_OUT_RGB[0] = 0x00000c00\n"
            "RC_OUT_RGB[1] = 0x18000c00\n"
            "RC_COLOR[0] = 0x00000000\n"
            "RC_COLOR[1] = 0x00000000\n"
            "RC_FINAL0 = 0x130e0300\n"
            "RC_FINAL1 = 0x00001c80\n");
  EXPECT_TRUE(has(print_register_words({}, ChipClass::nv20, kXbox).value(), "RC_ENABLE = 0x00000101\n"));
}

TEST(RegisterWords, EveryNameOfAWordIsTheSameWord) {
  const std::vector<std::vector<std::string>> nv10{
      {"RC_IN_RGB[1]", "rc_in_rgb(1)", "RC_IN_RGB1", "rc_in_rgb_1", "RC_IN_COLOR[1]", "rc_in_color1",
       "NV10_3D_RC_IN_RGB(1)", "NV10TCL_RC_IN_RGB(1)", "CELSIUS_RC_IN_COLOR[1]", "NV056_SET_COMBINER_COLOR_ICW[1]"},
      {"RC_COLOR[1]", "RC_COLOR1", "rc_factor[1]", "RC_FACTOR_1", "NV056_SET_COMBINER_FACTOR[1]"},
      {"RC_FINAL0", "rc_final_0", "RC_FINAL_A", "SET_COMBINER_SPECULAR_FOG_CW0", "NV10_3D_RC_FINAL0"},
  };
  const std::vector<std::vector<std::string>> nv20{
      {"RC_OUT_ALPHA[7]", "RC_OUT_ALPHA7", "NV097_SET_COMBINER_ALPHA_OCW[7]", "PSAlphaOutputs[7]",
       "NV20_3D_RC_OUT_ALPHA(7)"},
      {"RC_CONSTANT_COLOR0[3]", "RC_FACTOR_0[3]", "RC_FACTOR0[3]", "BUNDLE_RC_FACTOR_0(3)", "SET_COMBINER_FACTOR0[3]",
       "PSConstant0[3]", "RC_CONSTANT_COLOR0_3"},
      {"RC_COLOR0", "RC_COLOR[0]", "RC_FINAL_FACTOR[0]", "NV097_SET_SPECULAR_FOG_FACTOR[0]",
       "PSFinalCombinerConstant0"},
      {"RC_ENABLE", "rc_config", "NV097_SET_COMBINER_CONTROL", "PSCombinerCount"},
  };
  for (const auto& [chip, groups] : {std::pair(ChipClass::nv10, nv10), std::pair(ChipClass::nv20, nv20)}) {
    for (const auto& names : groups) {
      for (const std::string& name : names) {
        // The second mention must be seen as a repetition of the first.
        const auto parsed = parse_register_words({names[0] + " = 0x18000101\n" + name + " = 0x18000101\n", ""}, chip,
                                                 chip == ChipClass::nv10 ? kCard : kXbox);
        EXPECT_TRUE(has(all_faults(parsed), "2:1: " + names[0] + " was given before, in line 1")) << name;
      }
    }
  }
}

TEST(RegisterWords, OrderBlanksAndCommentsSayNothing) {
  const CombinerState one = decoded("RC_IN_RGB[0] = 0x08040000\nRC_COLOR[1] = 0xff804020\n");
  const CombinerState other =
      decoded("\trc_color[1]=4286595104 // decimal\r\n\r\nRC_IN_RGB0   =\t0X08040000# here too\r\n");
  EXPECT_NE(one, CombinerState{});
  EXPECT_EQ(decoded("RC_COLOR[1] = 0xff804020\nRC_IN_RGB[0] = 0x8040000"), one);
  EXPECT_EQ(other.general[0].rgb, one.general[0].rgb);
  EXPECT_EQ(one.constant1, (ColorF{128 / 255.0F, 64 / 255.0F, 32 / 255.0F, 1.0F}));
}

TEST(RegisterWords, StageConstantsOfNv20) {
  const std::string reads = "RC_IN_RGB[0] = 0x01020000\nRC_FINAL0 = 0x0000000c\n";
  // The same pair for every stage, and the final combiner reads none: OpenGL's global pair.
  CombinerState state = decoded(reads + "RC_CONSTANT_COLOR0[0] = 0xff000000\nRC_ENABLE = 0x101\n", ChipClass::nv20);
  EXPECT_FALSE(state.per_stage_constants);
  EXPECT_EQ(state.constant0, (ColorF{0, 0, 0, 1}));
  // The final combiner reads another one: only a pair a stage says that.
  state = decoded(
      "RC_IN_RGB[0] = 0x01020000\nRC_FINAL0 = 0x00000001\nRC_CONSTANT_COLOR0[0] = 0xff000000\n"
      "RC_COLOR0 = 0x00ff0000\nRC_ENABLE = 0x102\n",
      ChipClass::nv20);
  EXPECT_TRUE(state.per_stage_constants);
  EXPECT_EQ(state.constant0, (ColorF{1, 0, 0, 0}));
  EXPECT_EQ(state.general[0].constant0, (ColorF{0, 0, 0, 1}));
  EXPECT_EQ(state.general[1].constant0, (ColorF{0, 0, 0, 1}));
  // Unique constants 0, shared constants 1.
  state = decoded(
      "RC_CONSTANT_COLOR0[1] = 0xff000000\nRC_CONSTANT_COLOR1[0] = 0xff\nRC_CONSTANT_COLOR1[1] = 1\n"
      "RC_ENABLE = 0x1102\n",
      ChipClass::nv20);
  EXPECT_TRUE(state.per_stage_constants);
  EXPECT_EQ(state.general[0].constant0, ColorF{});
  EXPECT_EQ(state.general[1].constant0, (ColorF{0, 0, 0, 1}));
  EXPECT_EQ(state.general[1].constant1, (ColorF{0, 0, 1, 0}));
}

TEST(RegisterWords, ALeastSignificantMuxWithoutAMuxSaysNothing) {
  EXPECT_EQ(decoded("RC_ENABLE = 1\n", ChipClass::nv20), CombinerState{});
  EXPECT_EQ(decoded("RC_OUT_RGB[1] = 0x10000c00\n"), CombinerState{});
  // A mux in a stage that is not in use, or one that is discarded.
  EXPECT_TRUE(parse_register_words({"RC_ENABLE = 1\nRC_OUT_RGB[1] = 0x4c00\nRC_OUT_ALPHA[0] = 0x4000", ""},
                                   ChipClass::nv20, kXbox));
}

TEST(RegisterWords, InvertedColorSum) {
  CombinerState state;
  state.color_sum_invert_spare0 = true;
  EXPECT_EQ(decoded("RC_FINAL1 = 0x00001ca0\n", ChipClass::nv20), state);
  EXPECT_TRUE(has(print_register_words(state, ChipClass::nv20, kXbox).value(), "RC_FINAL1 = 0x00001ca0\n"));
  state.color_sum_invert_spare0 = false;
  state.color_sum_invert_secondary = true;
  EXPECT_EQ(decoded("RC_FINAL1 = 0x00001cc0\n", ChipClass::nv20), state);
  EXPECT_EQ(*parse_register_words({"RC_FINAL1 = 0x00001cc0", ""}, ChipClass::nv10, kXbox), state);
}

// Where both words are 0 the NV2A leaves the final combiner out.
TEST(RegisterWords, AFinalCombinerOfZerosPassesSpare0) {
  const std::string zeros = "RC_FINAL0 = 0\nRC_FINAL1 = 0\n";
  CombinerState state;
  state.color_sum_clamp = false;
  state.final_combiner = {};
  for (CombinerInput* in : {&state.final_combiner.a, &state.final_combiner.b, &state.final_combiner.c,
                            &state.final_combiner.d, &state.final_combiner.e, &state.final_combiner.f}) {
    *in = {Register::zero, InputMapping::unsigned_identity, ComponentUsage::rgb};
  }
  state.final_combiner.g = {Register::zero, InputMapping::unsigned_identity, ComponentUsage::blue};
  const CombinerState black = state;
  EXPECT_EQ(decoded(zeros), black) << "NV10 outputs zero";
  state.final_combiner.d.reg = Register::spare0;
  state.final_combiner.g = {Register::spare0, InputMapping::unsigned_identity, ComponentUsage::alpha};
  EXPECT_EQ(decoded(zeros, ChipClass::nv20), state);
  // One word alone, or a flag, is a final combiner.
  EXPECT_NE(decoded("RC_FINAL0 = 0\n", ChipClass::nv20).final_combiner.d.reg, Register::spare0);
  EXPECT_NE(decoded("RC_FINAL0 = 0\nRC_FINAL1 = 0x80\n", ChipClass::nv20).final_combiner.d.reg, Register::spare0);
  // A program that outputs zero keeps doing so.
  const std::string printed = print_register_words(black, ChipClass::nv20, kXbox).value();
  EXPECT_TRUE(has(printed, "RC_FINAL0 = 0x00000000\nRC_FINAL1 = 0x00001000\n"));
  CombinerState still_black = black;
  still_black.final_combiner.g.usage = ComponentUsage::alpha;
  EXPECT_EQ(decoded(printed, ChipClass::nv20), still_black);
}

TEST(RegisterWords, BlueToAlpha) {
  CombinerState state;
  state.general[3].rgb.out = {.ab = Register::spare1, .cd = Register::primary, .ab_blue_to_alpha = true};
  EXPECT_EQ(decoded("RC_OUT_RGB[3] = 0x00080cd4\n", ChipClass::nv20), state);
  EXPECT_TRUE(has(print_register_words(state, ChipClass::nv20, kXbox).value(), "RC_OUT_RGB[3] = 0x00080cd4\n"));
  state.general[3].rgb.out.ab_blue_to_alpha = false;
  state.general[3].rgb.out.cd_blue_to_alpha = true;
  EXPECT_EQ(decoded("RC_OUT_RGB[3] = 0x00040cd4\n", ChipClass::nv20), state);
  const auto refused = parse_register_words({"\nRC_OUT_RGB[1] = 0x00080c40", ""}, ChipClass::nv20, kCard);
  EXPECT_TRUE(has(all_faults(refused),
                  "2:1: GL_INVALID_ENUM: general combiner 1, RGB portion: profile geforce2 has no "
                  "blue-to-alpha outputs (NV2A)"));
}

TEST(RegisterWords, MuxByTheLowestBit) {
  CombinerState state;
  state.mux_by_lowest_bit = state.general[0].rgb.out.mux_sum = true;
  EXPECT_EQ(decoded("RC_OUT_RGB[0] = 0x4c00\nRC_ENABLE = 0x1\n", ChipClass::nv20), state);
  EXPECT_TRUE(has(print_register_words(state, ChipClass::nv20, kXbox).value(), "RC_ENABLE = 0x00000001\n"));
  // NV10 has the bit, too: of a profile that has what it asks for.
  const std::string nv10 = print_register_words(state, ChipClass::nv10, kXbox).value();
  EXPECT_TRUE(has(nv10, "RC_OUT_RGB[1] = 0x10000c00\n"));
  EXPECT_EQ(*parse_register_words({nv10, ""}, ChipClass::nv10, kXbox), state);
}

struct WordFault {
  ChipClass chip;
  const char* text;
  PlacedFault fault;
};
constexpr ChipClass k10 = ChipClass::nv10, k20 = ChipClass::nv20;
const WordFault kFaults[] = {
    // Lines.
    {k10, "\nRC_IN_RGB[0] 0x0", {2, 14, "expected = after RC_IN_RGB[0]; found '0'"}},
    {k10, "RC_IN_RGB[0]", {1, 13, "expected = after RC_IN_RGB[0]; found the end of the line"}},
    {k10, "RC_IN_RGB[0] = ", {1, 16, "expected a value"}},
    {k10, "RC_IN_RGB[0] = 0x", {1, 16, "hexadecimal"}},
    {k10, "RC_IN_RGB[0] = 0xfg", {1, 16, "hexadecimal"}},
    {k10, "RC_IN_RGB[0] = 010", {1, 16, "without leading zeros"}},
    {k10, "RC_IN_RGB[0] = 0x100000000", {1, 16, "32 bits"}},
    {k10, "RC_IN_RGB[0] = 4294967296", {1, 16, "32 bits"}},
    {k10, "RC_IN_RGB[0] = -1", {1, 16, "expected a value"}},
    {k10, "RC_IN_RGB[0] = 0x0 0x0", {1, 20, "end of the line"}},
    {k10, "RC_IN_RGB[0] = 0x0;", {1, 19, "found ';'"}},
    {k10, "RC_IN_RGB[0 = 0x0", {1, 10, "expected ="}},
    {k10, "  = 0x0", {1, 3, "NAME = 0x"}},
    {k10, "\x80", {1, 1, "the byte 0x80"}},
    {k10, "{\"RC_IN_RGB[0]\": 0}", {1, 1, "found '{'"}},
    // Names.
    {k10, "RC_IN_GREEN[0] = 0x0", {1, 1, "is not a register word of NV10"}},
    {k10, "RC_IN_RGB = 0x0", {1, 1, "needs an index from 0 to 1, as in RC_IN_RGB[0]"}},
    {k10, "RC_IN_RGB[2] = 0x0", {1, 1, "is out of range for NV10"}},
    {k20, "RC_IN_RGB[8] = 0x0", {1, 1, "is out of range for NV20"}},
    {k10, "RC_ENABLE = 0x1", {1, 1, "is a word of NV20, not of NV10"}},
    {k10, "RC_COLOR[0] = 0x0\nRC_FACTOR[0] = 0x0", {2, 1, "was given before, in line 1 as RC_COLOR[0]"}},
    {k20, "0X401950 = 1", {1, 1, "0X401950 is not the address of a combiner register, such as 0x401940"}},
    {k20, "PSDotMapping = 1\nNV_PGRAPH_SHADERCTL = 2", {2, 1, "PSDotMapping was given before, in line 1"}},
    {k20, "NV_PGRAPH_SHADERCTL = 2\nPSDotMapping = 1", {2, 1, "PSDotMapping was given before, in line 1"}},
    {k20,
     "$1 = {combiner_control = 1}\n$2 = {combiner_control = 2}",
     {2, 1, "expected the end of the text behind the struct; found '$'"}},
    {k20, "/* a\nb */ RC_IN_RGB[0] 0x0", {2, 19, "expected = after RC_IN_RGB[0]; found '0'"}},
    // Masks and reserved codes.
    {k10, "RC_IN_RGB[0] = 0x06000000", {1, 1, "variable A (bits 27..24) has the register code 0x6"}},
    {k10, "RC_IN_RGB[0] = 0x00070000", {1, 1, "variable B (bits 19..16) has the register code 0x7"}},
    {k10, "RC_IN_RGB[0] = 0x00000a00", {1, 1, "variable C (bits 11..8) has the register code 0xa"}},
    {k10, "RC_IN_ALPHA[1] = 0x0000000b", {1, 1, "variable D (bits 3..0) has the register code 0xb"}},
    {k10, "RC_IN_RGB[0] = 0x0e000000", {1, 1, "0xe, which is reserved here"}},
    {k20, "RC_IN_RGB[0] = 0x0f000000", {1, 1, "0xf, which is reserved here"}},
    {k20, "RC_IN_RGB[5] = 0x00000006", {1, 1, "0x6, which is reserved here"}},
    {k10, "RC_FINAL0 = 0x00000040", {1, 1, "bit 6 must be 0; the mask of the word is 0x3f3f3f3f"}},
    {k10, "RC_FINAL0 = 0xc0000000", {1, 1, "bits 31 and 30 must be 0"}},
    {k10, "RC_FINAL0 = 0x0b000000", {1, 1, "0xb"}},
    {k10, "RC_FINAL1 = 0x00001c81", {1, 1, "bit 0 must be 0; the mask of the word is 0x3f3f3fe0"}},
    {k10, "RC_FINAL1 = 0x0e001c80", {1, 1, "variable E (bits 27..24) has the register code 0xe"}},
    {k20, "RC_FINAL1 = 0x00061c80", {1, 1, "variable F (bits 19..16) has the register code 0x6"}},
    {k20, "RC_FINAL1 = 0x00001f80", {1, 1, "variable G (bits 11..8) has the register code 0xf"}},
    {k10, "RC_OUT_RGB[0] = 0x00040c00", {1, 1, "bit 18 must be 0; the mask of the word is 0x0003ffff"}},
    {k10, "RC_OUT_RGB[0] = 0x18000c00", {1, 1, "bits 28 and 27 must be 0"}},
    {k10, "RC_OUT_RGB[1] = 0x98000c00", {1, 1, "bit 31 must be 0; the mask of the word is 0x3803ffff"}},
    {k10, "RC_OUT_RGB[1] = 0x08000c00", {1, 1, "are 0; NV10 has 1 or 2"}},
    {k10, "RC_OUT_RGB[1] = 0x38000c00", {1, 1, "are 3; NV10 has 1 or 2"}},
    {k10, "RC_OUT_RGB[0] = 0x000000a0", {1, 1, "AB (bits 7..4) has the destination code 0xa"}},
    {k10, "RC_OUT_RGB[0] = 0x00000003", {1, 1, "CD (bits 3..0) has the destination code 0x3"}},
    {k10, "RC_OUT_ALPHA[0] = 0x00000100", {1, 1, "the sum (bits 11..8) has the destination code 0x1"}},
    {k20, "RC_OUT_ALPHA[0] = 0x00000e00", {1, 1, "0xe, which cannot be written"}},
    {k10, "RC_OUT_ALPHA[0] = 0x00003c00", {1, 1, "bits 13 and 12: an alpha portion has no dot product"}},
    {k10, "RC_OUT_RGB[0] = 0x00028c00", {1, 1, "bits 17..15 are 5"}},
    {k20, "RC_OUT_ALPHA[3] = 0x00038c00", {1, 1, "bits 17..15 are 7"}},
    {k20, "RC_OUT_RGB[0] = 0x00100c00", {1, 1, "bit 20 must be 0; the mask of the word is 0x000fffff"}},
    {k20, "RC_ENABLE = 0x100", {1, 1, "are 0; NV20 has 1 to 8"}},
    {k20, "RC_ENABLE = 0x109", {1, 1, "are 9; NV20 has 1 to 8"}},
    {k20, "RC_ENABLE = 0x01000101", {1, 1, "bit 24 must be 0; the mask of the word is 0x0001110f"}},
    // A feature that the chip has and the profile has not.
    {k20, "RC_OUT_ALPHA[0] = 0x00080c40", {1, 1, "bit 19 must be 0; the mask of the word is 0x0003cfff"}},
    {k10, "\nRC_FINAL1 = 0x00001cc0", {2, 1, "GL_INVALID_ENUM: profile geforce2 has no 1 - x in the colour sum"}},
    {k10, "RC_OUT_RGB[1] = 0x20004c00", {1, 1, "GL_INVALID_ENUM: profile geforce2 has no mux by the lowest bit"}},
    // A state that OpenGL refuses.
    {k10, "\nRC_IN_RGB[1] = 0x13000000", {2, 1, "GL_INVALID_OPERATION: general combiner 1, RGB portion, variable A"}},
    {k10, "RC_IN_ALPHA[0] = 0x00001300", {1, 1, "variable C: fog's alpha"}},
    {k10, "RC_OUT_RGB[0] = 0x00000ccc", {1, 1, "two outputs go to spare0"}},
    {k10, "RC_FINAL0 = 0x0e000000", {1, 1, "final combiner, variable A: spare0_plus_secondary_color"}},
    {k10, "RC_FINAL0 = 0x00001f00", {1, 1, "final combiner, variable C: e_times_f has no alpha"}},
};

TEST(RegisterWords, EveryFaultHasItsPlaceAndNamesItsBits) {
  for (const auto& [chip, text, fault] : kFaults) {
    expect_fault(parse_register_words({text, "f"}, chip, chip == k10 ? kCard : kXbox), fault, text);
  }
}

TEST(RegisterWords, AProfileMayHaveLessThanTheChip) {
  const auto stages = parse_register_words({"RC_ENABLE = 0x103", ""}, k20, kCard);
  EXPECT_TRUE(has(all_faults(stages), "1:1: GL_INVALID_VALUE: num_general_combiners is 3"));
  const auto constants = parse_register_words({"RC_ENABLE = 0x1101", ""}, k20, kCard);
  EXPECT_TRUE(has(all_faults(constants), "has no per-stage constants"));
  const auto units = parse_register_words({"\nRC_IN_RGB[1] = 0x0a000000", ""}, k20, kCard);
  EXPECT_TRUE(has(all_faults(units), "2:1: GL_INVALID_ENUM"));
}

TEST(RegisterWords, WhatNv10CannotHold) {
  const auto lacks = [](const CombinerState& state) {
    const auto printed = print_register_words(state, ChipClass::nv10, kXbox);
    return printed.ok() ? std::string("nothing") : printed.error().message;
  };
  EXPECT_EQ(lacks({}), "nothing");
  CombinerState state;
  state.num_general_combiners = 3;
  EXPECT_TRUE(has(lacks(state), "NV10 has 2 general combiners, but the program uses 3"));
  state = {};
  state.per_stage_constants = true;
  EXPECT_TRUE(has(lacks(state), "no per-stage constants"));
  state = {};
  state.general[1].rgb.out.ab_blue_to_alpha = true;
  EXPECT_TRUE(has(lacks(state), "NV10 has no blue-to-alpha outputs"));
  state = {};
  state.final_combiner.d.reg = Register::texture2;
  EXPECT_TRUE(has(lacks(state), "2 texture units"));
  state = {};
  state.general[1].alpha.out.cd = Register::texture3;
  EXPECT_TRUE(has(lacks(state), "2 texture units"));
  state = {};
  state.general[0].rgb.a.reg = Register::e_times_f;
  EXPECT_TRUE(has(lacks(state), "not valid"));
}

TEST(RegisterWords, FaultsAreBounded) {
  std::string text;
  for (int i = 0; i < 5000; ++i) text += "RC_NOTHING = 0x0\n";
  EXPECT_EQ(parse_register_words({text, ""}, k10, kCard).faults().size(), kMaxTextFaults);
  const auto long_text = parse_register_words({std::string(kMaxSourceBytes + 1, ' '), ""}, k10, kCard);
  ASSERT_EQ(long_text.faults().size(), 1U);
  EXPECT_TRUE(parse_register_words({std::string(kMaxSourceBytes, '\n'), ""}, k10, kCard));
}

}  // namespace
}  // namespace ninebit::test

// Functions that fill the Xbox's pixel shader definition: the program is that of the words.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "combiner_tests/support/temp_folder.h"
#include "ninebit/language/source_code.h"
#include "ninebit/language/xbox_pixel_shader.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

constexpr const char* kDefinitions = NINEBIT_SOURCE_DIR "/combiner_tests/language/sources/definitions.cpp";

struct ReadWords {
  std::vector<RegisterWord> other_words;
  Parsed<CombinerState> program;
};

ReadWords read_words(const std::string& text, const SourceSelection& selection = {}) {
  std::vector<RegisterWord> other_words;
  auto program = parse_source_code({text, "def.cpp"}, selection, profiles::nv2a, &other_words);
  return {std::move(other_words), std::move(program)};
}

// The same program as words, and the same other words.
void expect_words(const ReadWords& found, const std::string& words) {
  ASSERT_TRUE(found.program) << test::all_faults(found.program);
  std::vector<RegisterWord> other;
  const auto expected = parse_xbox_pixel_shader({words, "words"}, profiles::nv2a, &other);
  ASSERT_TRUE(expected) << test::all_faults(expected);
  EXPECT_EQ(*found.program, *expected);
  ASSERT_EQ(found.other_words.size(), other.size());
  for (std::size_t i = 0; i < other.size(); ++i) {
    EXPECT_EQ(found.other_words[i].name, other[i].name);
    EXPECT_EQ(found.other_words[i].value, other[i].value) << other[i].name;
  }
}

TEST(SourceXbox, AFunctionFillsADefinition) {
  const ReadWords found = read_words(test::read_bytes(kDefinitions), {{"CreateLightmapShader"}, {}});
  expect_words(found,
               "psd.PSTextureModes = 0x21; psd.PSCombinerCount = 0x1101; psd.PSRGBInputs[0] = 0x08490000;"
               "psd.PSRGBOutputs[0] = 0xc0; psd.PSConstant0[0] = 0xff804020;"
               "psd.PSFinalCombinerInputsABCD = 0xc; psd.PSFinalCombinerInputsEFG = 0x1c00;");
}

TEST(SourceXbox, PointersHelpersAndSwitches) {
  const std::string text = test::read_bytes(kDefinitions);
  expect_words(read_words(text, {{"BuildGlow"}, {{"quality", "GLOW_LOW"}}}),
               "p.PSRGBInputs[0] = 0x08040c00; p.PSRGBOutputs[0] = 0xc00; p.PSConstant1[0] = 0xff000000;"
               "p.PSCombinerCount = 0x1001; p.PSFinalCombinerInputsABCD = 0xc;");
  expect_words(read_words(text, {{"BuildGlow"}, {{"quality", "1"}}}),
               "p.PSRGBInputs[0] = 0x08040c00; p.PSRGBInputs[1] = 0x09040c01; p.PSRGBInputs[2] = 0x0a040c01;"
               "p.PSRGBOutputs[0] = 0xc00; p.PSRGBOutputs[1] = 0xc00; p.PSRGBOutputs[2] = 0xc00;"
               "p.PSConstant1[2] = 0xff00ff00; p.PSCombinerCount = 0x1003; p.PSFinalCombinerInputsABCD = 0xc;");
}

TEST(SourceXbox, FunctionsAreListedWithWhatTheyNeed) {
  const std::string text = test::read_bytes(kDefinitions);
  const auto found = find_source_functions({text, "def.cpp"}, {}, profiles::nv2a);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_EQ(found[0].name, "SetColorStage");
  EXPECT_TRUE(found[0].is_helper);
  EXPECT_EQ(found[1].name, "CreateLightmapShader");
  EXPECT_EQ(found[1].calls_read, 7);
  EXPECT_TRUE(found[1].needs.empty());
  EXPECT_EQ(found[2].name, "BuildGlow");
  EXPECT_EQ(found[2].needs, (std::vector<std::string>{"quality"}));
  const ReadWords missing = read_words(text, {{"BuildGlow"}, {}});
  ASSERT_FALSE(missing.program);
  EXPECT_TRUE(test::has(test::all_faults(missing.program), "quality"));
}

TEST(SourceXbox, APieceOfAFunction) {
  const std::string text =
      "psd.PSRGBInputs[0] = (psd.PSRGBInputs[0] & 0xff) | 0x08040000;\n"
      "psd.PSRGBOutputs[0] = 0xc0;\n"
      "psd.PSCombinerCount = psd.PSCombinerCount + 1;\n"
      "if (SUCCEEDED(device->CreatePixelShader(&psd, &shader))) return shader;\n";
  EXPECT_TRUE(is_source_code(text));
  const ReadWords known = read_words(text, {{}, {{"psd.PSRGBInputs[0]", "0"}}});
  // An object's values before the text are not known; its own members are 0 once one of them is set.
  expect_words(known, "psd.PSRGBInputs[0] = 0x08040000; psd.PSRGBOutputs[0] = 0xc0; psd.PSCombinerCount = 1;");
  EXPECT_FALSE(is_source_code("psd.PSRGBInputs[0] = 0x08040000;\npsd.PSCombinerCount = 1;\n"));
}

TEST(SourceXbox, WhatWasClearedIsZero) {
  expect_words(
      read_words("void f() { psd.PSRGBInputs[3] = 5; ZeroMemory(&psd, sizeof(psd)); psd.PSCombinerCount = 1; }"),
      "psd.PSCombinerCount = 1;");
}

void expect_fault(const std::string& text, const std::string& expected) {
  const ReadWords found = read_words(text);
  ASSERT_FALSE(found.program) << text;
  EXPECT_TRUE(test::has(test::all_faults(found.program), expected));
}

TEST(SourceXbox, FaultsNameTheirPlace) {
  expect_fault("void f() {\n  p->PSRGBInputs[8] = 1;\n}",
               "def.cpp:2:3: PSRGBInputs[8] is out of range; expected an index from 0 to 7");
  expect_fault("void f() {\n  p->PSRGBInputs = 1;\n}", "PSRGBInputs needs an index from 0 to 7");
  expect_fault("void f() {\n  p->PSCombinerCount[1] = 1;\n}", "PSCombinerCount is one word; expected no index");
  expect_fault("void f() {\n  p->PSCombinerCount = 1;\n  p->PSRGBInput[0] = 1;\n}",
               "def.cpp:3:3: 'PSRGBInput' is not a member of D3DPIXELSHADERDEF; did you mean 'PSRGBInputs'?");
  expect_fault("void f() {\n  p->PSConstant0[1] = 0x100000000;\n}", "the value is not a whole number of 32 bits");
  expect_fault("void f() {\n  p->PSRGBInputs[0] = PS_COMBINERINPUTS(PS_REGISTER_TO, 0, 0, 0);\n}",
               "def.cpp:2:23: unknown name 'PS_REGISTER_TO'; did you mean 'PS_REGISTER_T0'?");
  expect_fault("void f() {\n  p->PSRGBInputs[0] = PS_COMBINERINPUTS(0x100, 0, 0, 0);\n}",
               "def.cpp:2:41: argument 1 of PS_COMBINERINPUTS is out of range; expected 0 to 255");
  expect_fault("void f() {\n  p->PSRGBInputs[0] = PS_COMBINERINPUTS(1, 0, 0);\n}",
               "PS_COMBINERINPUTS has 3 arguments; expected 4");
  expect_fault("void f() {\n  p->PSRGBInputs[i] = g();\n}", "2 values are not known");
}

// Words that are not assigned are 0 where they were 0.
TEST(SourceXbox, WhatADefinitionHadBeforeIsNotGuessed) {
  const std::string fills = " psd.PSCombinerCount = 1; device->CreatePixelShader(&psd, &handle); }";
  expect_words(read_words("void f() { D3DPIXELSHADERDEF psd = {0};" + fills), "psd.PSCombinerCount = 1;");
  for (const char* const before :
       {"D3DPIXELSHADERDEF psd = {0, 5};", "D3DPIXELSHADERDEF psd = usual;", "D3DPIXELSHADERDEF psd; start(&psd);"}) {
    expect_fault("void f() { " + std::string(before) + fills, "'psd' has values before");
  }
  const ReadWords changed = read_words("void f() {\n p->PSCombinerCount = 1;\n change(p);\n}");
  ASSERT_TRUE(changed.program);
  ASSERT_FALSE(changed.program.notes.empty());
  EXPECT_EQ(changed.program.notes[0].text(),
            "def.cpp:3:2: assumed that 'change' does not change the definition that is filled");
}

TEST(SourceXbox, OneFunctionIsOneProgram) {
  expect_fault("void f() {\n  a.PSCombinerCount = 1;\n  b.PSCombinerCount = 1;\n}",
               "several definitions are filled: 'a' (line 2), 'b' (line 3)");
  expect_fault("void f() {\n  a.PSCombinerCount = 1;\n  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);\n}",
               "a D3DPIXELSHADERDEF is filled and GL calls set combiners");
}

}  // namespace
}  // namespace ninebit

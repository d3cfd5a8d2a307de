// Forms that are detected, and words that combiners do not read on their way through the forms that keep them.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/language/register_log_shapes.h"
#include "combiner_tests/language/xbox_shapes.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/json.h"
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

TEST(ProgramForms, EveryShapeOfADefinitionAndEveryLogIsDetected) {
  for (int i = 0; i < 50; ++i) {
    Random random(121, static_cast<std::uint64_t>(i));
    const Words words = random_words(random);
    const auto expected = parse_register_words({as_register_words(words), ""}, ChipClass::nv20, kFormsProfile);
    ASSERT_TRUE(expected);
    for (const Shape& shape : all_shapes()) {
      const std::string text = shape.text(words);
      ASSERT_EQ(form_of(text), ProgramForm::xbox) << shape.name << '\n' << text;
      const auto program = parse_program({text, ""}, ProgramForm::xbox, kFormsProfile);
      ASSERT_TRUE(program) << shape.name << all_faults(program);
      ASSERT_EQ(program->state, *expected) << shape.name;
      ASSERT_EQ(program->other_words.size(), kOtherWordNames.size());
    }
    Trace trace = writes_of(*encode_register_words(*expected, ChipClass::nv20, kFormsProfile), random);
    add_draw(trace, 5);
    for (const TraceStyle& style : all_styles()) {
      const std::string text = style.text(trace);
      ASSERT_EQ(form_of(text), ProgramForm::log) << style.name << '\n' << text;
      const auto program = parse_program({text, ""}, ProgramForm::log, kFormsProfile);
      ASSERT_TRUE(program) << style.name << all_faults(program);
      ASSERT_EQ(normalize(program->state, kFormsProfile), normalize(*expected, kFormsProfile)) << style.name;
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
  for (int i = 0; i < 2000; ++i) {
    Random random(122, static_cast<std::uint64_t>(i));
    const auto first = parse_program({as_bytes(random_words(random)), ""}, ProgramForm::xbox, kFormsProfile);
    ASSERT_TRUE(first) << all_faults(first);
    const auto& [state, words] = *first;
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
    EXPECT_EQ(print_register_words(state, ChipClass::nv20, kFormsProfile)->find("PSTextureModes"), std::string::npos);
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

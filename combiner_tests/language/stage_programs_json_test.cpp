// Programs with texture-shader stages: what their texts leave open, say twice, or leave without effect.
#include <gtest/gtest.h>

#include <string>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/has.h"
#include "ninebit/language/program_text.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

Parsed<TextProgram> read(const std::string& text, ProgramForm form) {
  return parse_program({text, "f"}, form, profiles::nv2a);
}

std::string all_notes(const Parsed<TextProgram>& parsed) {
  std::string all;
  for (const TextFault& note : parsed.notes) all += note.text() + "\n";
  return all;
}

// By OpenGL's rules GL_NONE gives (0, 0, 0, 0), by the chip's the alpha of a unit that is off.
TEST(StagePrograms, NoneOfEitherRulesInGlsl) {
  for (const char* rules : {"open_gl", "nv2a"}) {
    const auto program = read(std::string(R"({"ninebit": "program", "version": 1, "texture_shader": {"rules": ")") +
                                  rules + R"(", "stages": [{"operation": "pass_through"}, {"operation": "none"}]}})",
                              ProgramForm::json);
    ASSERT_TRUE(program) << all_faults(program);
    const auto text = find_form("glsl")->print(*program, ChipClass::nv20, profiles::nv2a);
    ASSERT_TRUE(text.ok()) << text.error().message;
    const bool has_alpha = text->find("texel1.a = 255") != std::string::npos;
    EXPECT_EQ(has_alpha, std::string(rules) == "nv2a") << *text;
  }
}

TEST(StagePrograms, TwoOriginsOfTheStagesAreAFault) {
  const auto program = read(R"({"ninebit": "program", "version": 1, "other_words": {"PSTextureModes": "0x1"},
"texture_shader": {"stages": [{"operation": "pass_through"}]}})",
                            ProgramForm::json);
  ASSERT_FALSE(program);
  EXPECT_TRUE(has(all_faults(program), "f:1:"));
  EXPECT_TRUE(has(all_faults(program), "PSTextureModes stands beside texture_shader"));
}

// Numbers that the words do not hold are named; of a mapping that nothing reads nothing is said.
TEST(StagePrograms, MissingNumbersAreNotes) {
  const auto lit = read("PSTextureModes = 0x000000e1\nPSDotMapping = 0x00000050\n", ProgramForm::words);
  ASSERT_TRUE(lit) << all_faults(lit);
  EXPECT_TRUE(lit->texture_shader.enabled);
  EXPECT_EQ(lit->texture_shader.stage[1].operation, TextureOperation::offset_2d_scale);
  EXPECT_TRUE(has(all_notes(lit),
                  "the bump matrix of texture stage 1, the luminance scale and offset of texture stage 1: "
                  "no word has it"));
  const auto plain = read("PSTextureModes = 0x00000081\n", ProgramForm::words);  // pass through on stage 1
  ASSERT_TRUE(plain) << all_faults(plain);
  EXPECT_FALSE(has(all_notes(plain), "no word has it"));
}

TEST(StagePrograms, StagesThatAreNotEnabledAreANote) {
  const auto program = read(
      "glActiveTexture(GL_TEXTURE0);\nglTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, "
      "GL_PASS_THROUGH_NV);\nglEnable(GL_REGISTER_COMBINERS_NV);\n",
      ProgramForm::gl);
  ASSERT_TRUE(program) << all_faults(program);
  EXPECT_FALSE(program->texture_shader.enabled);
  EXPECT_TRUE(has(all_notes(program), "not enabled by GL_TEXTURE_SHADER_NV"));
}

// Dumps have all calls of a program: units beyond the chip's are passed over, stages there are not.
TEST(StagePrograms, UnitsOfDumps) {
  const std::string enables = "3 glEnable(cap = 0x86DE)\n4 glEnable(cap = GL_REGISTER_COMBINERS_NV)\n";
  const std::string set = "2 glTexEnvi(target = GL_TEXTURE_SHADER_NV, pname = GL_SHADER_OPERATION_NV, param = 34534)\n";
  const auto good =
      read("1 glActiveTexture(texture = GL_TEXTURE4)\n1 glActiveTexture(texture = GL_TEXTURE1)\n" + set + enables,
           ProgramForm::gl);
  ASSERT_TRUE(good) << all_faults(good);
  EXPECT_TRUE(good->texture_shader.enabled);
  EXPECT_EQ(good->texture_shader.stage[1].operation, TextureOperation::pass_through);
  const auto bad = read("1 glActiveTexture(texture = GL_TEXTURE4)\n" + set + enables, ProgramForm::gl);
  EXPECT_TRUE(has(all_faults(bad), "f:2:"));
  EXPECT_TRUE(has(all_faults(bad), "beyond those of profile nv2a"));
}

}  // namespace
}  // namespace ninebit::test

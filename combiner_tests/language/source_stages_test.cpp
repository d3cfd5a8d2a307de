// Calls of texture shaders in source files: read on the unit that is active, refused by name where a value is missing.
#include <gtest/gtest.h>

#include <string>

#include "combiner_tests/support/has.h"
#include "ninebit/language/source_code.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

struct ReadSource {
  std::string faults, notes;
  GlError gl_error = GlError::no_error;  // of the first fault
  CombinerState state;
  TextureShaderState stages;
};

ReadSource read_source(const std::string& body, const SourceSelection& selection = {},
                       const HardwareProfile& profile = profiles::nv2a) {
  ReadSource read;
  const std::string text = "void set(int mode, float *matrix) {\n" + body + "}\n";
  const auto parsed = parse_source_code({text, "s.c"}, selection, profile, nullptr, &read.stages);
  for (const TextFault& note : parsed.notes) read.notes += note.message + '\n';
  if (parsed) {
    read.state = *parsed;
    return read;
  }
  read.gl_error = parsed.faults()[0].gl_error;
  for (const TextFault& fault : parsed.faults())
    read.faults += std::to_string(fault.line) + ": " + fault.message + '\n';
  return read;
}

const std::string kCombiners = "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);\n";
const std::string kEnable = "glEnable(GL_TEXTURE_SHADER_NV);\n";

TEST(SourceStages, CallsSetTheActiveUnitsStage) {
  const ReadSource read = read_source(
      "static const GLfloat m[4] = { 0.5f, 0, 0.25f, 1 }, eye[] = { 1, 2, 3 };\n"
      "int i;\n"
      "for (i = 0; i < 2; ++i) {\n"
      "  glActiveTextureARB(GL_TEXTURE0_ARB + i);\n"
      "  glTexEnvi(GL_TEXTURE_ENV, GL_TEXTURE_ENV_MODE, GL_MODULATE);\n"
      "  glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, i ? GL_OFFSET_TEXTURE_2D_NV : GL_TEXTURE_2D);\n"
      "}\n"
      "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_PREVIOUS_TEXTURE_INPUT_NV, GL_TEXTURE0_ARB);\n"
      "glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_MATRIX_NV, m);\n"
      "qglActiveTexture(GL_TEXTURE3_ARB);\n"
      "glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_CONST_EYE_NV, eye);\n" +
      kEnable + kCombiners);
  EXPECT_EQ(read.faults, "");
  EXPECT_EQ(read.state.num_general_combiners, 2);
  EXPECT_TRUE(read.stages.enabled);
  EXPECT_EQ(read.stages.stage[0].operation, TextureOperation::texture_2d);
  EXPECT_EQ(read.stages.stage[1].operation, TextureOperation::offset_2d);
  EXPECT_EQ(read.stages.stage[1].matrix, (std::array<float, 4>{0.5F, 0, 0.25F, 1}));
  EXPECT_EQ(read.stages.stage[3].eye, (std::array<float, 3>{1, 2, 3}));
  EXPECT_FALSE(has(read.notes, "took 0 for the fourth"));
}

TEST(SourceStages, AreAProgramWithoutCombiners) {
  const ReadSource read = read_source(
      "glActiveTexture(GL_TEXTURE0);\n"
      "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_PASS_THROUGH_NV);\n" +
      kEnable);
  EXPECT_EQ(read.faults, "");
  EXPECT_EQ(read.stages.stage[0].operation, TextureOperation::pass_through);
}

TEST(SourceStages, OfNvparseAreRead) {
  const std::string load = "nvparse(\"!!TS1.0\\ntexture_2d();\\ndependent_ar(tex0);\\n\");\n";
  const ReadSource read = read_source(kCombiners + load + kEnable);
  EXPECT_EQ(read.faults, "");
  EXPECT_TRUE(read.stages.enabled);
  EXPECT_EQ(read.stages.stage[1].operation, TextureOperation::dependent_ar);
  EXPECT_EQ(read.state.num_general_combiners, 2) << "the combiners stay";
}

// A literal of nvparse is a program: if nothing enables or disables texture shaders, its stages count, with a note.
TEST(SourceStages, LiteralsThatNothingEnablesCount) {
  const std::string load = "nvparse(\"!!TS1.0\\ntexture_2d();\\ndependent_ar(tex0);\\n\");\n";
  const ReadSource read = read_source(load);
  EXPECT_EQ(read.faults, "");
  EXPECT_TRUE(read.stages.enabled);
  EXPECT_EQ(read.stages.stage[1].operation, TextureOperation::dependent_ar);
  EXPECT_TRUE(has(read.notes, "nothing here enables or disables GL_TEXTURE_SHADER_NV"));
  EXPECT_FALSE(has(read.notes, "!!RC1.0"));
  EXPECT_FALSE(read_source(load + "glDisable(GL_TEXTURE_SHADER_NV);\n").stages.enabled);
  EXPECT_FALSE(has(read_source(load + kEnable).notes, "nothing here enables"));
}

TEST(SourceStages, WithoutEnableTheyHaveNoEffectAndThatIsSaid) {
  const ReadSource read =
      read_source("glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_PASS_THROUGH_NV);\n" + kCombiners);
  EXPECT_EQ(read.faults, "");
  EXPECT_FALSE(read.stages.enabled);
  EXPECT_TRUE(has(read.notes, "set and not enabled by GL_TEXTURE_SHADER_NV"));
}

TEST(SourceStages, UnknownValuesAreAskedForByName) {
  const std::string set = "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);\n";
  EXPECT_TRUE(has(read_source("glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, mode);\n" + kEnable).faults,
                  "'mode' (line 2)"));
  EXPECT_TRUE(
      has(read_source("glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_MATRIX_NV, matrix);\n" + kEnable).faults,
          "'matrix' (line 2, 4 numbers)"));
  EXPECT_TRUE(has(read_source("glActiveTexture(mode);\n" + set + kEnable).faults, "'mode' (line 3)"));
  // A unit that may not have been selected; one that is selected for certain afterwards.
  EXPECT_TRUE(has(read_source("if (mode == 3) glActiveTexture(GL_TEXTURE1);\n" + set + kEnable).faults, "'mode'"));
  EXPECT_EQ(read_source("if (mode == 3) glActiveTexture(GL_TEXTURE1);\nglActiveTexture(GL_TEXTURE0);\n" + set + kEnable)
                .faults,
            "");
  // A call that may not be reached.
  EXPECT_TRUE(has(read_source(kCombiners + "if (mode == 3) " + set + kEnable).faults, "'mode'"));
  const ReadSource given = read_source("glActiveTexture(mode);\n" + set + kEnable,
                                       {.functions = {}, .definitions = {{"mode", "GL_TEXTURE2_ARB"}}});
  EXPECT_EQ(given.faults, "");
  EXPECT_EQ(given.stages.stage[2].operation, TextureOperation::texture_2d);
}

TEST(SourceStages, WrongCallsAreFaults) {
  EXPECT_TRUE(has(read_source("glActiveTexture(GL_TEXTURE0 + 5);\n"
                              "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);\n")
                      .faults,
                  "3: the active texture unit has no texture-shader stage"));
  EXPECT_TRUE(
      has(read_source("glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_OFFSET_TEXTURE_2D_NV);\n").faults,
          "2: texture stage 0: 'GL_OFFSET_TEXTURE_2D_NV' is for stages 1 to 3 only"));
  EXPECT_TRUE(
      has(read_source("float two[2] = { 1, 2 };\nglTexEnvfv(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_MATRIX_NV, two);\n")
              .faults,
          "4 values, not 2"));
}

// Enabled stages are a part of the program, which a chip without them does not run.
TEST(SourceStages, AProfileWithoutTextureShadersRefusesThemWhereTheyAreEnabled) {
  const std::string
      set =
          "glActiveTexture(GL_TEXTURE3);\n"
          "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, mode);\n",
      load = "nvparse(\"!!TS1.0\\ntexture_2d();\\n\");\n",
      both = "nvparse(\"!!TS1.0\\ntexture_2d();\\n!!RC1.0\\n{ rgb { spare0 = col0; } }\\nout.rgb = spare0;\\n\");\n";
  const auto read = [](const std::string& body) { return read_source(body, {}, profiles::geforce2); };
  for (const std::string& stages : {std::string(), set, load, both}) {
    const ReadSource refused = read(kCombiners + stages + kEnable);
    EXPECT_TRUE(has(refused.faults, "profile geforce2 has no texture shaders"));
    EXPECT_EQ(refused.gl_error, GlError::invalid_enum);
    EXPECT_TRUE(has(refused.faults, "such as nv2a"));
    // Without that they have no effect, and that is said.
    for (const std::string disable : {"", "glDisable(GL_TEXTURE_SHADER_NV);\n"}) {
      const ReadSource kept = read(kCombiners + stages + disable);
      EXPECT_EQ(kept.faults, "");
      EXPECT_FALSE(kept.stages.enabled);
      EXPECT_EQ(kept.state.num_general_combiners, stages == both ? 1 : 2);
      EXPECT_FALSE(has(kept.notes, "not for combiners"));
      EXPECT_EQ(kept.notes.find("left out; profile geforce2 has none") != std::string::npos, !stages.empty())
          << kept.notes;
    }
  }
  // Stages alone are no program for this chip.
  EXPECT_TRUE(has(read(load).faults, "2: profile geforce2 has no texture shaders"));
  EXPECT_TRUE(has(read(set).faults, "3: profile geforce2 has no texture shaders"));
  // The extension is not there.
  EXPECT_EQ(read("if (isSupported(\"GL_NV_texture_shader\")) {\n" + kEnable + "}\n" + kCombiners).faults, "");
  EXPECT_TRUE(
      read_source("if (isSupported(\"GL_NV_texture_shader\")) {\n" + kEnable + "}\n" + kCombiners).stages.enabled);
}

// A program that is drawn with has the stages of that moment.
TEST(SourceStages, BelongToTheProgramThatIsDrawn) {
  const std::string body = kCombiners + "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);\n" +
                           kEnable +
                           "glDrawArrays(GL_TRIANGLES, 0, 3);\n"
                           "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_CUBE_MAP_ARB);\n"
                           "glDrawArrays(GL_TRIANGLES, 0, 3);\n";
  SourceSelection second;
  second.program = 2;
  EXPECT_TRUE(has(read_source(body).faults, "draws with 2 programs"));
  EXPECT_EQ(read_source(body, second).stages.stage[0].operation, TextureOperation::texture_cube_map);
}

}  // namespace
}  // namespace ninebit::test

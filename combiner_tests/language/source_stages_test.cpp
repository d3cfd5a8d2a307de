// Calls of texture shaders in source files: read on the unit that is active, refused by name where a value is missing.
#include <gtest/gtest.h>

#include <string>

#include "ninebit/language/source_code.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {
namespace {

struct ReadSource {
  std::string faults, notes;
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
  EXPECT_EQ(read.notes.find("took 0 for the fourth"), std::string::npos) << read.notes;
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
  EXPECT_NE(read.notes.find("nothing here enables or disables GL_TEXTURE_SHADER_NV"), std::string::npos) << read.notes;
  EXPECT_EQ(read.notes.find("!!RC1.0"), std::string::npos) << read.notes;
  EXPECT_FALSE(read_source(load + "glDisable(GL_TEXTURE_SHADER_NV);\n").stages.enabled);
  EXPECT_EQ(read_source(load + kEnable).notes.find("nothing here enables"), std::string::npos);
}

TEST(SourceStages, WithoutEnableTheyHaveNoEffectAndThatIsSaid) {
  const ReadSource read =
      read_source("glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_PASS_THROUGH_NV);\n" + kCombiners);
  EXPECT_EQ(read.faults, "");
  EXPECT_FALSE(read.stages.enabled);
  EXPECT_NE(read.notes.find("set and not enabled by GL_TEXTURE_SHADER_NV"), std::string::npos) << read.notes;
}

TEST(SourceStages, UnknownValuesAreAskedForByName) {
  const std::string set = "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);\n";
  EXPECT_NE(read_source("glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, mode);\n" + kEnable)
                .faults.find("'mode' (line 2)"),
            std::string::npos);
  EXPECT_NE(read_source("glTexEnvfv(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_MATRIX_NV, matrix);\n" + kEnable)
                .faults.find("'matrix' (line 2, 4 numbers)"),
            std::string::npos);
  EXPECT_NE(read_source("glActiveTexture(mode);\n" + set + kEnable).faults.find("'mode' (line 3)"), std::string::npos);
  // A unit that may not have been selected; one that is selected for certain afterwards.
  EXPECT_NE(read_source("if (mode == 3) glActiveTexture(GL_TEXTURE1);\n" + set + kEnable).faults.find("'mode'"),
            std::string::npos);
  EXPECT_EQ(read_source("if (mode == 3) glActiveTexture(GL_TEXTURE1);\nglActiveTexture(GL_TEXTURE0);\n" + set + kEnable)
                .faults,
            "");
  // A call that may not be reached.
  EXPECT_NE(read_source(kCombiners + "if (mode == 3) " + set + kEnable).faults.find("'mode'"), std::string::npos);
  const ReadSource given = read_source("glActiveTexture(mode);\n" + set + kEnable,
                                       {.functions = {}, .definitions = {{"mode", "GL_TEXTURE2_ARB"}}});
  EXPECT_EQ(given.faults, "");
  EXPECT_EQ(given.stages.stage[2].operation, TextureOperation::texture_2d);
}

TEST(SourceStages, WrongCallsAreFaults) {
  EXPECT_NE(read_source("glActiveTexture(GL_TEXTURE0 + 5);\n"
                        "glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);\n")
                .faults.find("3: the active texture unit has no texture-shader stage"),
            std::string::npos);
  EXPECT_NE(read_source("glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_OFFSET_TEXTURE_2D_NV);\n")
                .faults.find("2: texture stage 0: 'GL_OFFSET_TEXTURE_2D_NV' is for stages 1 to 3 only"),
            std::string::npos);
  EXPECT_NE(
      read_source("float two[2] = { 1, 2 };\nglTexEnvfv(GL_TEXTURE_SHADER_NV, GL_OFFSET_TEXTURE_MATRIX_NV, two);\n")
          .faults.find("4 values, not 2"),
      std::string::npos);
}

TEST(SourceStages, AProfileWithoutTextureShadersSkipsThemWithANote) {
  const ReadSource read =
      read_source("glTexEnvi(GL_TEXTURE_SHADER_NV, GL_SHADER_OPERATION_NV, GL_TEXTURE_2D);\n" + kEnable + kCombiners,
                  {}, profiles::geforce2);
  EXPECT_EQ(read.faults, "");
  EXPECT_FALSE(read.stages.enabled);
  EXPECT_NE(read.notes.find("glTexEnvi"), std::string::npos) << read.notes;
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
  EXPECT_NE(read_source(body).faults.find("draws with 2 programs"), std::string::npos);
  EXPECT_EQ(read_source(body, second).stages.stage[0].operation, TextureOperation::texture_cube_map);
}

}  // namespace
}  // namespace ninebit::test

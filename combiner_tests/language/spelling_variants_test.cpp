// The ways in which programs of the time, and bindings of other languages, spell the calls of the register combiners:
// each is read as the call of C, in the form of GL calls and in a source file.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/source_code.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

struct Variants {
  std::string canonical;
  std::vector<std::string> spellings;  // '@' stands for the canonical arguments
};

const std::vector<Variants> kInputs{
    {"glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE1, GL_EXPAND_NORMAL_NV, GL_RGB);",
     {
         "::glCombinerInputNV(@);",
         "glx::glCombinerInputNV(@);",
         "vtkgl::CombinerInputNV(vtkgl::COMBINER0_NV, GL_RGB, vtkgl::VARIABLE_B_NV, vtkgl::TEXTURE1, "
         "vtkgl::EXPAND_NORMAL_NV, GL_RGB);",
         "this->gl.ext.p_glCombinerInputNV(@);",
         "gl->fCombinerInputNV(@);",
         "(*glCombinerInputNV)(@);",
         "(*gl->CombinerInputNV)(@);",
         "EXTCALL(glCombinerInputNV(@));",
         "CHECK(gl.glCombinerInputNV(@), \"input\");",
         "EXTCALL(glCombinerInputNV)(@);",
         "gl.glCombinerInputNV(GL.GL_COMBINER0_NV, GL.GL_RGB, GL.GL_VARIABLE_B_NV, GL.GL_TEXTURE1, "
         "GL.GL_EXPAND_NORMAL_NV, GL.GL_RGB);",
         "NVRegisterCombiners.glCombinerInputNV(NVRegisterCombiners.GL_COMBINER0_NV, GL11.GL_RGB, "
         "NVRegisterCombiners.GL_VARIABLE_B_NV, GL13.GL_TEXTURE1, NVRegisterCombiners.GL_EXPAND_NORMAL_NV, "
         "GL11.GL_RGB);",
         "GL.NV.CombinerInput(NvRegisterCombiners.Combiner0Nv, NvRegisterCombiners.Rgb, "
         "NvRegisterCombiners.VariableBNv, NvRegisterCombiners.Texture1Arb, NvRegisterCombiners.ExpandNormalNv, "
         "NvRegisterCombiners.Rgb);",
         "GL.NV.CombinerInput((NvRegisterCombiners)All.Combiner0Nv, All.Rgb, All.VariableBNv, All.Texture1, "
         "All.ExpandNormalNv, All.Rgb);",
         "Gl.CombinerInputNV(Gl.COMBINER0_NV, Gl.RGB, Gl.VARIABLE_B_NV, Gl.TEXTURE1, Gl.EXPAND_NORMAL_NV, Gl.RGB);",
         "glCombinerInputNV(COMBINER0_NV, GL_RGB, VARIABLE_B_NV, TEXTURE1_ARB, EXPAND_NORMAL_NV, RGB_EXT);",
         "glCombinerInputNV(GL_COMBINER0, GL_RGB, GL_VARIABLE_B, GL_TEXTURE1_EXT, GL_EXPAND_NORMAL, GL_RGB);",
         "glCombinerInputNV(GL_COMBINER0_ARB, GL_RGB_EXT, GL_VARIABLE_B_EXT, GL_TEXTURE1_NV, GL_EXPAND_NORMAL_ARB, "
         "GL_RGB);",
         "glCombinerInputNV(NV.Combiner0Nv, All.Rgb, NV.VariableBNv, TextureUnit.Texture1, NV.ExpandNormalNv, "
         "All.Rgb);",
         "glCombinerInputNV(0x8550, 0x1907, 0x8524, 0x84C1, 0x8538, 0x1907);",
         "glCombinerInputNV(34128u, 6407u, 34084u, 33985u, 34104u, 6407u);",
         "glCombinerInputNV(GL_COMBINER0_NV + 0, GL_RGB, GL_VARIABLE_A_NV + 1, GL_TEXTURE0_ARB + 1, "
         "GL_EXPAND_NORMAL_NV, GL_RGB);",
         "glCombinerInputNV((GLenum)GL_COMBINER0_NV, (GLenum)GL_RGB, GL_VARIABLE_B_NV, (GLenum)(GL_TEXTURE0_ARB+1), "
         "GL_EXPAND_NORMAL_NV, GL_RGB);",
         "glCombinerInputNV((GL_COMBINER0_NV), (GL_RGB), ((GL_VARIABLE_B_NV)), (GL_TEXTURE1), (GL_EXPAND_NORMAL_NV), "
         "(GL_RGB));",
         "glCombinerInputNV(static_cast<GLenum>(GL_COMBINER0_NV), GLenum(GL_RGB), GLenum(GL_VARIABLE_B_NV), "
         "GLenum(GL_TEXTURE0_ARB + 1), GL_EXPAND_NORMAL_NV, GL_RGB);",
         "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE1_ARB, GL_EXPAND_NORMAL_NV, GL_RGB)",
     }},
};

const std::vector<Variants> kOthers{
    {"glCombinerOutputNV(GL_COMBINER1_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, "
     "GL_TRUE, GL_FALSE, GL_FALSE);",
     {
         "qglCombinerOutputNV(GL_COMBINER1_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, 0, 0, true, false, "
         "false);",
         "glCombinerOutputNV(GL_COMBINER1_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, 1, "
         "0, 0);",
         "glCombinerOutputNV(GL_COMBINER1_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, "
         "(GLboolean)GL_TRUE, (GLboolean)0, GLboolean(0));",
         "glCombinerOutputNV(COMBINER1_NV, GL_RGB, SPARE0_NV, DISCARD_NV, DISCARD_NV, GL_NONE, GL_NONE, GL_TRUE, "
         "GL_FALSE, GL_FALSE);",
         "vtkgl::CombinerOutputNV(vtkgl::COMBINER1_NV, GL_RGB, vtkgl::SPARE0_NV, vtkgl::DISCARD_NV, vtkgl::DISCARD_NV, "
         "GL_NONE, GL_NONE, GL_TRUE, GL_FALSE, GL_FALSE);",
         "GL.NV.CombinerOutput(NvRegisterCombiners.Combiner1Nv, NvRegisterCombiners.Rgb, NvRegisterCombiners.Spare0Nv, "
         "NvRegisterCombiners.DiscardNv, NvRegisterCombiners.DiscardNv, NvRegisterCombiners.None, "
         "NvRegisterCombiners.None, true, false, false);",
         "NVRegisterCombiners.glCombinerOutputNV(GL_COMBINER1_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, "
         "GL_NONE, GL_NONE, true, false, false);",
     }},
    {"glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_E_TIMES_F_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);",
     {
         "pglFinalCombinerInputNV(@);",
         "FinalCombinerInputNV(@);",
         "GLCALL(glFinalCombinerInputNV(@));",
         "GL.NV.FinalCombinerInput(NvRegisterCombiners.VariableDNv, NvRegisterCombiners.ETimesFNv, "
         "NvRegisterCombiners.UnsignedIdentityNv, NvRegisterCombiners.Rgb);",
         "glFinalCombinerInputNV(GL_VARIABLE_D, GL_E_TIMES_F, GL_UNSIGNED_IDENTITY, GL_RGB_NV);",
         "glFinalCombinerInputNV(0x8526, 0x8531, 0x8536, 0x1907);",
     }},
    {"glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);",
     {
         "qglCombinerParameteriNV( @ );",
         "glCombinerParameteri(GL_NUM_GENERAL_COMBINERS, 2);",
         "glCombinerParameterfNV(GL_NUM_GENERAL_COMBINERS_NV, 2.0f);",
         "gl.glCombinerParameteriNV(gl.GL_NUM_GENERAL_COMBINERS_NV, (int)2);",
         "vtkgl::CombinerParameteriNV(vtkgl::NUM_GENERAL_COMBINERS_NV, 2);",
         "GL.NV.CombinerParameter(NvRegisterCombiners.NumGeneralCombinersNv, 2);",
         "glCombinerParameterNV(GL_NUM_GENERAL_COMBINERS_NV, 2.0f);",
         "glCombinerParameteriNV(0x854E, 0x2);",
     }},
    {"glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, GL_TRUE);",
     {
         "glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, TRUE);",
         "glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, true);",
         "glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, (GLint)GL_TRUE);",
         "glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, GLint(GL_TRUE));",
     }},
    {"glEnable(GL_PER_STAGE_CONSTANTS_NV);",
     {
         "qglEnable(GL_PER_STAGE_CONSTANTS_NV);",
         "gl.glEnable(GL.GL_PER_STAGE_CONSTANTS_NV);",
         "gl.enable(GL_PER_STAGE_CONSTANTS_NV);",
         "vtkgl::Enable(vtkgl::PER_STAGE_CONSTANTS_NV);",
         "GL.Enable(NvRegisterCombiners2.PerStageConstantsNv);",
         "GL.Enable((EnableCap)NvRegisterCombiners2.PerStageConstantsNv);",
         "glEnable(0x8535);",
     }},
    {"static const GLfloat c[4] = {1, 0.5f, 0, 1};\nglCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, c);",
     {
         "static const GLfloat c[4] = {1, 0.5f, 0, 1};\nglCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, &c[0]);",
         "static const GLfloat c[4] = {1, 0.5f, 0, 1};\nqglCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, (float*)&c);",
         "static const GLfloat c[4] = {1, 0.5f, 0, 1};\nglCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, (const GLfloat "
         "*)c);",
         "static const GLfloat c[4] = {1, 0.5f, 0, 1};\nglCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, "
         "reinterpret_cast<const GLfloat*>(c));",
         "glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, (GLfloat[]){1, 0.5f, 0, 1});",
         "glCombinerParameterfv(GL_CONSTANT_COLOR0, (const float[4]) {1.0f, .5f, 0, 1.0});",
         "glCombinerParameterNV(GL_CONSTANT_COLOR0_NV, {1, 0.5, 0, 1});",
         "gl.glCombinerParameterfvNV(GL.GL_CONSTANT_COLOR0_NV, new float[] {1f, 0.5f, 0f, 1f}, 0);",
         "GL.NV.CombinerParameter(NvRegisterCombiners.ConstantColor0Nv, new float[] {1.0f, 0.5f, 0, 1});",
     }},
    {"glCombinerStageParameterfvNV(GL_COMBINER1_NV, GL_CONSTANT_COLOR1_NV, (GLfloat[]){0, 0, 1, 1});",
     {
         "pglCombinerStageParameterfvNV(GL_COMBINER1_NV, GL_CONSTANT_COLOR1_NV, (GLfloat[4]){0, 0, 1, 1});",
         "NVRegisterCombiners2.glCombinerStageParameterNV(GL_COMBINER1_NV, GL_CONSTANT_COLOR1_NV, {0, 0, 1, 1});",
         "vtkgl::CombinerStageParameterfvNV(vtkgl::COMBINER1_NV, vtkgl::CONSTANT_COLOR1_NV, (float[]){0, 0, 1, 1});",
     }},
};

CombinerState calls(const std::string& text) {
  const auto parsed = parse_gl_calls({text, "calls"}, profiles::nv2a);
  EXPECT_TRUE(parsed) << text << "\n" << test::all_faults(parsed);
  return parsed ? *parsed : CombinerState{};
}

CombinerState source(const std::string& text) {
  const auto parsed = parse_source_code({text, "source"}, {}, profiles::nv2a);
  EXPECT_TRUE(parsed) << text << "\n" << test::all_faults(parsed);
  return parsed ? *parsed : CombinerState{};
}

// A call that is read is no longer GL's default, whatever the variant says.
const std::string kOther = "glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 3);\n";

void check(const std::vector<Variants>& all) {
  for (const Variants& one : all) {
    const CombinerState expected = calls(kOther + one.canonical);
    const std::size_t call = one.canonical.find("gl"), open = one.canonical.find('(', call) + 1;
    const std::string arguments = one.canonical.substr(open, one.canonical.rfind(')') - open);
    for (std::string spelling : one.spellings) {
      if (const std::size_t at = spelling.find('@'); at != std::string::npos) spelling.replace(at, 1, arguments);
      // A text without semicolons is a program, too.
      const bool alone = spelling.find(';') == std::string::npos;
      EXPECT_TRUE(calls((alone ? kOther.substr(0, kOther.size() - 2) + "\n" : kOther) + spelling) == expected)
          << spelling;
      EXPECT_TRUE(source("void set(void)\n{\n" + kOther + spelling + (alone ? ";" : "") + "\n}\n") == expected)
          << spelling;
    }
  }
}

TEST(SpellingVariants, OfInputs) {
  check(kInputs);
}

TEST(SpellingVariants, OfOtherCalls) {
  check(kOthers);
  EXPECT_EQ(calls("glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, FloatBuffer.wrap(new float[] {1f, 0.5f, 0f, 1f}));"),
            calls("glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, {1, 0.5, 0, 1});"));
}

TEST(SpellingVariants, OthersAreNotRead) {
  const std::vector<const char*> wrong{
      "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE1_ARB, GL_EXPAND_NORMAL_NV);",
      "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, (GL_TEXTURE1_ARB, GL_EXPAND_NORMAL_NV, GL_RGB);",
      "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, other(GL_TEXTURE1), GL_EXPAND_NORMAL_NV, GL_RGB);",
      "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, SPARE0, GL_EXPAND_NORMAL_NV, GL_RGB);",
      "glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, ZERO, GL_EXPAND_NORMAL_NV, GL_RGB);",
      "glGetCombinerInputParameterivNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_COMBINER_INPUT_NV, v);",
      "CHECK(glEnable(GL_REGISTER_COMBINERS_NV);",
      "(*glEnable(GL_REGISTER_COMBINERS_NV);",
      "state.enabled(GL_REGISTER_COMBINERS_NV);",
      "glEnable(((((((((((((((((((GL_REGISTER_COMBINERS_NV)))))))))))))))))));",
      "glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, new Vector(1, 0, 0, 1));",
      "glEnable($);",
      "glEnable($85zz);",
  };
  for (const char* const text : wrong) {
    const auto parsed = parse_gl_calls({text, "calls"}, profiles::nv2a);
    EXPECT_FALSE(parsed) << text;
    EXPECT_FALSE(parsed.faults().empty()) << text;
  }
}

TEST(SpellingVariants, ManyInEachOtherAreBounded) {
  for (const std::string part : {"(GLenum)", "(", "GLenum(", "static_cast<GLenum>("}) {
    std::string text = "glEnable(";
    for (int i = 0; i < 200'000; ++i) text += part;
    const auto parsed = parse_gl_calls({text + "GL_REGISTER_COMBINERS_NV);", "calls"}, profiles::nv2a);
    // Casts in a row have no depth.
    EXPECT_EQ(parsed.ok(), part == "(GLenum)") << part;
  }
}

}  // namespace
}  // namespace ninebit

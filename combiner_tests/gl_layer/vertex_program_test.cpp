// NV_vertex_program on the driver: what instructions compute, tracked matrices, and what combiners get.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "combiner_tests/gl_layer/vertex_program_kit.h"

namespace ninebit::test {
namespace {

void expect_near(const Floats& got, const Floats& expected, const std::string& what) {
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(got[i], expected[i], 2e-4F * std::max(1.0F, std::fabs(expected[i]))) << what << " component " << i;
  }
}

template <class Function>
Floats by_component(const Floats& a, const Floats& b, const Function& function) {
  return {function(a[0], b[0]), function(a[1], b[1]), function(a[2], b[2]), function(a[3], b[3])};
}

Floats filled(GLfloat value) {
  return {value, value, value, value};
}

// As the specification has it, written without the layer's code.
Floats expected_result(const std::string& opcode, const Floats& a, const Floats& b, const Floats& c) {
  const GLfloat dot = a[0] * b[0] + a[1] * b[1] + a[2] * b[2], w = a[3];
  if (opcode == "MOV") return a;
  if (opcode == "ABS") return by_component(a, b, [](GLfloat x, GLfloat) { return std::fabs(x); });
  if (opcode == "MUL") return by_component(a, b, [](GLfloat x, GLfloat y) { return x * y; });
  if (opcode == "ADD") return by_component(a, b, [](GLfloat x, GLfloat y) { return x + y; });
  if (opcode == "SUB") return by_component(a, b, [](GLfloat x, GLfloat y) { return x - y; });
  if (opcode == "MIN") return by_component(a, b, [](GLfloat x, GLfloat y) { return std::fmin(x, y); });
  if (opcode == "MAX") return by_component(a, b, [](GLfloat x, GLfloat y) { return std::fmax(x, y); });
  if (opcode == "SLT") return by_component(a, b, [](GLfloat x, GLfloat y) { return x < y ? 1.0F : 0.0F; });
  if (opcode == "SGE") return by_component(a, b, [](GLfloat x, GLfloat y) { return x < y ? 0.0F : 1.0F; });
  if (opcode == "MAD") return {a[0] * b[0] + c[0], a[1] * b[1] + c[1], a[2] * b[2] + c[2], a[3] * b[3] + c[3]};
  if (opcode == "DP3") return filled(dot);
  if (opcode == "DP4") return filled(dot + a[3] * b[3]);
  if (opcode == "DPH") return filled(dot + b[3]);
  if (opcode == "DST") return {1, a[1] * b[1], a[2], b[3]};
  if (opcode == "RCP" || opcode == "RCC") return filled(1 / w);
  if (opcode == "RSQ") return filled(1 / std::sqrt(std::fabs(w)));
  if (opcode == "EXP") return {std::exp2(std::floor(w)), w - std::floor(w), std::exp2(w), 1};
  if (opcode == "LOG") {
    const GLfloat exponent = std::floor(std::log2(std::fabs(w)));
    return {exponent, std::fabs(w) / std::exp2(exponent), std::log2(std::fabs(w)), 1};
  }
  return {1, std::fmax(a[0], 0.0F), a[0] > 0 ? std::pow(std::fmax(a[1], 0.0F), a[3]) : 0.0F, 1};  // LIT
}

constexpr Floats kInputs[3][3]{{{0.5F, -2, 3, 1.25F}, {4, -0.25F, 3, -8}, {1, 2, 3, 4}},
                               {{-0.5F, 0.75F, 10, -3.5F}, {0, 0.75F, -1, 2}, {-4, 0.5F, 0, 1}},
                               {{2, 0.5F, -1, 3}, {2, 1, 7, 0.125F}, {0, -1, 1, 100}}};

struct Opcode {
  std::string name;
  int operands;
  bool is_scalar;
  bool is_1_1;
};
const Opcode kOpcodes[]{
    {"MOV", 1, false, false}, {"MUL", 2, false, false}, {"ADD", 2, false, false}, {"MAD", 3, false, false},
    {"RCP", 1, true, false},  {"RSQ", 1, true, false},  {"DP3", 2, false, false}, {"DP4", 2, false, false},
    {"DST", 2, false, false}, {"MIN", 2, false, false}, {"MAX", 2, false, false}, {"SLT", 2, false, false},
    {"SGE", 2, false, false}, {"EXP", 1, true, false},  {"LOG", 1, true, false},  {"LIT", 1, false, false},
    {"DPH", 2, false, true},  {"RCC", 1, true, true},   {"SUB", 2, false, true},  {"ABS", 1, false, true}};

std::string operands_of(const Opcode& opcode) {
  if (opcode.is_scalar) return "R0.w";
  return opcode.operands == 1 ? "R0" : opcode.operands == 2 ? "R0, R1" : "R0, R1, R2";
}

TEST(LayerVertexPrograms, EachInstruction) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  for (const Opcode& opcode : kOpcodes) {
    const std::string text = showing("MOV R0, v[TEX0]; MOV R1, v[WGHT]; MOV R2, c[7]; " + opcode.name + " R3, " +
                                     operands_of(opcode) + "; MOV o[TEX0], R3;");
    ASSERT_EQ(use_vertex_program(1, text), kNoError) << text;
    for (const auto& [a, b, c] : kInputs) {
      glVertexAttrib4fvNV(8, a.data());
      glVertexAttrib4fvNV(1, b.data());
      glProgramParameter4fvNV(GL_VERTEX_PROGRAM_NV, 7, c.data());
      expect_near(drawn_point(), expected_result(opcode.name, a, b, c), opcode.name);
    }
  }
}

TEST(LayerVertexPrograms, EachInstructionOfStatePrograms) {
  NINEBIT_VERTEX_CONTEXT(context);
  for (const Opcode& opcode : kOpcodes) {
    if (opcode.is_1_1) continue;
    const std::string text = "!!VSP1.0 MOV R0, v[0]; MOV R1, c[6]; MOV R2, c[7]; " + opcode.name + " R3, " +
                             operands_of(opcode) + "; MOV c[8], R3;END";
    glLoadProgramNV(GL_VERTEX_STATE_PROGRAM_NV, 1, static_cast<GLsizei>(text.size()),
                    reinterpret_cast<const GLubyte*>(text.data()));
    for (const auto& [a, b, c] : kInputs) {
      glProgramParameter4fvNV(GL_VERTEX_PROGRAM_NV, 6, b.data());
      glProgramParameter4fvNV(GL_VERTEX_PROGRAM_NV, 7, c.data());
      glExecuteProgramNV(GL_VERTEX_STATE_PROGRAM_NV, 1, a.data());
      Floats got{};
      glGetProgramParameterfvNV(GL_VERTEX_PROGRAM_NV, 8, GL_PROGRAM_PARAMETER_NV, got.data());
      expect_near(got, expected_result(opcode.name, a, b, c), opcode.name);
    }
  }
}

TEST(LayerVertexPrograms, OperandsAndRegisters) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  const std::pair<std::string, Floats> cases[]{
      {"MOV o[TEX0], -c[1].wzyx;", {-4, -3, -2, -1}},
      {"MOV o[TEX0], c[1].y;", {2, 2, 2, 2}},
      {"MOV o[TEX0].yw, c[1];", {0, 2, 0, 4}},
      {"MOV o[TEX0].x, c[1].w; MOV o[TEX0].z, -c[1].x;", {4, 0, -1, 1}},
      {"MOV R11.y, c[1]; MOV o[TEX0], R11;", {0, 2, 0, 0}},
      {"MOV o[TEX0], R7;", {0, 0, 0, 0}},
      {"MOV o[TEX0], c[A0.x + 1];", {1, 2, 3, 4}},
      {"ARL A0.x, c[2].x; MOV o[TEX0], c[A0.x];", {5, 5, 5, 5}},       // 3.9: c[3]
      {"ARL A0.x, c[2].y; MOV o[TEX0], c[A0.x + 4];", {5, 5, 5, 5}},   // -0.5: c[3]
      {"ARL A0.x, c[2].x; MOV o[TEX0], c[A0.x - 3];", {7, 7, 7, 7}},   // c[0]
      {"ARL A0.x, c[2].x; MOV o[TEX0], c[A0.x - 4];", {0, 0, 0, 0}},   // c[-1]
      {"ARL A0.x, c[2].z; MOV o[TEX0], c[A0.x + 63];", {9, 9, 9, 9}},  // c[95]
      {"ARL A0.x, c[2].w; MOV o[TEX0], c[A0.x];", {0, 0, 0, 0}},       // c[1e9]
      {"ARL A0.x, -c[2].w; MOV o[TEX0], c[A0.x - 64];", {0, 0, 0, 0}},
      {"ARL A0.x, c[2].x; ADD R0, c[A0.x], -c[A0.x].y; MOV R1, c[1]; MAD o[TEX0], R1, c[A0.x - 2], R0;", {1, 4, 9, 16}},
  };
  for (const auto& [text, expected] : cases) {
    ASSERT_EQ(use_vertex_program(1, showing(text)), kNoError) << text;
    glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 7, 7, 7, 7);
    glProgramParameter4dNV(GL_VERTEX_PROGRAM_NV, 1, 1, 2, 3, 4);
    glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 2, 3.9F, -0.5F, 32, 1e9F);
    glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 3, 5, 5, 5, 5);
    glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 95, 9, 9, 9, 9);
    EXPECT_EQ(drawn_point(), expected) << text;
  }
}

TEST(LayerVertexPrograms, ClampedReciprocals) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  ASSERT_EQ(use_vertex_program(1, showing("RCC o[TEX0], c[0].x;")), kNoError);
  const std::pair<GLfloat, GLfloat> cases[]{{0.0F, 0x1p64F},        {-0.0F, -0x1p64F},   {INFINITY, 0x1p-64F},
                                            {-INFINITY, -0x1p-64F}, {0x1p70F, 0x1p-64F}, {0x1p-70F, 0x1p64F},
                                            {-4.0F, -0.25F}};
  for (const auto& [x, expected] : cases) {
    glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, x, 0, 0, 0);
    EXPECT_EQ(drawn_point()[0], expected) << x;
  }
}

// Rows of a matrix by columns.
Floats row_of(const GLfloat* matrix, std::size_t row) {
  return {matrix[row], matrix[4 + row], matrix[8 + row], matrix[12 + row]};
}

TEST(LayerVertexPrograms, TrackedMatrices) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  // Each is a scale and a move, whose inverse is known.
  struct Tracked {
    GLenum mode, unit, matrix;
  };
  const Tracked all[]{{GL_MODELVIEW, 0, GL_MODELVIEW},
                      {GL_PROJECTION, 0, GL_PROJECTION},
                      {GL_TEXTURE, 2, GL_TEXTURE2},
                      {GL_MATRIX0_NV, 0, GL_MATRIX0_NV},
                      {GL_MATRIX7_NV, 0, GL_MATRIX7_NV}};
  constexpr GLfloat kMatrix[16]{2, 0, 0, 0, 0, 4, 0, 0, 0, 0, 8, 0, 3, 5, 7, 1};
  constexpr GLfloat kInverse[16]{0.5F, 0, 0, 0, 0, 0.25F, 0, 0, 0, 0, 0.125F, 0, -1.5F, -1.25F, -0.875F, 1};
  const auto transposed = [](const GLfloat* m, std::size_t row) {
    return Floats{m[4 * row], m[4 * row + 1], m[4 * row + 2], m[4 * row + 3]};
  };
  for (const Tracked& one : all) {
    glActiveTexture(GL_TEXTURE0 + one.unit);
    glMatrixMode(one.mode);
    glLoadIdentity();
    for (GLuint k = 0; k < 4; ++k) {
      const std::string text = showing("MOV o[TEX0], c[" + std::to_string(20 + k) + "];");
      ASSERT_EQ(use_vertex_program(1, text), kNoError);
      for (GLenum transform = GL_IDENTITY_NV; transform <= GL_INVERSE_TRANSPOSE_NV; ++transform) {
        glTrackMatrixNV(GL_VERTEX_PROGRAM_NV, 20, one.matrix, transform);
        glLoadMatrixf(kMatrix);  // after it is tracked
        const GLfloat* const m = transform == GL_IDENTITY_NV || transform == GL_TRANSPOSE_NV ? kMatrix : kInverse;
        const bool is_transposed = transform == GL_TRANSPOSE_NV || transform == GL_INVERSE_TRANSPOSE_NV;
        const Floats expected = is_transposed ? transposed(m, k) : row_of(m, k);
        expect_near(drawn_point(), expected, "a tracked matrix");
        Floats got{};
        glGetProgramParameterfvNV(GL_VERTEX_PROGRAM_NV, 20 + k, GL_PROGRAM_PARAMETER_NV, got.data());
        expect_near(got, expected, "glGetProgramParameterfvNV");
      }
    }
    glLoadIdentity();
  }
  GLint value = 0;
  glGetTrackMatrixivNV(GL_VERTEX_PROGRAM_NV, 20, GL_TRACK_MATRIX_NV, &value);
  EXPECT_EQ(value, GL_MATRIX7_NV);
  glGetTrackMatrixivNV(GL_VERTEX_PROGRAM_NV, 20, GL_TRACK_MATRIX_TRANSFORM_NV, &value);
  EXPECT_EQ(value, GL_INVERSE_TRANSPOSE_NV);
  EXPECT_EQ(integer_of(GL_MATRIX_MODE), GL_MATRIX7_NV);
}

TEST(LayerVertexPrograms, ModelviewTimesProjection) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  glMatrixMode(GL_PROJECTION);
  glScalef(2, 1, 1);
  glMatrixMode(GL_MODELVIEW);
  glTranslatef(3, 0, 0);
  glTrackMatrixNV(GL_VERTEX_PROGRAM_NV, 0, GL_MODELVIEW_PROJECTION_NV, GL_IDENTITY_NV);
  ASSERT_EQ(use_vertex_program(1, showing("DP4 o[TEX0].x, c[0], v[TEX0]; MOV o[TEX0].yzw, c[0].xyzw;")), kNoError);
  glMultiTexCoord4f(GL_TEXTURE0, 10, 0, 0, 1);
  EXPECT_EQ(drawn_point(), (Floats{26, 0, 0, 6}));
  // Its values stay when it is no longer tracked.
  glTrackMatrixNV(GL_VERTEX_PROGRAM_NV, 0, GL_NONE, GL_IDENTITY_NV);
  glLoadIdentity();
  EXPECT_EQ(drawn_point(), (Floats{26, 0, 0, 6}));
  glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 1, 0, 0, 0);
  EXPECT_EQ(drawn_point(), (Floats{10, 0, 0, 0}));
  // Relative reads see tracked matrices, too.
  glTrackMatrixNV(GL_VERTEX_PROGRAM_NV, 92, GL_PROJECTION, GL_IDENTITY_NV);
  ASSERT_EQ(use_vertex_program(2, showing("ARL A0.x, v[TEX0].x; MOV o[TEX0], c[A0.x];")), kNoError);
  glMultiTexCoord4f(GL_TEXTURE0, 92, 0, 0, 1);
  EXPECT_EQ(drawn_point(), (Floats{2, 0, 0, 0}));
}

TEST(LayerVertexPrograms, PositionInvariance) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  glMatrixMode(GL_MODELVIEW);
  glTranslatef(-50, 0, 0);
  ASSERT_EQ(use_vertex_program(1, "!!VP1.1 OPTION NV_position_invariant; MOV o[TEX0], c[0];END"), kNoError);
  glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 1, 2, 3, 4);
  EXPECT_EQ(drawn_point(), (Floats{})) << "moved out";
  glLoadIdentity();
  EXPECT_EQ(drawn_point(), (Floats{1, 2, 3, 4}));
}

// Registers of combiners are what the vertex program gives, and (0, 0, 0, 1) where it gives nothing.
TEST(LayerVertexPrograms, WithCombiners) {
  NINEBIT_VERTEX_CONTEXT(context);
  const std::string text = showing("MOV o[COL0], v[COL0].yxzw; MOV o[TEX0], v[TEX1]; MOV o[BFC0], c[0];", "!!VP1.0");
  ASSERT_EQ(use_vertex_program(1, text), kNoError);
  glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 1, 1, 1, 1);
  glVertexAttrib4ubNV(3, 200, 100, 50, 25);
  glSecondaryColor3f(1, 1, 1);
  constexpr GLubyte kTexels[2][4]{{10, 20, 30, 40}, {50, 60, 70, 80}};
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA, 2, 1, 0, GL_RGBA, GL_UNSIGNED_BYTE, kTexels);
  use_nearest(GL_TEXTURE_2D);
  glEnable(GL_TEXTURE_2D);
  const auto shown = [](GLenum reg) {
    show_register(reg);
    clear_picture();
    draw_corners([](GLfloat x, GLfloat y) {
      glMultiTexCoord2f(GL_TEXTURE1, 0.75F, 0);
      glVertexAttrib2fNV(0, x, y);
    });
    return center_pixel();
  };
  EXPECT_EQ(shown(GL_PRIMARY_COLOR_NV), (Pixel{100, 200, 50, 25}));
  EXPECT_EQ(shown(GL_SECONDARY_COLOR_NV), (Pixel{0, 0, 0, 255})) << "o[COL1] begins as (0, 0, 0, 1)";
  EXPECT_EQ(shown(GL_TEXTURE0), (Pixel{50, 60, 70, 80}));
  glDisable(GL_REGISTER_COMBINERS_NV);
  glDisable(GL_VERTEX_PROGRAM_NV);
  EXPECT_EQ(shown(GL_SECONDARY_COLOR_NV)[0], 255) << "fixed functions again";
}

TEST(LayerVertexPrograms, DisplayLists) {
  NINEBIT_VERTEX_CONTEXT(context);
  show_coordinates();
  ASSERT_EQ(use_vertex_program(1, showing("DP4 o[TEX0].x, c[4], v[TEX0]; MOV o[TEX0].y, c[0];")), kNoError);
  ASSERT_EQ(use_vertex_program(2, showing("MOV o[TEX0], v[COL0];")), kNoError);
  const auto draw = [] {
    glBegin(GL_POINTS);
    glVertexAttrib1sNV(8, 5);
    glVertexAttrib2dNV(0, 0, 0);
    glEnd();
  };
  for (const GLenum mode : {GLenum{GL_COMPILE}, GLenum{GL_COMPILE_AND_EXECUTE}}) {
    glBindProgramNV(GL_VERTEX_PROGRAM_NV, 2);
    glTrackMatrixNV(GL_VERTEX_PROGRAM_NV, 4, GL_NONE, GL_IDENTITY_NV);
    glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 0, 0, 0, 0);
    glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 4, 0, 0, 0, 0);
    glColor4f(9, 8, 7, 6);
    glMatrixMode(GL_MODELVIEW);
    glLoadIdentity();
    glClear(GL_COLOR_BUFFER_BIT);
    glNewList(1, mode);
    glBindProgramNV(GL_VERTEX_PROGRAM_NV, 1);
    glTrackMatrixNV(GL_VERTEX_PROGRAM_NV, 4, GL_MODELVIEW, GL_IDENTITY_NV);
    glProgramParameter4fNV(GL_VERTEX_PROGRAM_NV, 0, 1, 42, 3, 4);
    draw();
    glEndList();
    EXPECT_EQ(integer_of(GL_VERTEX_PROGRAM_BINDING_NV), mode == GL_COMPILE ? 2 : 1);
    EXPECT_EQ(float_pixel()[1], mode == GL_COMPILE ? 0.0F : 42.0F);
    if (mode == GL_COMPILE) {
      EXPECT_EQ(drawn_point(), (Floats{9, 8, 7, 6}));
    }
    glScalef(3, 1, 1);
    glCallList(1);
    EXPECT_EQ(float_pixel()[0], 15);
    EXPECT_EQ(integer_of(GL_VERTEX_PROGRAM_BINDING_NV), 1);
  }
  // A state program in a list is executed when the list is called.
  const std::string text = "!!VSP1.0 ADD c[9], c[9], v[0];END";
  glLoadProgramNV(GL_VERTEX_STATE_PROGRAM_NV, 3, static_cast<GLsizei>(text.size()),
                  reinterpret_cast<const GLubyte*>(text.data()));
  const GLfloat one[]{1, 1, 1, 1};
  glNewList(2, GL_COMPILE);
  glExecuteProgramNV(GL_VERTEX_STATE_PROGRAM_NV, 3, one);
  glEndList();
  for (int i = 0; i < 3; ++i) glCallList(2);
  GLdouble sum[4]{};
  glGetProgramParameterdvNV(GL_VERTEX_PROGRAM_NV, 9, GL_PROGRAM_PARAMETER_NV, sum);
  EXPECT_EQ(sum[3], 3);
}

}  // namespace
}  // namespace ninebit::test

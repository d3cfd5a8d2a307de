// Vertex programs whose results are read back as floats.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {

using Floats = std::array<GLfloat, 4>;

// Begins a test with a context that has vertex programs of both extensions.
#define NINEBIT_VERTEX_CONTEXT(name)                                         \
  const ninebit::test::WithExtensions with_programs("NV_vertex_program1_1"); \
  NINEBIT_GL_CONTEXT(name)

// Loads a program and binds it, and enables vertex programs. Returns the error.
inline GLenum use_vertex_program(GLuint name, const std::string& text) {
  glLoadProgramNV(GL_VERTEX_PROGRAM_NV, name, static_cast<GLsizei>(text.size()),
                  reinterpret_cast<const GLubyte*>(text.data()));
  glBindProgramNV(GL_VERTEX_PROGRAM_NV, name);
  glEnable(GL_VERTEX_PROGRAM_NV);
  return glGetError();
}

// From here on pictures are one float pixel, and fragments are the coordinates of texture 0.
inline void show_coordinates() {
  GLuint framebuffer = 0, texture = 0;
  glGenFramebuffers(1, &framebuffer);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glGenTextures(1, &texture);
  glBindTexture(GL_TEXTURE_2D, texture);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA32F, 1, 1, 0, GL_RGBA, GL_FLOAT, nullptr);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, 0);
  glViewport(0, 0, 1, 1);
  const std::string text = "!!ARBfp1.0\nMOV result.color, fragment.texcoord[0];\nEND\n";
  glBindProgramARB(GL_FRAGMENT_PROGRAM_ARB, 4000);  // vertex programs have names of the same numbers
  glProgramStringARB(GL_FRAGMENT_PROGRAM_ARB, GL_PROGRAM_FORMAT_ASCII_ARB, static_cast<GLsizei>(text.size()),
                     text.data());
  glEnable(GL_FRAGMENT_PROGRAM_ARB);
}

inline Floats float_pixel() {
  Floats pixel{};
  glReadPixels(0, 0, 1, 1, GL_RGBA, GL_FLOAT, pixel.data());
  return pixel;
}

// Draws the pixel with vertices that have the current attributes.
inline Floats drawn_point() {
  glClear(GL_COLOR_BUFFER_BIT);
  glBegin(GL_POINTS);
  glVertex2f(0, 0);
  glEnd();
  return float_pixel();
}

// The program whose texture coordinates are those that the instructions write.
inline std::string showing(const std::string& instructions, const std::string& header = "!!VP1.1") {
  return header + " MOV o[HPOS], v[OPOS]; " + instructions + "END";
}

}  // namespace ninebit::test

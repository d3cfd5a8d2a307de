// Small things to draw, and what is read back.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "combiner_tests/gl_layer/gl_context.h"

namespace ninebit::test {

// Red, green, blue, alpha.
using Pixel = std::array<std::uint8_t, 4>;

// The combiners show a constant colour: they are enabled and reset, and the final combiner's D and G are constant 0.
void show_constant(const std::array<GLfloat, 4>& color);
// The same with a register, as colour and as alpha; E_TIMES_F and the sum are not possible.
void show_register(GLenum reg);

// Black and transparent.
void clear_picture();
// The whole picture, with a texture coordinate of (0, 0) to (1, 1) in units 0 to 3. No fog, lighting, or matrices are
// touched.
void draw_square();
// The same with a vertex by `vertex` at each corner, from (-1, -1) to (1, 1).
template <class Vertex>
void draw_corners(const Vertex& vertex) {
  glBegin(GL_QUADS);
  vertex(-1.0F, -1.0F);
  vertex(1.0F, -1.0F);
  vertex(1.0F, 1.0F);
  vertex(-1.0F, 1.0F);
  glEnd();
}
std::vector<Pixel> read_picture();
Pixel center_pixel();
// Draws the square, too.
Pixel drawn_pixel();

// What glGetIntegerv writes; -2: nothing.
GLint integer_of(GLenum name);
// The texture that is bound to the target is not filtered.
void use_nearest(GLenum target);
// The 2D texture that is bound has one texel.
void set_texel(const Pixel& texel, GLint internal = GL_RGBA8, GLenum format = GL_RGBA);

// The first pixels that differ, as text; empty: none does.
std::string differences(const std::vector<Pixel>& got, const std::vector<Pixel>& expected);

// A fragment shader that draws green; 0: the driver refuses it.
GLuint make_green_program();
// The same of the text of a fragment shader; 0: the driver refuses it.
GLuint make_program(const char* text);

}  // namespace ninebit::test

#include "combiner_tests/gl_layer/pictures.h"

namespace ninebit::test {
namespace {

void final_input(GLenum variable, GLenum reg, GLenum usage) {
  glFinalCombinerInputNV(variable, reg, GL_UNSIGNED_IDENTITY_NV, usage);
}

}  // namespace

void show_register(GLenum reg) {
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
  for (const int portion : {GL_RGB, GL_ALPHA}) {
    glCombinerOutputNV(GL_COMBINER0_NV, static_cast<GLenum>(portion), GL_DISCARD_NV, GL_DISCARD_NV, GL_DISCARD_NV,
                       GL_NONE, GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE);
  }
  for (GLenum variable = GL_VARIABLE_A_NV; variable <= GL_VARIABLE_F_NV; ++variable) {
    final_input(variable, variable == GL_VARIABLE_D_NV ? reg : GLenum{GL_ZERO}, GL_RGB);
  }
  final_input(GL_VARIABLE_G_NV, reg, GL_ALPHA);
  glEnable(GL_REGISTER_COMBINERS_NV);
}

void show_constant(const std::array<GLfloat, 4>& color) {
  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, color.data());
  show_register(GL_CONSTANT_COLOR0_NV);
}

void clear_picture() {
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

void draw_square() {
  draw_corners([](float x, float y) {
    for (GLenum unit = 0; unit < 4; ++unit) {
      glMultiTexCoord2f(GL_TEXTURE0 + unit, 0.5F * x + 0.5F, 0.5F * y + 0.5F);
    }
    glVertex2f(x, y);
  });
}

std::vector<Pixel> read_picture() {
  std::vector<Pixel> picture(static_cast<std::size_t>(kPictureSize) * kPictureSize);
  glReadPixels(0, 0, kPictureSize, kPictureSize, GL_RGBA, GL_UNSIGNED_BYTE, picture.data());
  return picture;
}

Pixel center_pixel() {
  Pixel pixel{};
  glReadPixels(kPictureSize / 2, kPictureSize / 2, 1, 1, GL_RGBA, GL_UNSIGNED_BYTE, pixel.data());
  return pixel;
}

Pixel drawn_pixel() {
  draw_square();
  return center_pixel();
}

GLint integer_of(GLenum name) {
  GLint value = -2;
  glGetIntegerv(name, &value);
  return value;
}

void use_nearest(GLenum target) {
  glTexParameteri(target, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTexParameteri(target, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
}

void set_texel(const Pixel& texel, GLint internal, GLenum format) {
  glTexImage2D(GL_TEXTURE_2D, 0, internal, 1, 1, 0, format, GL_UNSIGNED_BYTE, texel.data());
  use_nearest(GL_TEXTURE_2D);
}

std::string differences(const std::vector<Pixel>& got, const std::vector<Pixel>& expected) {
  if (got.size() != expected.size()) return "the pictures have different sizes";
  std::string text;
  int listed = 0;
  for (std::size_t i = 0; i < got.size(); ++i) {
    if (got[i] == expected[i] || ++listed > 12) continue;
    text += "\n(" + std::to_string(i % kPictureSize) + ", " + std::to_string(i / kPictureSize) + "): got";
    for (const std::uint8_t value : got[i]) text += ' ' + std::to_string(value);
    text += ", expected";
    for (const std::uint8_t value : expected[i]) text += ' ' + std::to_string(value);
  }
  return text;
}

GLuint make_program(const char* text) {
  const GLuint shader = glCreateShader(GL_FRAGMENT_SHADER), program = glCreateProgram();
  glShaderSource(shader, 1, &text, nullptr);
  glCompileShader(shader);
  glAttachShader(program, shader);
  glDeleteShader(shader);
  glLinkProgram(program);
  GLint linked = 0;
  glGetProgramiv(program, GL_LINK_STATUS, &linked);
  return linked != 0 ? program : 0;
}

GLuint make_green_program() {
  return make_program("void main() { gl_FragColor = vec4(0.0, 1.0, 0.0, 1.0); }");
}

}  // namespace ninebit::test

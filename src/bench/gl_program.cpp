#ifdef NINEBIT_HAS_EGL
#include "src/bench/gl_program.h"

#include <array>

namespace ninebit::bench {
namespace {

Result<GLuint> compile_shader(const Gl& gl, GLenum kind, const std::string& text) {
  const GLuint shader = gl.CreateShader(kind);
  const char* const start = text.c_str();
  gl.ShaderSource(shader, 1, &start, nullptr);
  gl.CompileShader(shader);
  GLint done = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return shader;
  std::array<char, 1024> log{};
  gl.GetShaderInfoLog(shader, static_cast<GLsizei>(log.size()), nullptr, log.data());
  return Diagnostic{.message = "a shader does not compile: " + std::string(log.data())};
}

}  // namespace

Result<GLuint> link_program(const Gl& gl, const std::string& vertex, const std::string& fragment) {
  const auto first = compile_shader(gl, GL_VERTEX_SHADER, vertex);
  if (!first) return first.error();
  const auto second = compile_shader(gl, GL_FRAGMENT_SHADER, fragment);
  if (!second) return second.error();
  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, *first);
  gl.AttachShader(program, *second);
  gl.LinkProgram(program);
  GLint done = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &done);
  if (done != GL_TRUE) return Diagnostic{.message = "the shaders do not link"};
  return program;
}

}  // namespace ninebit::bench
#endif

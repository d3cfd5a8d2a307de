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

std::string renderer_of(const Gl& gl) {
  const auto text = [&](GLenum name) { return std::string(reinterpret_cast<const char*>(gl.GetString(name))); };
  return text(GL_RENDERER) + ", " + text(GL_VERSION);
}

Result<std::vector<std::uint8_t>> picture_of(const Gl& gl, GLsizei width, GLsizei height) {
  const DriverCode driver_code;
  std::vector<std::uint8_t> bytes(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  gl.PixelStorei(GL_PACK_ALIGNMENT, 1);
  gl.ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, bytes.data());
  if (const GLenum error = gl.GetError(); error != GL_NO_ERROR) {
    return Diagnostic{.message = "GL error " + std::to_string(error)};
  }
  return bytes;
}

}  // namespace ninebit::bench
#endif

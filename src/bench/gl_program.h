// Shared by the rivals: shaders, the driver's name, the picture that was drawn.
#pragma once

#include <GL/glcorearb.h>

#include <cstdint>
#include <string>
#include <vector>

#include "ninebit/numerics/result.h"
#include "src/bench/egl_context.h"

namespace ninebit::bench {

// The OpenGL entry points that the rival uses, under their GL names.

// clang-format off
#define NINEBIT_GL_FUNCTIONS(X) \
  X(ACTIVETEXTURE, ActiveTexture) X(ATTACHSHADER, AttachShader) X(BINDBUFFER, BindBuffer) X(BINDFRAMEBUFFER, BindFramebuffer) \
  X(BINDRENDERBUFFER, BindRenderbuffer) X(BINDTEXTURE, BindTexture) X(BINDVERTEXARRAY, BindVertexArray) \
  X(BUFFERDATA, BufferData) X(CHECKFRAMEBUFFERSTATUS, CheckFramebufferStatus) X(CLEAR, Clear) \
  X(CLEARCOLOR, ClearColor) X(COLORMASK, ColorMask) X(COMPILESHADER, CompileShader) \
  X(CREATEPROGRAM, CreateProgram) X(CREATESHADER, CreateShader) X(CULLFACE, CullFace) X(DEPTHFUNC, DepthFunc) \
  X(DEPTHMASK, DepthMask) X(DISABLE, Disable) X(DRAWARRAYS, DrawArrays) X(DRAWELEMENTS, DrawElements) X(ENABLE, Enable) \
  X(ENABLEVERTEXATTRIBARRAY, EnableVertexAttribArray) X(FINISH, Finish) \
  X(FRAMEBUFFERRENDERBUFFER, FramebufferRenderbuffer) X(FRAMEBUFFERTEXTURE2D, FramebufferTexture2D) \
  X(GENBUFFERS, GenBuffers) X(GENERATEMIPMAP, GenerateMipmap) X(GENFRAMEBUFFERS, GenFramebuffers) X(GENRENDERBUFFERS, GenRenderbuffers) \
  X(GENTEXTURES, GenTextures) X(GENVERTEXARRAYS, GenVertexArrays) X(GETERROR, GetError) \
  X(GETPROGRAMIV, GetProgramiv) X(GETSHADERINFOLOG, GetShaderInfoLog) X(GETSHADERIV, GetShaderiv) \
  X(GETSTRING, GetString) X(GETUNIFORMLOCATION, GetUniformLocation) X(LINKPROGRAM, LinkProgram) \
  X(PIXELSTOREI, PixelStorei) X(READPIXELS, ReadPixels) X(RENDERBUFFERSTORAGE, RenderbufferStorage) \
  X(SHADERSOURCE, ShaderSource) X(STENCILFUNC, StencilFunc) X(STENCILOP, StencilOp) X(TEXIMAGE2D, TexImage2D) \
  X(TEXPARAMETERI, TexParameteri) X(UNIFORM1I, Uniform1i) X(UNIFORM3FV, Uniform3fv) X(UNIFORMMATRIX4FV, UniformMatrix4fv) \
  X(USEPROGRAM, UseProgram) \
  X(VERTEXATTRIBIPOINTER, VertexAttribIPointer) X(VERTEXATTRIBPOINTER, VertexAttribPointer) \
  X(VIEWPORT, Viewport)
// clang-format on

struct Gl {
#define NINEBIT_GL_MEMBER(type, name) PFNGL##type##PROC name;
  NINEBIT_GL_FUNCTIONS(NINEBIT_GL_MEMBER)
#undef NINEBIT_GL_MEMBER

  explicit Gl(const EglContext& context) {
#define NINEBIT_GL_LOAD(type, name) name = reinterpret_cast<PFNGL##type##PROC>(context.function("gl" #name));
    NINEBIT_GL_FUNCTIONS(NINEBIT_GL_LOAD)
#undef NINEBIT_GL_LOAD
  }
};

#undef NINEBIT_GL_FUNCTIONS

// A linked program. Reports what the driver says of a shader that does not compile, and shaders that do not link.
[[nodiscard]] Result<GLuint> link_program(const Gl& gl, const std::string& vertex, const std::string& fragment);

// The driver's renderer and version.
[[nodiscard]] std::string renderer_of(const Gl& gl);

// The bound framebuffer's colours, red, green, blue, alpha, by rows from below.
[[nodiscard]] Result<std::vector<std::uint8_t>> picture_of(const Gl& gl, GLsizei width, GLsizei height);

}  // namespace ninebit::bench

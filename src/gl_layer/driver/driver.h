// The driver's own OpenGL functions, which this library's functions of the same names stand in front of.
#pragma once

// ninebit's enumerants have to stand before the macros of the same names.
#include "ninebit/language/gl_enums.h"

#define GL_GLEXT_PROTOTYPES 1
#include <GL/gl.h>
#include <GL/glext.h>

namespace ninebit::gl_layer {

// clang-format off
// Needed of every driver.
#define NINEBIT_CORE_FUNCTIONS(X) \
  X(Begin) X(BindTexture) X(Bitmap) X(CallList) X(CallLists) X(ColorMask) X(CopyPixels) X(CopyTexImage1D) X(CopyTexImage2D) \
  X(DeleteLists) X(DeleteTextures) X(Disable) X(DisableClientState) X(DrawArrays) X(DrawElements) X(DrawPixels) X(Enable) X(EnableClientState) X(End) X(EndList) X(GenTextures) \
  X(EvalMesh1) X(EvalMesh2) X(Fogf) X(Fogfv) X(Fogi) X(Fogiv) X(GetBooleanv) X(GetDoublev) X(GetError) X(GetFloatv) \
  X(GetIntegerv) X(GetPointerv) X(GetString) X(GetTexEnvfv) X(GetTexEnviv) X(GetTexImage) X(GetTexLevelParameterfv) X(GetTexLevelParameteriv) X(GetTexParameterfv) X(GetTexParameteriv) \
  X(IsEnabled) X(IsList) X(LightModelf) X(LightModelfv) X(LightModeli) X(LightModeliv) X(NewList) X(PixelStorei) X(PixelTransferf) X(PixelTransferi) \
  X(PopAttrib) X(PopClientAttrib) X(PushAttrib) X(PushClientAttrib) X(ReadBuffer) X(ReadPixels) X(Rectd) X(Rectdv) X(Rectf) X(Rectfv) X(Recti) \
  X(Rectiv) X(Rects) X(Rectsv) X(TexEnvf) X(TexEnvfv) X(TexEnvi) X(TexEnviv) X(TexImage1D) X(TexImage2D) \
  X(TexParameterf) X(TexParameterfv) X(TexParameteri) X(TexParameteriv) X(TexSubImage1D) X(TexSubImage2D)
// nullptr where the driver does not have them.
#define NINEBIT_LATER_FUNCTIONS(X) \
  X(ActiveTexture) X(AttachShader) X(BindBuffer) X(BindVertexArray) X(BindFramebuffer) X(BindRenderbuffer) X(BlitFramebuffer) \
  X(CheckFramebufferStatus) X(ClearBufferfv) X(ColorMaski) X(CompileShader) X(CompressedTexImage1D) X(CompressedTexImage2D) \
  X(CompressedTexImage3D) X(CreateProgram) X(CreateShader) X(DeleteFencesNV) X(DeleteFramebuffers) X(DeleteProgram) \
  X(DeleteRenderbuffers) X(DeleteShader) X(DeleteVertexArrays) X(DetachShader) X(Disablei) X(DisableVertexAttribArray) X(DrawArraysInstanced) X(DrawBuffers) \
  X(DrawElementsBaseVertex) X(DrawArraysIndirect) \
  X(DrawElementsIndirect) X(DrawElementsInstanced) X(DrawElementsInstancedBaseVertex) X(MultiDrawArraysIndirect) \
  X(MultiDrawElementsBaseVertex) X(MultiDrawElementsIndirect) X(DrawRangeElements) X(DrawRangeElementsBaseVertex) X(EnableVertexAttribArray) X(FramebufferRenderbuffer) \
  X(FinishFenceNV) X(FlushVertexArrayRangeNV) X(GenFencesNV) X(GetFenceivNV) X(IsFenceNV) X(SetFenceNV) X(TestFenceNV) X(VertexArrayRangeNV) \
  X(FramebufferTexture2D) X(GenerateMipmap) X(GenFramebuffers) X(GenRenderbuffers) \
  X(GetBooleani_v) X(GetHandleARB) \
  X(GetProgramInfoLog) X(GetProgramiv) X(GetShaderInfoLog) X(GetShaderiv) X(GetStringi) X(GetUniformLocation) \
  \
  X(LinkProgram) X(MultiDrawArrays) X(MultiDrawElements) X(RenderbufferStorage) X(ShaderSource) X(TexImage3D) X(TexStorage1D) X(TexStorage2D) \
  X(TexStorage3D) X(TexSubImage3D) X(Uniform1i) X(Uniform2fv) X(Uniform3fv) \
  X(Uniform4fv) X(Uniform4iv) X(UseProgram) X(UseProgramObjectARB) \
  NINEBIT_VERTEX_PROGRAM_FUNCTIONS(X)
// What NV_vertex_program is made of.
#define NINEBIT_VERTEX_PROGRAM_FUNCTIONS(X) \
  X(ArrayElement) X(BindProgramARB) X(Color4f) X(DeleteProgramsARB) X(DisableVertexAttribArrayARB) \
  X(EnableVertexAttribArrayARB) X(FogCoordf) X(GenProgramsARB) X(GetProgramEnvParameterfvARB) X(GetProgramivARB) \
  X(GetVertexAttribPointervARB) X(GetVertexAttribfvARB) X(GetVertexAttribivARB) X(IsProgramARB) X(MatrixMode) \
  X(MultiTexCoord4f) X(Normal3f) X(ProgramEnvParameter4fvARB) X(ProgramStringARB) X(SecondaryColor3f) X(Vertex4f) \
  X(VertexAttrib4fARB) X(VertexAttribPointerARB)
// clang-format on

struct Driver {
#define NINEBIT_POINTER(name) decltype(&::gl##name) name = nullptr;
  NINEBIT_CORE_FUNCTIONS(NINEBIT_POINTER)
  NINEBIT_LATER_FUNCTIONS(NINEBIT_POINTER)
#undef NINEBIT_POINTER
};

// The functions, found at the first call in a process. A function that is missing stays nullptr.
const Driver& find_driver();

// The same without the check for the first call: only after find_driver().
extern Driver found_driver;

// One number of the driver's state, and whether something is enabled there. Only after find_driver().
[[nodiscard]] GLint driver_integer(GLenum name);
[[nodiscard]] bool driver_enables(GLenum cap);

}  // namespace ninebit::gl_layer

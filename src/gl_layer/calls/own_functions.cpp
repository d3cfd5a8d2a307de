// This library's functions by name, for programs that look them up.
#include <algorithm>
#include <atomic>
#include <vector>

#include "src/gl_layer/calls/uniforms.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/extra_extensions.h"
#include "src/gl_layer/driver/lookups.h"
#include "src/gl_layer/driver/symbols.h"

extern "C" {
void* glXCreateContext(void*, void*, void*, int);
void* glXCreateNewContext(void*, void*, int, void*, int);
void* glXCreateContextAttribsARB(void*, void*, void*, int, const int*);
void glXCopyContext(void*, void*, void*, unsigned long);
void glXDestroyContext(void*, void*);
int glXMakeCurrent(void*, unsigned long, void*);
int glXMakeContextCurrent(void*, unsigned long, unsigned long, void*);
void glXSwapBuffers(void*, unsigned long);
void* glXAllocateMemoryNV(GLsizei, GLfloat, GLfloat, GLfloat);
void glXFreeMemoryNV(void*);
ninebit::gl_layer::AnyFunction glXGetProcAddress(const GLubyte*);
ninebit::gl_layer::AnyFunction glXGetProcAddressARB(const GLubyte*);
void* eglCreateContext(void*, void*, void*, const int*);
unsigned eglDestroyContext(void*, void*);
unsigned eglMakeCurrent(void*, void*, void*, void*);
unsigned eglReleaseThread();
unsigned eglSwapBuffers(void*, void*);
ninebit::gl_layer::AnyFunction eglGetProcAddress(const char*);
}

namespace ninebit::gl_layer {
namespace {

struct Entry {
  std::string_view name;
  AnyFunction function;
};

#define NINEBIT_ENTRY(name) Entry{#name, reinterpret_cast<AnyFunction>(&::name)},
#define NINEBIT_ALIAS(alias, name) Entry{#alias, reinterpret_cast<AnyFunction>(&::name)},

// Without their suffix, because libglvnd has a function of every name: mplayer 1.5 asks for those first.
// clang-format off
#define NINEBIT_OWN_FUNCTIONS(X, A) \
  X(eglCreateContext) X(eglDestroyContext) X(eglGetProcAddress) X(eglMakeCurrent) X(eglReleaseThread) \
  X(eglSwapBuffers) X(glActiveShaderProgram) X(glAreProgramsResidentNV) X(glArrayElement) \
  A(glArrayElementEXT, glArrayElement) A(glAttachObjectARB, glAttachShader) X(glAttachShader) X(glBegin) \
  X(glBindAttribLocation) A(glBindAttribLocationARB, glBindAttribLocation) X(glBindFragDataLocation) \
  X(glBindFragDataLocationIndexed) X(glBindProgramARB) X(glBindProgramNV) X(glBindTexture) \
  A(glBindTextureEXT, glBindTexture) X(glBindVertexArray) X(glBitmap) X(glCallList) X(glCallLists) \
  X(glColorSubTableEXT) X(glColorTableEXT) A(glCombinerInput, glCombinerInputNV) X(glCombinerInputNV) \
  A(glCombinerOutput, glCombinerOutputNV) X(glCombinerOutputNV) A(glCombinerParameterf, glCombinerParameterfNV) \
  X(glCombinerParameterfNV) A(glCombinerParameterfv, glCombinerParameterfvNV) X(glCombinerParameterfvNV) \
  A(glCombinerParameteri, glCombinerParameteriNV) X(glCombinerParameteriNV) \
  A(glCombinerParameteriv, glCombinerParameterivNV) X(glCombinerParameterivNV) \
  A(glCombinerStageParameterfv, glCombinerStageParameterfvNV) X(glCombinerStageParameterfvNV) \
  X(glCompressedTexImage1D) A(glCompressedTexImage1DARB, glCompressedTexImage1D) X(glCompressedTexImage2D) \
  A(glCompressedTexImage2DARB, glCompressedTexImage2D) X(glCompressedTexImage3D) \
  A(glCompressedTexImage3DARB, glCompressedTexImage3D) X(glCopyPixels) X(glCopyTexImage1D) \
  A(glCopyTexImage1DEXT, glCopyTexImage1D) X(glCopyTexImage2D) A(glCopyTexImage2DEXT, glCopyTexImage2D) \
  X(glDeleteFencesNV) X(glDeleteLists) X(glDeleteObjectARB) X(glDeleteProgram) X(glDeleteProgramsARB) \
  X(glDeleteProgramsNV) X(glDeleteTextures) A(glDeleteTexturesEXT, glDeleteTextures) X(glDeleteVertexArrays) \
  A(glDetachObjectARB, glDetachShader) X(glDetachShader) X(glDisable) X(glDisableClientState) \
  X(glDisableVertexAttribArray) X(glDisableVertexAttribArrayARB) X(glDrawArrays) A(glDrawArraysEXT, glDrawArrays) \
  X(glDrawArraysIndirect) X(glDrawArraysInstanced) A(glDrawArraysInstancedARB, glDrawArraysInstanced) \
  A(glDrawArraysInstancedEXT, glDrawArraysInstanced) X(glDrawElements) X(glDrawElementsBaseVertex) \
  X(glDrawElementsIndirect) X(glDrawElementsInstanced) A(glDrawElementsInstancedARB, glDrawElementsInstanced) \
  X(glDrawElementsInstancedBaseVertex) A(glDrawElementsInstancedEXT, glDrawElementsInstanced) X(glDrawPixels) \
  X(glDrawRangeElements) X(glDrawRangeElementsBaseVertex) A(glDrawRangeElementsEXT, glDrawRangeElements) X(glEnable) \
  X(glEnableClientState) X(glEnableVertexAttribArray) X(glEnableVertexAttribArrayARB) X(glEnd) X(glEndList) \
  X(glEvalMesh1) X(glEvalMesh2) X(glExecuteProgramNV) A(glFinalCombinerInput, glFinalCombinerInputNV) \
  X(glFinalCombinerInputNV) X(glFinishFenceNV) X(glFlushVertexArrayRangeNV) X(glFogf) X(glFogfv) X(glFogi) X(glFogiv) \
  X(glGenFencesNV) X(glGenProgramsNV) X(glGenerateMipmap) A(glGenerateMipmapEXT, glGenerateMipmap) \
  X(glGetActiveAtomicCounterBufferiv) X(glGetActiveAttrib) A(glGetActiveAttribARB, glGetActiveAttrib) \
  X(glGetActiveSubroutineName) X(glGetActiveSubroutineUniformName) X(glGetActiveSubroutineUniformiv) \
  X(glGetActiveUniform) A(glGetActiveUniformARB, glGetActiveUniform) X(glGetActiveUniformBlockName) \
  X(glGetActiveUniformBlockiv) X(glGetActiveUniformName) X(glGetActiveUniformsiv) \
  A(glGetAttachedObjectsARB, glGetAttachedShaders) X(glGetAttachedShaders) X(glGetAttribLocation) \
  A(glGetAttribLocationARB, glGetAttribLocation) X(glGetBooleanv) X(glGetColorTableEXT) \
  X(glGetColorTableParameterfvEXT) X(glGetColorTableParameterivEXT) \
  A(glGetCombinerInputParameterfv, glGetCombinerInputParameterfvNV) X(glGetCombinerInputParameterfvNV) \
  A(glGetCombinerInputParameteriv, glGetCombinerInputParameterivNV) X(glGetCombinerInputParameterivNV) \
  A(glGetCombinerOutputParameterfv, glGetCombinerOutputParameterfvNV) X(glGetCombinerOutputParameterfvNV) \
  A(glGetCombinerOutputParameteriv, glGetCombinerOutputParameterivNV) X(glGetCombinerOutputParameterivNV) \
  A(glGetCombinerStageParameterfv, glGetCombinerStageParameterfvNV) X(glGetCombinerStageParameterfvNV) X(glGetDoublev) \
  X(glGetError) X(glGetFenceivNV) A(glGetFinalCombinerInputParameterfv, glGetFinalCombinerInputParameterfvNV) \
  X(glGetFinalCombinerInputParameterfvNV) A(glGetFinalCombinerInputParameteriv, glGetFinalCombinerInputParameterivNV) \
  X(glGetFinalCombinerInputParameterivNV) X(glGetFloatv) X(glGetFragDataIndex) X(glGetFragDataLocation) \
  X(glGetHandleARB) X(glGetInfoLogARB) X(glGetIntegerv) X(glGetObjectLabel) X(glGetObjectParameterivARB) \
  X(glGetPointerv) X(glGetProgramBinary) X(glGetProgramInfoLog) X(glGetProgramInterfaceiv) \
  X(glGetProgramParameterdvNV) X(glGetProgramParameterfvNV) X(glGetProgramResourceIndex) \
  X(glGetProgramResourceLocation) X(glGetProgramResourceLocationIndex) X(glGetProgramResourceName) \
  X(glGetProgramResourceiv) X(glGetProgramStageiv) X(glGetProgramStringNV) X(glGetProgramiv) X(glGetProgramivARB) \
  X(glGetProgramivNV) X(glGetString) X(glGetStringi) X(glGetSubroutineIndex) X(glGetSubroutineUniformLocation) \
  X(glGetTexEnvfv) X(glGetTexEnviv) X(glGetTexLevelParameterfv) X(glGetTexLevelParameteriv) X(glGetTexParameterfv) \
  X(glGetTexParameteriv) X(glGetTrackMatrixivNV) X(glGetTransformFeedbackVarying) X(glGetUniformBlockIndex) \
  X(glGetUniformIndices) X(glGetUniformLocation) A(glGetUniformLocationARB, glGetUniformLocation) X(glGetUniformdv) \
  X(glGetUniformfv) A(glGetUniformfvARB, glGetUniformfv) X(glGetUniformiv) A(glGetUniformivARB, glGetUniformiv) \
  X(glGetUniformuiv) X(glGetVertexAttribPointervNV) X(glGetVertexAttribdvNV) X(glGetVertexAttribfvNV) \
  X(glGetVertexAttribivNV) X(glGetnUniformdv) X(glGetnUniformfv) X(glGetnUniformiv) X(glGetnUniformuiv) X(glIsEnabled) \
  X(glIsFenceNV) X(glIsList) X(glIsProgram) X(glIsProgramARB) X(glIsProgramNV) X(glLightModelf) X(glLightModelfv) \
  X(glLightModeli) X(glLightModeliv) X(glLinkProgram) A(glLinkProgramARB, glLinkProgram) X(glLoadProgramNV) \
  X(glMatrixMode) X(glMultiDrawArrays) A(glMultiDrawArraysEXT, glMultiDrawArrays) X(glMultiDrawArraysIndirect) \
  X(glMultiDrawElements) X(glMultiDrawElementsBaseVertex) A(glMultiDrawElementsEXT, glMultiDrawElements) \
  X(glMultiDrawElementsIndirect) X(glNewList) X(glObjectLabel) X(glPixelTransferf) X(glPixelTransferi) X(glPopAttrib) \
  X(glPopClientAttrib) X(glProgramBinary) X(glProgramParameter4dNV) X(glProgramParameter4dvNV) \
  X(glProgramParameter4fNV) X(glProgramParameter4fvNV) X(glProgramParameteri) X(glProgramParameters4dvNV) \
  X(glProgramParameters4fvNV) X(glProgramStringARB) X(glPushAttrib) X(glPushClientAttrib) X(glRectd) X(glRectdv) \
  X(glRectf) X(glRectfv) X(glRecti) X(glRectiv) X(glRects) X(glRectsv) X(glRequestResidentProgramsNV) X(glSetFenceNV) \
  X(glShaderStorageBlockBinding) X(glTestFenceNV) X(glTexEnvf) X(glTexEnvfv) X(glTexEnvi) X(glTexEnviv) \
  X(glTexImage1D) X(glTexImage2D) X(glTexImage3D) A(glTexImage3DEXT, glTexImage3D) X(glTexParameterf) \
  X(glTexParameterfv) X(glTexParameteri) X(glTexParameteriv) X(glTexStorage1D) X(glTexStorage2D) X(glTexStorage3D) \
  X(glTexSubImage1D) A(glTexSubImage1DEXT, glTexSubImage1D) X(glTexSubImage2D) A(glTexSubImage2DEXT, glTexSubImage2D) \
  X(glTexSubImage3D) A(glTexSubImage3DEXT, glTexSubImage3D) X(glTrackMatrixNV) X(glTransformFeedbackVaryings) \
  X(glUniformBlockBinding) X(glUseProgram) X(glUseProgramObjectARB) X(glUseProgramStages) X(glValidateProgram) \
  A(glValidateProgramARB, glValidateProgram) X(glVertexArrayRangeNV) X(glVertexAttrib1dNV) X(glVertexAttrib1dvNV) \
  X(glVertexAttrib1fNV) X(glVertexAttrib1fvNV) X(glVertexAttrib1sNV) X(glVertexAttrib1svNV) X(glVertexAttrib2dNV) \
  X(glVertexAttrib2dvNV) X(glVertexAttrib2fNV) X(glVertexAttrib2fvNV) X(glVertexAttrib2sNV) X(glVertexAttrib2svNV) \
  X(glVertexAttrib3dNV) X(glVertexAttrib3dvNV) X(glVertexAttrib3fNV) X(glVertexAttrib3fvNV) X(glVertexAttrib3sNV) \
  X(glVertexAttrib3svNV) X(glVertexAttrib4dNV) X(glVertexAttrib4dvNV) X(glVertexAttrib4fNV) X(glVertexAttrib4fvNV) \
  X(glVertexAttrib4sNV) X(glVertexAttrib4svNV) X(glVertexAttrib4ubNV) X(glVertexAttrib4ubvNV) \
  X(glVertexAttribPointerNV) X(glVertexAttribs1dvNV) X(glVertexAttribs1fvNV) X(glVertexAttribs1svNV) \
  X(glVertexAttribs2dvNV) X(glVertexAttribs2fvNV) X(glVertexAttribs2svNV) X(glVertexAttribs3dvNV) \
  X(glVertexAttribs3fvNV) X(glVertexAttribs3svNV) X(glVertexAttribs4dvNV) X(glVertexAttribs4fvNV) \
  X(glVertexAttribs4svNV) X(glVertexAttribs4ubvNV) X(glXAllocateMemoryNV) X(glXCopyContext) X(glXCreateContext) \
  X(glXCreateContextAttribsARB) X(glXCreateNewContext) X(glXDestroyContext) X(glXFreeMemoryNV) X(glXGetProcAddress) \
  X(glXGetProcAddressARB) X(glXMakeContextCurrent) X(glXMakeCurrent) A(glXMakeCurrentReadSGI, glXMakeContextCurrent) \
  X(glXSwapBuffers)
// clang-format on

constinit std::atomic<bool> combiners_wanted{false};

constinit std::atomic<bool> unseen_images{false};

// Functions that make images of textures that are not bound, or of something else.
bool makes_unseen_images(std::string_view name) {
  return name.find("TextureImage") != name.npos || name.find("MultiTexImage") != name.npos ||
         name.find("TextureMipmap") != name.npos || name.find("MultiTexMipmap") != name.npos ||
         name.find("BindTexImage") != name.npos || name.find("EGLImageTarget") != name.npos;
}

#define NINEBIT_UNIFORM(form, ...) NINEBIT_ENTRY(glUniform##form) NINEBIT_ENTRY(glProgramUniform##form)
#define NINEBIT_ARB_UNIFORM(form, ...) NINEBIT_ENTRY(glUniform##form##ARB)

// In the order of their names.
const std::vector<Entry>& own_functions() {
  static const std::vector<Entry> functions = [] {
    std::vector<Entry> all{NINEBIT_OWN_FUNCTIONS(NINEBIT_ENTRY, NINEBIT_ALIAS)                        //
                           NINEBIT_FIRST_UNIFORMS(NINEBIT_UNIFORM, NINEBIT_UNIFORM, NINEBIT_UNIFORM)  //
                           NINEBIT_LATER_UNIFORMS(NINEBIT_UNIFORM, NINEBIT_UNIFORM, NINEBIT_UNIFORM)  //
                           NINEBIT_FIRST_UNIFORMS(NINEBIT_ARB_UNIFORM, NINEBIT_ARB_UNIFORM, NINEBIT_ARB_UNIFORM)};
    std::sort(all.begin(), all.end(), [](const Entry& a, const Entry& b) { return a.name < b.name; });
    return all;
  }();
  return functions;
}

}  // namespace

AnyFunction own_function(std::string_view name) {
  const std::vector<Entry>& functions = own_functions();
  const auto found = std::lower_bound(functions.begin(), functions.end(), name,
                                      [](const Entry& entry, std::string_view of) { return entry.name < of; });
  if (found == functions.end() || found->name != name) {
    if (makes_unseen_images(name)) unseen_images.store(true, std::memory_order_relaxed);
    return nullptr;
  }
  note_lookup(name);
  if (belongs_to_unwanted(name)) return nullptr;
  if (name.starts_with("glCombiner")) combiners_wanted.store(true, std::memory_order_relaxed);
  return found->function;
}

bool unseen_image_calls_looked_up() {
  return unseen_images.load(std::memory_order_relaxed);
}

bool combiners_looked_up() {
  return combiners_wanted.load(std::memory_order_relaxed);
}

}  // namespace ninebit::gl_layer

// Commands that change what a shader of the layer depends on: bound and enabled textures, fog, lighting, shaders. They
// go to the driver as they are; texture_images.cpp has those with pixels.
#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/driver.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

namespace {

void use_program(GLuint program) {
  Context* const context = current();
  if (context == nullptr || context->in_begin) return found_driver.UseProgram(program);
  if (context->recording() && !context->list_in_begin()) {
    return record(*context, [program] { glUseProgram(program); });
  }
  found_driver.UseProgram(program);
  if (context->open_list != nullptr && context->open_list->mode == GL_COMPILE) return mark_stale();
  const GLint now = driver_integer(GL_CURRENT_PROGRAM);  // the driver may have refused it
  if (static_cast<GLuint>(now) != program && context->bound) return;
  context->app_program = static_cast<GLuint>(now);
  context->bound = false;
  mark_stale();
}

}  // namespace

GLAPI void GLAPIENTRY glUseProgram(GLuint program) {
  if (find_driver().UseProgram != nullptr) use_program(visible_program(program));
}

GLAPI void GLAPIENTRY glUseProgramObjectARB(GLhandleARB program) {
  glUseProgram(program);
}

#define NINEBIT_INPUT_CALL(name, parameters, arguments) \
  GLAPI void GLAPIENTRY gl##name parameters {           \
    const auto call = find_driver().name;               \
    if (call != nullptr) call arguments;                \
    mark_stale();                                       \
  }

NINEBIT_INPUT_CALL(BindTexture, (GLenum target, GLuint texture), (target, texture))
NINEBIT_INPUT_CALL(DeleteTextures, (GLsizei n, const GLuint* textures), (n, textures))
NINEBIT_INPUT_CALL(TexParameterf, (GLenum target, GLenum pname, GLfloat param), (target, pname, param))
NINEBIT_INPUT_CALL(TexParameteri, (GLenum target, GLenum pname, GLint param), (target, pname, param))
NINEBIT_INPUT_CALL(TexParameterfv, (GLenum target, GLenum pname, const GLfloat* params), (target, pname, params))
NINEBIT_INPUT_CALL(TexParameteriv, (GLenum target, GLenum pname, const GLint* params), (target, pname, params))
NINEBIT_INPUT_CALL(CompressedTexImage1D,
                   (GLenum target, GLint level, GLenum internal, GLsizei width, GLint border, GLsizei size,
                    const GLvoid* data),
                   (target, level, internal, width, border, size, data))
NINEBIT_INPUT_CALL(CompressedTexImage2D,
                   (GLenum target, GLint level, GLenum internal, GLsizei width, GLsizei height, GLint border,
                    GLsizei size, const GLvoid* data),
                   (target, level, internal, width, height, border, size, data))
NINEBIT_INPUT_CALL(CompressedTexImage3D,
                   (GLenum target, GLint level, GLenum internal, GLsizei width, GLsizei height, GLsizei depth,
                    GLint border, GLsizei size, const GLvoid* data),
                   (target, level, internal, width, height, depth, border, size, data))
NINEBIT_INPUT_CALL(TexStorage1D, (GLenum target, GLsizei levels, GLenum internal, GLsizei width),
                   (target, levels, internal, width))
NINEBIT_INPUT_CALL(TexStorage2D, (GLenum target, GLsizei levels, GLenum internal, GLsizei width, GLsizei height),
                   (target, levels, internal, width, height))
NINEBIT_INPUT_CALL(TexStorage3D,
                   (GLenum target, GLsizei levels, GLenum internal, GLsizei width, GLsizei height, GLsizei depth),
                   (target, levels, internal, width, height, depth))
NINEBIT_INPUT_CALL(GenerateMipmap, (GLenum target), (target))
NINEBIT_INPUT_CALL(CopyTexImage1D,
                   (GLenum target, GLint level, GLenum internal, GLint x, GLint y, GLsizei width, GLint border),
                   (target, level, internal, x, y, width, border))
NINEBIT_INPUT_CALL(CopyTexImage2D,
                   (GLenum target, GLint level, GLenum internal, GLint x, GLint y, GLsizei width, GLsizei height,
                    GLint border),
                   (target, level, internal, x, y, width, height, border))
NINEBIT_INPUT_CALL(Fogf, (GLenum pname, GLfloat param), (pname, param))
NINEBIT_INPUT_CALL(Fogi, (GLenum pname, GLint param), (pname, param))
NINEBIT_INPUT_CALL(Fogfv, (GLenum pname, const GLfloat* params), (pname, params))
NINEBIT_INPUT_CALL(Fogiv, (GLenum pname, const GLint* params), (pname, params))
NINEBIT_INPUT_CALL(LightModelf, (GLenum pname, GLfloat param), (pname, param))
NINEBIT_INPUT_CALL(LightModeli, (GLenum pname, GLint param), (pname, param))
NINEBIT_INPUT_CALL(LightModelfv, (GLenum pname, const GLfloat* params), (pname, params))
NINEBIT_INPUT_CALL(LightModeliv, (GLenum pname, const GLint* params), (pname, params))

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

namespace {

// Parameters that shaders read as they are at each draw, or not at all.
bool changes_no_shader(GLenum pname) {
  switch (pname) {
    case GL_FOG_COLOR:
    case GL_FOG_DENSITY:
    case GL_FOG_START:
    case GL_FOG_END:
    case GL_LIGHT_MODEL_AMBIENT:
    case GL_TEXTURE_BORDER_COLOR:
    case GL_TEXTURE_LOD_BIAS:
    case GL_TEXTURE_MAG_FILTER:
    case GL_TEXTURE_MAX_ANISOTROPY_EXT:
    case GL_TEXTURE_MAX_LOD:
    case GL_TEXTURE_MIN_LOD:
    case GL_TEXTURE_WRAP_R:
    case GL_TEXTURE_WRAP_S:
    case GL_TEXTURE_WRAP_T:
      return true;
    default:
      return false;
  }
}

}  // namespace

#define NINEBIT_CALL_THAT_MARKS(name, parameters, arguments, mark) \
  GLAPI void GLAPIENTRY gl##name parameters {                      \
    const auto call = find_driver().name;                          \
    if (call != nullptr) call arguments;                           \
    mark;                                                          \
  }
#define NINEBIT_INPUT_CALL(name, parameters, arguments) \
  NINEBIT_CALL_THAT_MARKS(name, parameters, arguments, mark_stale())
#define NINEBIT_IMAGE_CALL(name, parameters, arguments) \
  NINEBIT_CALL_THAT_MARKS(name, parameters, arguments, mark_images_changed())
#define NINEBIT_PARAMETER_CALL(name, parameters, arguments) \
  NINEBIT_CALL_THAT_MARKS(name, parameters, arguments, if (!changes_no_shader(pname)) mark_stale())

NINEBIT_INPUT_CALL(BindTexture, (GLenum target, GLuint texture), (target, texture))
NINEBIT_IMAGE_CALL(DeleteTextures, (GLsizei n, const GLuint* textures), (n, textures))
NINEBIT_PARAMETER_CALL(TexParameterf, (GLenum target, GLenum pname, GLfloat param), (target, pname, param))
NINEBIT_PARAMETER_CALL(TexParameteri, (GLenum target, GLenum pname, GLint param), (target, pname, param))
NINEBIT_PARAMETER_CALL(TexParameterfv, (GLenum target, GLenum pname, const GLfloat* params), (target, pname, params))
NINEBIT_PARAMETER_CALL(TexParameteriv, (GLenum target, GLenum pname, const GLint* params), (target, pname, params))
NINEBIT_IMAGE_CALL(CompressedTexImage1D,
                   (GLenum target, GLint level, GLenum internal, GLsizei width, GLint border, GLsizei size,
                    const GLvoid* data),
                   (target, level, internal, width, border, size, data))
NINEBIT_IMAGE_CALL(CompressedTexImage2D,
                   (GLenum target, GLint level, GLenum internal, GLsizei width, GLsizei height, GLint border,
                    GLsizei size, const GLvoid* data),
                   (target, level, internal, width, height, border, size, data))
NINEBIT_IMAGE_CALL(CompressedTexImage3D,
                   (GLenum target, GLint level, GLenum internal, GLsizei width, GLsizei height, GLsizei depth,
                    GLint border, GLsizei size, const GLvoid* data),
                   (target, level, internal, width, height, depth, border, size, data))
NINEBIT_IMAGE_CALL(TexStorage1D, (GLenum target, GLsizei levels, GLenum internal, GLsizei width),
                   (target, levels, internal, width))
NINEBIT_IMAGE_CALL(TexStorage2D, (GLenum target, GLsizei levels, GLenum internal, GLsizei width, GLsizei height),
                   (target, levels, internal, width, height))
NINEBIT_IMAGE_CALL(TexStorage3D,
                   (GLenum target, GLsizei levels, GLenum internal, GLsizei width, GLsizei height, GLsizei depth),
                   (target, levels, internal, width, height, depth))
NINEBIT_IMAGE_CALL(GenerateMipmap, (GLenum target), (target))
NINEBIT_IMAGE_CALL(CopyTexImage1D,
                   (GLenum target, GLint level, GLenum internal, GLint x, GLint y, GLsizei width, GLint border),
                   (target, level, internal, x, y, width, border))
NINEBIT_IMAGE_CALL(CopyTexImage2D,
                   (GLenum target, GLint level, GLenum internal, GLint x, GLint y, GLsizei width, GLsizei height,
                    GLint border),
                   (target, level, internal, x, y, width, height, border))
NINEBIT_PARAMETER_CALL(Fogf, (GLenum pname, GLfloat param), (pname, param))
NINEBIT_PARAMETER_CALL(Fogi, (GLenum pname, GLint param), (pname, param))
NINEBIT_PARAMETER_CALL(Fogfv, (GLenum pname, const GLfloat* params), (pname, params))
NINEBIT_PARAMETER_CALL(Fogiv, (GLenum pname, const GLint* params), (pname, params))
NINEBIT_PARAMETER_CALL(LightModelf, (GLenum pname, GLfloat param), (pname, param))
NINEBIT_PARAMETER_CALL(LightModeli, (GLenum pname, GLint param), (pname, param))
NINEBIT_PARAMETER_CALL(LightModelfv, (GLenum pname, const GLfloat* params), (pname, params))
NINEBIT_PARAMETER_CALL(LightModeliv, (GLenum pname, const GLint* params), (pname, params))

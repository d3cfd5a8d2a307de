// Commands that change what a shader of the layer depends on: bound and enabled textures, fog, lighting, shaders. They
// go to the driver as they are; texture_images.cpp has those with pixels.
#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/calls/paletted_textures.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/driver.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

namespace {

void use_program(GLuint program) {
  Context* const context = current();
  if (context == nullptr || context->in_begin) return found_driver.UseProgram(program);
  if (goes_into_steps(*context)) {
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

namespace {

// The names of GL_SGIX_shadow.
constexpr GLenum kCompareSgix = 0x819A, kOperatorSgix = 0x819B;
constexpr GLint kLequalSgix = 0x819C, kGequalSgix = 0x819D;

bool is_sgix_shadow(GLenum pname) {
  const Context* const context = current();
  return (pname == kCompareSgix || pname == kOperatorSgix) && context != nullptr &&
         context->features.extras.have(Extra::shadow);
}

// ARB_shadow's parameter and value for one of GL_SGIX_shadow. A value that it does not have is none of ARB's either.
void set_sgix_shadow(GLenum target, GLenum pname, GLint value) {
  const bool is_mode = pname == kCompareSgix;
  const GLint mode = value != 0 ? GL_COMPARE_R_TO_TEXTURE : GL_NONE;
  const GLint function = value == kLequalSgix ? GL_LEQUAL : value == kGequalSgix ? GL_GEQUAL : GL_INVALID_ENUM;
  found_driver.TexParameteri(target, is_mode ? GL_TEXTURE_COMPARE_MODE : GL_TEXTURE_COMPARE_FUNC,
                             is_mode ? mode : function);
  mark_stale();
}

template <class T>
void get_sgix_shadow(GLenum target, GLenum pname, T* params) {
  const bool is_mode = pname == kCompareSgix;
  GLint value = -1;
  found_driver.GetTexParameteriv(target, is_mode ? GL_TEXTURE_COMPARE_MODE : GL_TEXTURE_COMPARE_FUNC, &value);
  if (value == -1) return;  // the driver has raised an error
  if (is_mode) {
    *params = static_cast<T>(value != GL_NONE ? 1 : 0);
  } else {
    *params = static_cast<T>(value == GL_GEQUAL ? kGequalSgix : kLequalSgix);
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
#define NINEBIT_FOG_CALL(name, parameters, arguments) \
  NINEBIT_CALL_THAT_MARKS(name, parameters, arguments, if (!changes_no_shader(pname)) mark_fog_stale())
#define NINEBIT_PARAMETER_CALL(name, parameters, arguments) \
  NINEBIT_CALL_THAT_MARKS(name, parameters, arguments, if (!changes_no_shader(pname)) mark_stale())

NINEBIT_INPUT_CALL(BindTexture, (GLenum target, GLuint texture), (target, texture))
NINEBIT_CALL_THAT_MARKS(DeleteTextures, (GLsizei n, const GLuint* textures), (n, textures),
                        (forget_paletted_textures(n, textures), mark_images_changed()))
#define NINEBIT_TEXTURE_PARAMETER(name, type, value)                        \
  GLAPI void GLAPIENTRY gl##name(GLenum target, GLenum pname, type param) { \
    if (find_driver().name != nullptr && is_sgix_shadow(pname)) {           \
      return set_sgix_shadow(target, pname, static_cast<GLint>(value));     \
    }                                                                       \
    found_driver.name(target, pname, param);                                \
    if (!changes_no_shader(pname)) mark_stale();                            \
  }

NINEBIT_TEXTURE_PARAMETER(TexParameterf, GLfloat, param)
NINEBIT_TEXTURE_PARAMETER(TexParameteri, GLint, param)
NINEBIT_TEXTURE_PARAMETER(TexParameterfv, const GLfloat*, *param)
NINEBIT_TEXTURE_PARAMETER(TexParameteriv, const GLint*, *param)

GLAPI void GLAPIENTRY glGetTexParameterfv(GLenum target, GLenum pname, GLfloat* params) {
  if (is_sgix_shadow(pname)) return get_sgix_shadow(target, pname, params);
  find_driver().GetTexParameterfv(target, pname, params);
}

GLAPI void GLAPIENTRY glGetTexParameteriv(GLenum target, GLenum pname, GLint* params) {
  if (is_sgix_shadow(pname)) return get_sgix_shadow(target, pname, params);
  find_driver().GetTexParameteriv(target, pname, params);
}

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
NINEBIT_FOG_CALL(Fogf, (GLenum pname, GLfloat param), (pname, param))
NINEBIT_FOG_CALL(Fogi, (GLenum pname, GLint param), (pname, param))
NINEBIT_FOG_CALL(Fogfv, (GLenum pname, const GLfloat* params), (pname, params))
NINEBIT_FOG_CALL(Fogiv, (GLenum pname, const GLint* params), (pname, params))
NINEBIT_PARAMETER_CALL(LightModelf, (GLenum pname, GLfloat param), (pname, param))
NINEBIT_PARAMETER_CALL(LightModeli, (GLenum pname, GLint param), (pname, param))
NINEBIT_PARAMETER_CALL(LightModelfv, (GLenum pname, const GLfloat* params), (pname, params))
NINEBIT_PARAMETER_CALL(LightModeliv, (GLenum pname, const GLint* params), (pname, params))

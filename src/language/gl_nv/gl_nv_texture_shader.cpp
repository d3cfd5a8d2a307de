// NV_texture_shader's state, which programs set and query as a texture environment.
#include <algorithm>
#include <array>
#include <optional>

#include "ninebit/language/gl_nv.h"
#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/gl_nv/gl_nv_access.h"

namespace ninebit::gl {
namespace {

using Values = std::array<GLfloat, 4>;

std::optional<GLenum> enumerant_of(GLfloat value) {
  if (!(value >= 0.0F && value <= 65535.0F)) return std::nullopt;
  return static_cast<GLenum>(value);
}

std::optional<TextureOperation> operation_of(GLenum value) {
  if (value == GL_NONE) return TextureOperation::none;
  for (const TextureOperationInfo& info : texture_operations()) {
    if (info.gl_value != 0 && info.gl_value == value) return info.operation;
  }
  return std::nullopt;
}

// Sets a parameter of a stage; false: the value is not one of its enumerants. `values` has as many as the parameter.
bool set_parameter(TextureStage& stage, GLenum pname, const Values& values) {
  const auto word = enumerant_of(values[0]);
  switch (pname) {
    case GL_SHADER_OPERATION_NV: {
      const auto operation = word ? operation_of(*word) : std::nullopt;
      if (operation) stage.operation = *operation;
      return operation.has_value();
    }
    case GL_PREVIOUS_TEXTURE_INPUT_NV:
      if (!word || *word < GL_TEXTURE0 || *word >= GL_TEXTURE0 + kTextureStages) return false;
      stage.previous = static_cast<int>(*word - GL_TEXTURE0);
      return true;
    case GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV:
      if (word != GL_UNSIGNED_IDENTITY_NV && word != GL_EXPAND_NORMAL_NV) return false;
      stage.mapping = word == GL_EXPAND_NORMAL_NV ? DotMapping::minus1_to_1_d3d : DotMapping::zero_to_one;
      return true;
    case GL_CULL_MODES_NV:
      for (std::size_t k = 0; k < 4; ++k) {
        const auto mode = enumerant_of(values[k]);
        if (mode != GL_LESS && mode != GL_GEQUAL) return false;
        stage.cull[k] = mode == GL_LESS ? CullMode::kills_not_negative : CullMode::kills_negative;
      }
      return true;
    case GL_OFFSET_TEXTURE_MATRIX_NV:
      stage.matrix = values;
      return true;
    case GL_CONST_EYE_NV:
      std::copy_n(values.begin(), 3, stage.eye.begin());
      return true;
    case GL_OFFSET_TEXTURE_SCALE_NV:
      stage.scale = values[0];
      return true;
    default:
      stage.bias = values[0];
      return true;
  }
}

// The error that OpenGL raises for a stage of a state.
GlError error_of(const TextureShaderState& state, const HardwareProfile& profile, int place) {
  for (const TextureShaderDiagnostic& fault : validate(state, profile)) {
    if (fault.stage == place && fault.gl_error != GlError::no_error) return fault.gl_error;
  }
  return GlError::no_error;
}

// This thread's context, if it has this target and parameter.
Context* context_of(GLenum target, GLenum pname) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return nullptr;
  if (target == GL_TEXTURE_SHADER_NV && context->profile().texture_shaders && detail::texture_shader_values(pname) != 0)
    return context;
  context->raise(GlError::invalid_enum);
  return nullptr;
}

void set(Context& context, GLenum pname, const Values& values) {
  TextureShaderState wanted = context.texture_shader();
  wanted.enabled = true;  // or nothing is checked
  const int place = context.active_texture();
  if (!set_parameter(wanted.stage[static_cast<std::size_t>(place)], pname, values)) {
    return context.raise(GlError::invalid_enum);
  }
  const GlError error = error_of(wanted, context.profile(), place);
  if (error != GlError::no_error) return context.raise(error);
  wanted.enabled = context.texture_shader().enabled;
  context.texture_shader() = wanted;
}

template <class T>
void set_scalar(GLenum target, GLenum pname, T param) {
  Context* const context = context_of(target, pname);
  if (context == nullptr) return;
  if (detail::texture_shader_values(pname) != 1) return context->raise(GlError::invalid_enum);
  set(*context, pname, {static_cast<GLfloat>(param)});
}

template <class T>
void set_vector(GLenum target, GLenum pname, const T* params) {
  Context* const context = context_of(target, pname);
  if (context == nullptr) return;
  if (params == nullptr) return context->raise(GlError::invalid_value);
  Values values{};
  for (std::size_t k = 0; k < detail::texture_shader_values(pname); ++k) values[k] = static_cast<GLfloat>(params[k]);
  set(*context, pname, values);
}

Values values_of(const TextureStage& stage, GLenum pname) {
  Values values{};
  switch (pname) {
    case GL_SHADER_OPERATION_NV:
      return {static_cast<GLfloat>(info_of(stage.operation).gl_value)};
    case GL_PREVIOUS_TEXTURE_INPUT_NV:
      return {static_cast<GLfloat>(GL_TEXTURE0 + static_cast<GLenum>(stage.previous))};
    case GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV:
      return {static_cast<GLfloat>(stage.mapping == DotMapping::zero_to_one ? GL_UNSIGNED_IDENTITY_NV
                                                                            : GL_EXPAND_NORMAL_NV)};
    case GL_CULL_MODES_NV:
      for (std::size_t k = 0; k < 4; ++k) {
        values[k] = static_cast<GLfloat>(stage.cull[k] == CullMode::kills_negative ? GL_GEQUAL : GL_LESS);
      }
      return values;
    case GL_OFFSET_TEXTURE_MATRIX_NV:
      return stage.matrix;
    case GL_CONST_EYE_NV:
      std::copy(stage.eye.begin(), stage.eye.end(), values.begin());
      return values;
    case GL_OFFSET_TEXTURE_SCALE_NV:
      return {stage.scale};
    default:
      return {stage.bias};
  }
}

template <class T>
void get(GLenum target, GLenum pname, T* params) {
  Context* const context = context_of(target, pname);
  if (context == nullptr) return;
  if (params == nullptr) return context->raise(GlError::invalid_value);
  const TextureStage& stage = context->texture_shader().stage[static_cast<std::size_t>(context->active_texture())];
  const Values values = values_of(stage, pname);
  for (std::size_t k = 0; k < detail::texture_shader_values(pname); ++k) params[k] = static_cast<T>(values[k]);
}

}  // namespace

void glActiveTexture(GLenum texture) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  const auto units = static_cast<GLenum>(std::min(context->profile().texture_units.value, kTextureStages));
  if (texture < GL_TEXTURE0 || texture >= GL_TEXTURE0 + units) return context->raise(GlError::invalid_enum);
  context->set_active_texture(static_cast<int>(texture - GL_TEXTURE0));
}

void glActiveTextureARB(GLenum texture) {
  glActiveTexture(texture);
}

void glTexEnvi(GLenum target, GLenum pname, GLint param) {
  set_scalar(target, pname, param);
}

void glTexEnvf(GLenum target, GLenum pname, GLfloat param) {
  set_scalar(target, pname, param);
}

void glTexEnviv(GLenum target, GLenum pname, const GLint* params) {
  set_vector(target, pname, params);
}

void glTexEnvfv(GLenum target, GLenum pname, const GLfloat* params) {
  set_vector(target, pname, params);
}

void glGetTexEnviv(GLenum target, GLenum pname, GLint* params) {
  get(target, pname, params);
}

void glGetTexEnvfv(GLenum target, GLenum pname, GLfloat* params) {
  get(target, pname, params);
}

}  // namespace ninebit::gl

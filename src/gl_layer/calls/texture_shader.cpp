// NV_texture_shader's state, which programs set and query as a texture environment. The operations that depend on no
// other unit work; others are refused as an implementation without them refuses them.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

namespace {

std::optional<ShaderOperation> operation_of(GLenum value) {
  switch (value) {
    case GL_NONE:
      return ShaderOperation::none;
    case GL_TEXTURE_1D:
      return ShaderOperation::texture_1d;
    case GL_TEXTURE_2D:
      return ShaderOperation::texture_2d;
    case GL_TEXTURE_RECTANGLE:
      return ShaderOperation::texture_rectangle;
    case GL_TEXTURE_3D:
      return ShaderOperation::texture_3d;
    case GL_TEXTURE_CUBE_MAP:
      return ShaderOperation::texture_cube_map;
    case GL_PASS_THROUGH_NV:
      return ShaderOperation::pass_through;
    case GL_CULL_FRAGMENT_NV:
      return ShaderOperation::cull_fragment;
    default:
      return std::nullopt;
  }
}

GLenum enum_of(ShaderOperation operation) {
  constexpr GLenum values[]{GL_NONE,       GL_TEXTURE_1D,       GL_TEXTURE_2D,      GL_TEXTURE_RECTANGLE,
                            GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP, GL_PASS_THROUGH_NV, GL_CULL_FRAGMENT_NV};
  return values[static_cast<std::size_t>(operation)];
}

const char* name_of_other_operation(GLenum value) {
  switch (value) {
    case GL_OFFSET_TEXTURE_2D_NV:
      return "GL_OFFSET_TEXTURE_2D_NV";
    case GL_OFFSET_TEXTURE_2D_SCALE_NV:
      return "GL_OFFSET_TEXTURE_2D_SCALE_NV";
    case GL_OFFSET_TEXTURE_RECTANGLE_NV:
      return "GL_OFFSET_TEXTURE_RECTANGLE_NV";
    case GL_OFFSET_TEXTURE_RECTANGLE_SCALE_NV:
      return "GL_OFFSET_TEXTURE_RECTANGLE_SCALE_NV";
    case GL_DEPENDENT_AR_TEXTURE_2D_NV:
      return "GL_DEPENDENT_AR_TEXTURE_2D_NV";
    case GL_DEPENDENT_GB_TEXTURE_2D_NV:
      return "GL_DEPENDENT_GB_TEXTURE_2D_NV";
    case GL_DOT_PRODUCT_NV:
      return "GL_DOT_PRODUCT_NV";
    case GL_DOT_PRODUCT_DEPTH_REPLACE_NV:
      return "GL_DOT_PRODUCT_DEPTH_REPLACE_NV";
    case GL_DOT_PRODUCT_TEXTURE_2D_NV:
      return "GL_DOT_PRODUCT_TEXTURE_2D_NV";
    case GL_DOT_PRODUCT_TEXTURE_RECTANGLE_NV:
      return "GL_DOT_PRODUCT_TEXTURE_RECTANGLE_NV";
    case GL_DOT_PRODUCT_TEXTURE_CUBE_MAP_NV:
      return "GL_DOT_PRODUCT_TEXTURE_CUBE_MAP_NV";
    case GL_DOT_PRODUCT_DIFFUSE_CUBE_MAP_NV:
      return "GL_DOT_PRODUCT_DIFFUSE_CUBE_MAP_NV";
    case GL_DOT_PRODUCT_REFLECT_CUBE_MAP_NV:
      return "GL_DOT_PRODUCT_REFLECT_CUBE_MAP_NV";
    case GL_DOT_PRODUCT_CONST_EYE_REFLECT_CUBE_MAP_NV:
      return "GL_DOT_PRODUCT_CONST_EYE_REFLECT_CUBE_MAP_NV";
    default:
      return nullptr;
  }
}

// The state of the active texture unit; nullptr for units that combiners cannot read.
UnitShader* active_unit(Context& context) {
  GLint active = GL_TEXTURE0;
  found_driver.GetIntegerv(GL_ACTIVE_TEXTURE, &active);
  const auto unit = static_cast<std::size_t>(active - GL_TEXTURE0);
  return unit < kLayerUnits ? &context.texture_shaders.units[unit] : nullptr;
}

void set_operation(Context& context, UnitShader& unit, GLenum value) {
  const auto operation = operation_of(value);
  if (operation) {
    unit.operation = *operation;
    return;
  }
  if (const char* const name = name_of_other_operation(value)) {
    log_once(std::string(name) +
             ": this operation of texture shaders is unsupported; the program gets GL_INVALID_ENUM");
  }
  context.raise(GL_INVALID_ENUM);
}

bool is_vector(GLenum pname) {
  return pname == GL_CULL_MODES_NV || pname == GL_OFFSET_TEXTURE_MATRIX_NV || pname == GL_CONST_EYE_NV;
}

void set_cull_modes(Context& context, UnitShader& unit, const GLfloat* values) {
  const auto is_mode = [](GLfloat v) { return v == GLfloat{GL_LESS} || v == GLfloat{GL_GEQUAL}; };
  if (!std::all_of(values, values + 4, is_mode)) return context.raise(GL_INVALID_ENUM);
  for (std::size_t c = 0; c < 4; ++c) unit.cull_if_less[c] = values[c] == GLfloat{GL_LESS};
}

// `values` has as many as the parameter.
void set_parameter(Context& context, UnitShader& unit, GLenum pname, const GLfloat* values) {
  const auto word = static_cast<GLenum>(std::clamp(values[0], 0.0F, 65535.0F));
  switch (pname) {
    case GL_SHADER_OPERATION_NV:
      return set_operation(context, unit, word);
    case GL_CULL_MODES_NV:
      return set_cull_modes(context, unit, values);
    case GL_OFFSET_TEXTURE_MATRIX_NV:
      std::copy_n(values, 4, unit.offset_matrix.begin());
      return;
    case GL_CONST_EYE_NV:
      std::copy_n(values, 3, unit.const_eye.begin());
      return;
    case GL_OFFSET_TEXTURE_SCALE_NV:
      unit.offset_scale = values[0];
      return;
    case GL_OFFSET_TEXTURE_BIAS_NV:
      unit.offset_bias = values[0];
      return;
    case GL_PREVIOUS_TEXTURE_INPUT_NV:
      if (word < GL_TEXTURE0 || word >= GL_TEXTURE0 + kLayerUnits) return context.raise(GL_INVALID_ENUM);
      unit.previous_texture = word;
      return;
    case GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV:
      if (word != GL_UNSIGNED_IDENTITY_NV && word != GL_EXPAND_NORMAL_NV) return context.raise(GL_INVALID_ENUM);
      unit.dot_mapping = word;
      return;
    default:
      return context.raise(GL_INVALID_ENUM);
  }
}

std::size_t number_of(GLenum pname) {
  if (pname == GL_CONST_EYE_NV) return 3;
  return is_vector(pname) ? 4 : 1;
}

using Values = std::array<GLfloat, 4>;

// glTexEnv with the target GL_TEXTURE_SHADER_NV. `values` is empty for a null pointer.
struct Setting {
  GLenum pname;
  bool scalar;
  std::optional<Values> values;
};

void set(const Setting& setting) {
  Context* const context = current();
  if (context == nullptr) return;
  context->touched = true;
  if (!context->outside_begin()) return;
  if (context->open_list != nullptr) {
    if (context->open_list->in_begin) return context->raise(GL_INVALID_OPERATION);
    return record(*context, [setting] { set(setting); });
  }
  if (setting.scalar && is_vector(setting.pname)) return context->raise(GL_INVALID_ENUM);
  if (!setting.values) return context->raise(GL_INVALID_VALUE);
  UnitShader* const unit = active_unit(*context);
  if (unit == nullptr) return context->raise(GL_INVALID_OPERATION);
  set_parameter(*context, *unit, setting.pname, setting.values->data());
  context->inputs_stale = true;
}

// Whether a command is the layer's, and not the driver's.
bool is_ours(GLenum target) {
  const Context* const context = current();
  return target == GL_TEXTURE_SHADER_NV && context != nullptr && context->combiners.profile().per_stage_constants;
}

template <class T>
void set_scalar(GLenum pname, T param) {
  set({pname, true, Values{static_cast<GLfloat>(param)}});
}

template <class T>
void set_vector(GLenum pname, const T* params) {
  if (params == nullptr) return set({pname, false, std::nullopt});
  Values values{};
  for (std::size_t i = 0; i < number_of(pname); ++i) values[i] = static_cast<GLfloat>(params[i]);
  set({pname, false, values});
}

// The values of a parameter; empty: there is none of that name.
std::optional<Values> values_of(const UnitShader& unit, GLenum pname) {
  Values values{};
  switch (pname) {
    case GL_SHADER_OPERATION_NV:
      return Values{static_cast<GLfloat>(enum_of(unit.operation))};
    case GL_CULL_MODES_NV:
      for (std::size_t c = 0; c < 4; ++c) values[c] = unit.cull_if_less[c] ? GLfloat{GL_LESS} : GLfloat{GL_GEQUAL};
      return values;
    case GL_OFFSET_TEXTURE_MATRIX_NV:
      return unit.offset_matrix;
    case GL_CONST_EYE_NV:
      std::copy(unit.const_eye.begin(), unit.const_eye.end(), values.begin());
      return values;
    case GL_OFFSET_TEXTURE_SCALE_NV:
      return Values{unit.offset_scale};
    case GL_OFFSET_TEXTURE_BIAS_NV:
      return Values{unit.offset_bias};
    case GL_PREVIOUS_TEXTURE_INPUT_NV:
      return Values{static_cast<GLfloat>(unit.previous_texture)};
    case GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV:
      return Values{static_cast<GLfloat>(unit.dot_mapping)};
    case GL_SHADER_CONSISTENT_NV:
      return Values{1.0F};  // none of the operations depends on another unit
    default:
      return std::nullopt;
  }
}

template <class T>
void get(GLenum pname, T* params) {
  Context& context = *current();
  if (!context.outside_begin()) return;
  const UnitShader* const unit = active_unit(context);
  if (unit == nullptr) return context.raise(GL_INVALID_OPERATION);
  const auto values = values_of(*unit, pname);
  if (!values) return context.raise(GL_INVALID_ENUM);
  if (params == nullptr) return context.raise(GL_INVALID_VALUE);
  for (std::size_t i = 0; i < number_of(pname); ++i) params[i] = static_cast<T>((*values)[i]);
}

}  // namespace

GLAPI void GLAPIENTRY glTexEnvf(GLenum target, GLenum pname, GLfloat param) {
  if (!is_ours(target)) return find_driver().TexEnvf(target, pname, param);
  set_scalar(pname, param);
}

GLAPI void GLAPIENTRY glTexEnvi(GLenum target, GLenum pname, GLint param) {
  if (!is_ours(target)) return find_driver().TexEnvi(target, pname, param);
  set_scalar(pname, param);
}

GLAPI void GLAPIENTRY glTexEnvfv(GLenum target, GLenum pname, const GLfloat* params) {
  if (!is_ours(target)) return find_driver().TexEnvfv(target, pname, params);
  set_vector(pname, params);
}

GLAPI void GLAPIENTRY glTexEnviv(GLenum target, GLenum pname, const GLint* params) {
  if (!is_ours(target)) return find_driver().TexEnviv(target, pname, params);
  set_vector(pname, params);
}

GLAPI void GLAPIENTRY glGetTexEnvfv(GLenum target, GLenum pname, GLfloat* params) {
  if (!is_ours(target)) return find_driver().GetTexEnvfv(target, pname, params);
  get(pname, params);
}

GLAPI void GLAPIENTRY glGetTexEnviv(GLenum target, GLenum pname, GLint* params) {
  if (!is_ours(target)) return find_driver().GetTexEnviv(target, pname, params);
  get(pname, params);
}

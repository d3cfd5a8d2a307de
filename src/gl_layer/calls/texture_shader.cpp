// NV_texture_shader's state, which programs set and query as a texture environment.
#include <algorithm>
#include <optional>

#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/draw/draw_state.h"
#include "src/gl_layer/driver/driver.h"
#include "src/language/gl_nv/gl_nv_access.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names
namespace front = ninebit::gl;

namespace {

// Whether a command is the layer's, and not the driver's.
bool is_ours(GLenum target) {
  const Context* const context = current();
  return target == GL_TEXTURE_SHADER_NV && context != nullptr && context->combiners.profile().texture_shaders;
}

// The context's active unit becomes the driver's; false, with an error: a unit that combiners cannot read.
bool find_active_unit(Context& context) {
  const GLint unit = driver_integer(GL_ACTIVE_TEXTURE) - GL_TEXTURE0;
  if (unit < 0 || unit >= context.combiners.profile().texture_units) {
    context.raise(GL_INVALID_OPERATION);
    return false;
  }
  context.combiners.set_active_texture(unit);
  return true;
}

// glTexEnv with the target GL_TEXTURE_SHADER_NV. `values` is empty for a null pointer.
struct Setting {
  GLenum pname;
  bool is_scalar;
  std::optional<std::array<GLfloat, 4>> values;
};

void set(const Setting& setting) {
  Context* const context = current();
  if (context == nullptr) return;
  context->touched = true;
  if (context->open_list != nullptr) {
    if (context->list_in_begin()) return record_begin_error(*context);
    return record(*context, [setting] { set(setting); });
  }
  if (!context->outside_begin() || !find_active_unit(*context)) return;
  const bool is_set = context->run([&] {
    if (setting.is_scalar) return front::glTexEnvf(GL_TEXTURE_SHADER_NV, setting.pname, setting.values->front());
    front::glTexEnvfv(GL_TEXTURE_SHADER_NV, setting.pname, setting.values ? setting.values->data() : nullptr);
  });
  if (!is_set) return;
  const bool is_number = setting.pname == GL_OFFSET_TEXTURE_MATRIX_NV || setting.pname == GL_CONST_EYE_NV ||
                         setting.pname == GL_OFFSET_TEXTURE_SCALE_NV || setting.pname == GL_OFFSET_TEXTURE_BIAS_NV;
  if (is_number) {
    context->constants_stale = true;
  } else {
    context->inputs_stale = context->program_stale = true;
  }
}

template <class T>
void set_vector(GLenum pname, const T* params) {
  if (params == nullptr) return set({pname, false, std::nullopt});
  const std::size_t number = std::max(front::detail::texture_shader_values(pname), std::size_t{1});
  std::array<GLfloat, 4> values{};
  for (std::size_t i = 0; i < number; ++i) values[i] = static_cast<GLfloat>(params[i]);
  set({pname, false, values});
}

template <class T>
void get(GLenum pname, T* params) {
  Context& context = *current();
  if (!context.outside_begin() || !find_active_unit(context)) return;
  if (pname == GL_SHADER_CONSISTENT_NV && params != nullptr) {
    *params = static_cast<T>(is_consistent(context, context.combiners.active_texture()) ? 1 : 0);
    return;
  }
  context.run([=] {
    if constexpr (std::is_same_v<T, GLint>) {
      front::glGetTexEnviv(GL_TEXTURE_SHADER_NV, pname, params);
    } else {
      front::glGetTexEnvfv(GL_TEXTURE_SHADER_NV, pname, params);
    }
  });
}

// The environment mode GL_NONE, which NV_texture_shader adds; other modes end it.
void set_no_environment(bool is_none) {
  Context* const context = current();
  if (context->open_list != nullptr) {
    if (context->list_in_begin()) return record_begin_error(*context);
    return record(*context, [is_none] { set_no_environment(is_none); });
  }
  if (!context->outside_begin()) return;
  const auto unit = static_cast<std::size_t>(driver_integer(GL_ACTIVE_TEXTURE) - GL_TEXTURE0);
  if (unit < kLayerUnits) context->no_environment[unit] = is_none;
  context->inputs_stale = true;
}

// A command for the driver's environments, which texture shaders without combiners read. Returns whether the layer
// executes it instead of the driver.
bool takes_environment(GLenum target, GLenum pname, GLfloat first) {
  Context* const context = current();
  if (context == nullptr || !context->combiners.profile().texture_shaders) return false;
  // Combiners take the environments' place.
  if (!context->combiners.register_combiners_enabled() || context->open_list != nullptr) mark_stale();
  if (target != GL_TEXTURE_ENV || pname != GL_TEXTURE_ENV_MODE) return false;
  const bool is_none = first == 0.0F;
  if (is_none && driver_integer(GL_ACTIVE_TEXTURE) >= GL_TEXTURE0 + static_cast<GLint>(kLayerUnits)) return false;
  context->touched = context->touched || is_none;
  if (context->touched) set_no_environment(is_none);
  return is_none;
}

// The query of a mode that is GL_NONE.
template <class T>
bool answers_environment(GLenum target, GLenum pname, T* params) {
  Context* const context = current();
  if (context == nullptr || target != GL_TEXTURE_ENV || pname != GL_TEXTURE_ENV_MODE || params == nullptr) return false;
  const auto unit = static_cast<std::size_t>(driver_integer(GL_ACTIVE_TEXTURE) - GL_TEXTURE0);
  if (context->in_begin || unit >= kLayerUnits || !context->no_environment[unit]) return false;
  *params = T{0};
  return true;
}

}  // namespace

GLAPI void GLAPIENTRY glTexEnvf(GLenum target, GLenum pname, GLfloat param) {
  if (!is_ours(target)) {
    if (!takes_environment(target, pname, param)) find_driver().TexEnvf(target, pname, param);
    return;
  }
  set({pname, true, std::array{param, 0.0F, 0.0F, 0.0F}});
}

GLAPI void GLAPIENTRY glTexEnvi(GLenum target, GLenum pname, GLint param) {
  if (!is_ours(target)) {
    if (!takes_environment(target, pname, static_cast<GLfloat>(param))) find_driver().TexEnvi(target, pname, param);
    return;
  }
  set({pname, true, std::array{static_cast<GLfloat>(param), 0.0F, 0.0F, 0.0F}});
}

GLAPI void GLAPIENTRY glTexEnvfv(GLenum target, GLenum pname, const GLfloat* params) {
  if (!is_ours(target)) {
    if (!takes_environment(target, pname, params != nullptr ? params[0] : 1.0F))
      find_driver().TexEnvfv(target, pname, params);
    return;
  }
  set_vector(pname, params);
}

GLAPI void GLAPIENTRY glTexEnviv(GLenum target, GLenum pname, const GLint* params) {
  if (!is_ours(target)) {
    if (!takes_environment(target, pname, params != nullptr ? static_cast<GLfloat>(params[0]) : 1.0F))
      find_driver().TexEnviv(target, pname, params);
    return;
  }
  set_vector(pname, params);
}

GLAPI void GLAPIENTRY glGetTexEnvfv(GLenum target, GLenum pname, GLfloat* params) {
  if (!is_ours(target)) {
    if (!answers_environment(target, pname, params)) find_driver().GetTexEnvfv(target, pname, params);
    return;
  }
  get(pname, params);
}

GLAPI void GLAPIENTRY glGetTexEnviv(GLenum target, GLenum pname, GLint* params) {
  if (!is_ours(target)) {
    if (!answers_environment(target, pname, params)) find_driver().GetTexEnviv(target, pname, params);
    return;
  }
  get(pname, params);
}

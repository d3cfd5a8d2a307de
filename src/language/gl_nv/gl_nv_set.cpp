#include <vector>

#include "src/language/gl_nv/gl_nv_access.h"

namespace ninebit::gl {
namespace {

using detail::constant_of;
using detail::existing_stage;

// Raises the first error that validate.h found in a command; false if the command is legal.
bool refused(Context& context, const std::vector<StateDiagnostic>& faults) {
  if (faults.empty()) return false;
  context.raise(faults.front().gl_error);
  return true;
}

void set_number(Context& context, GLint number) {
  if (number < 1 || number > context.profile().general_combiners) return context.raise(GlError::invalid_value);
  context.state().num_general_combiners = number;
}

// GL rounds a float to the nearest integer where it needs one. NaN fails both comparisons.
void set_number(Context& context, GLfloat number) {
  const auto most = static_cast<GLfloat>(context.profile().general_combiners.value);
  if (!(number >= 0.5F && number < most + 0.5F)) return context.raise(GlError::invalid_value);
  context.state().num_general_combiners = static_cast<int>(number + 0.5F);
}

template <class T>
void set_scalar(Context& context, GLenum pname, T param) {
  if (pname == GL_NUM_GENERAL_COMBINERS_NV) {
    set_number(context, param);
  } else if (pname == GL_COLOR_SUM_CLAMP_NV) {
    context.state().color_sum_clamp = param != T{0};
  } else {
    context.raise(GlError::invalid_enum);
  }
}

float color_component(GLfloat value) {
  return detail::clamped_color(value);
}

// OpenGL 1.2, table 2.6.
float color_component(GLint value) {
  return detail::clamped_color(static_cast<float>((2.0 * value + 1.0) / 4294967295.0));
}

template <class T>
void set_color(ColorF& color, const T* params) {
  for (std::size_t i = 0; i < color.size(); ++i) color[i] = color_component(params[i]);
}

template <class T>
void set_vector(GLenum pname, const T* params) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  ColorF* const color = constant_of(context->state(), pname);
  if (color == nullptr && pname != GL_NUM_GENERAL_COMBINERS_NV && pname != GL_COLOR_SUM_CLAMP_NV) {
    return context->raise(GlError::invalid_enum);
  }
  if (params == nullptr) return context->raise(GlError::invalid_value);
  if (color != nullptr) {
    set_color(*color, params);
    context->constants_set()[kFinalConstants][pname == GL_CONSTANT_COLOR0_NV ? 0 : 1] = true;
    return;
  }
  set_scalar(*context, pname, *params);
}

}  // namespace

void glCombinerParameteriNV(GLenum pname, GLint param) {
  if (Context* const context = CurrentContext::get()) set_scalar(*context, pname, param);
}

void glCombinerParameterfNV(GLenum pname, GLfloat param) {
  if (Context* const context = CurrentContext::get()) set_scalar(*context, pname, param);
}

void glCombinerParameterivNV(GLenum pname, const GLint* params) {
  set_vector(pname, params);
}

void glCombinerParameterfvNV(GLenum pname, const GLfloat* params) {
  set_vector(pname, params);
}

void glCombinerInputNV(GLenum stage, GLenum portion, GLenum variable, GLenum input, GLenum mapping,
                       GLenum componentUsage) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  const auto s = to_stage(stage);
  const auto p = to_portion(portion);
  const auto v = to_variable(variable);
  const auto reg = to_register(input);
  const auto map = to_input_mapping(mapping);
  const auto usage = to_component_usage(componentUsage);
  if (!s || !p || !v || !reg || !map || !usage) return context->raise(GlError::invalid_enum);
  const CombinerInput wanted{*reg, *map, *usage};
  if (refused(*context, validate_input(*s, *p, *v, wanted, context->profile()))) return;
  detail::portion_of(context->state(), *s, *p).*detail::kGeneralInputs[static_cast<std::size_t>(*v)] = wanted;
}

void glCombinerOutputNV(GLenum stage, GLenum portion, GLenum abOutput, GLenum cdOutput, GLenum sumOutput, GLenum scale,
                        GLenum bias, GLboolean abDotProduct, GLboolean cdDotProduct, GLboolean muxSum) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  const auto s = to_stage(stage);
  const auto p = to_portion(portion);
  const auto ab = to_register(abOutput);
  const auto cd = to_register(cdOutput);
  const auto sum = to_register(sumOutput);
  const auto by = to_scale(scale);
  const auto plus = to_bias(bias);
  if (!s || !p || !ab || !cd || !sum || !by || !plus) return context->raise(GlError::invalid_enum);
  const PortionOutput wanted{.ab = *ab,
                             .cd = *cd,
                             .sum = *sum,
                             .scale = *by,
                             .bias = *plus,
                             .ab_dot_product = abDotProduct != GL_FALSE,
                             .cd_dot_product = cdDotProduct != GL_FALSE,
                             .mux_sum = muxSum != GL_FALSE};
  if (refused(*context, validate_output(*s, *p, wanted, context->profile()))) return;
  detail::portion_of(context->state(), *s, *p).out = wanted;
}

void glFinalCombinerInputNV(GLenum variable, GLenum input, GLenum mapping, GLenum componentUsage) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  const auto v = to_variable(variable);
  const auto reg = to_register(input);
  const auto map = to_input_mapping(mapping);
  const auto usage = to_component_usage(componentUsage);
  if (!v || !reg || !map || !usage) return context->raise(GlError::invalid_enum);
  const CombinerInput wanted{*reg, *map, *usage};
  if (refused(*context, validate_final_input(*v, wanted, context->profile()))) return;
  context->state().final_combiner.*detail::kFinalInputs[static_cast<std::size_t>(*v)] = wanted;
}

void glCombinerStageParameterfvNV(GLenum stage, GLenum pname, const GLfloat* params) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  const auto s = existing_stage(*context, stage);
  if (!s || !context->profile().per_stage_constants) return context->raise(GlError::invalid_enum);
  ColorF* const color = constant_of(detail::stage_of(context->state(), *s), pname);
  if (color == nullptr) return context->raise(GlError::invalid_enum);
  if (params == nullptr) return context->raise(GlError::invalid_value);
  set_color(*color, params);
  context->constants_set()[static_cast<std::size_t>(*s)][pname == GL_CONSTANT_COLOR0_NV ? 0 : 1] = true;
}

}  // namespace ninebit::gl

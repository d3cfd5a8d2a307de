#include <cmath>

#include "src/language/gl_nv/gl_nv_access.h"

namespace ninebit::gl {
namespace {

using detail::constant_of;
using detail::existing_stage;

// A parameter of an input; empty if pname names none.
std::optional<GLenum> parameter_of(const CombinerInput& input, GLenum pname) {
  switch (pname) {
    case GL_COMBINER_INPUT_NV:
      return to_enum(input.reg);
    case GL_COMBINER_MAPPING_NV:
      return to_enum(input.mapping);
    case GL_COMBINER_COMPONENT_USAGE_NV:
      return to_enum(input.usage);
    default:
      return std::nullopt;
  }
}

// A parameter of an output; empty if pname names none.
std::optional<GLenum> parameter_of(const PortionOutput& out, GLenum pname) {
  const auto boolean = [](bool value) -> GLenum { return value ? GL_TRUE : GL_FALSE; };
  switch (pname) {
    case GL_COMBINER_AB_OUTPUT_NV:
      return to_enum(out.ab);
    case GL_COMBINER_CD_OUTPUT_NV:
      return to_enum(out.cd);
    case GL_COMBINER_SUM_OUTPUT_NV:
      return to_enum(out.sum);
    case GL_COMBINER_SCALE_NV:
      return to_enum(out.scale);
    case GL_COMBINER_BIAS_NV:
      return to_enum(out.bias);
    case GL_COMBINER_AB_DOT_PRODUCT_NV:
      return boolean(out.ab_dot_product);
    case GL_COMBINER_CD_DOT_PRODUCT_NV:
      return boolean(out.cd_dot_product);
    case GL_COMBINER_MUX_SUM_NV:
      return boolean(out.mux_sum);
    default:
      return std::nullopt;
  }
}

// Writes the value; raises GL_INVALID_ENUM if it is empty.
template <class T>
void answer(Context& context, const std::optional<GLenum>& value, T* params) {
  if (!value) return context.raise(GlError::invalid_enum);
  if (params == nullptr) return context.raise(GlError::invalid_value);
  *params = static_cast<T>(*value);
}

template <class T>
void get_general_input(GLenum stage, GLenum portion, GLenum variable, GLenum pname, T* params) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  const auto s = existing_stage(*context, stage);
  const auto p = to_portion(portion);
  const auto v = to_variable(variable);
  if (!s || !p || !v || *v > Variable::d) return context->raise(GlError::invalid_enum);
  const Portion& of = detail::portion_of(context->state(), *s, *p);
  answer(*context, parameter_of(of.*detail::kGeneralInputs[static_cast<std::size_t>(*v)], pname), params);
}

template <class T>
void get_output(GLenum stage, GLenum portion, GLenum pname, T* params) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  const auto s = existing_stage(*context, stage);
  const auto p = to_portion(portion);
  if (!s || !p) return context->raise(GlError::invalid_enum);
  answer(*context, parameter_of(detail::portion_of(context->state(), *s, *p).out, pname), params);
}

template <class T>
void get_final_input(GLenum variable, GLenum pname, T* params) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  const auto v = to_variable(variable);
  if (!v) return context->raise(GlError::invalid_enum);
  const FinalCombiner& of = context->state().final_combiner;
  answer(*context, parameter_of(of.*detail::kFinalInputs[static_cast<std::size_t>(*v)], pname), params);
}

// A scalar of the context; empty if pname names none.
std::optional<GLenum> scalar_of(const Context& context, GLenum pname) {
  switch (pname) {
    case GL_NUM_GENERAL_COMBINERS_NV:
      return static_cast<GLenum>(context.state().num_general_combiners);
    case GL_MAX_GENERAL_COMBINERS_NV:
      return static_cast<GLenum>(context.profile().general_combiners.value);
    case GL_COLOR_SUM_CLAMP_NV:
      return context.state().color_sum_clamp ? GL_TRUE : GL_FALSE;
    case GL_REGISTER_COMBINERS_NV:
      return context.register_combiners_enabled() ? GL_TRUE : GL_FALSE;
    case GL_PER_STAGE_CONSTANTS_NV:
      if (!context.profile().per_stage_constants) return std::nullopt;
      return context.state().per_stage_constants ? GL_TRUE : GL_FALSE;
    default:
      return std::nullopt;
  }
}

void convert(float component, GLfloat& out) {
  out = component;
}

// The inverse of OpenGL 1.2, table 2.6, rounded to nearest, halves up: 0.0 becomes -0.5 and rounds to 0.
void convert(float component, GLint& out) {
  out = static_cast<GLint>(std::floor((4294967295.0 * detail::clamped_color(component) - 1.0) / 2.0 + 0.5));
}

template <class T>
void get(GLenum pname, T* params) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  const ColorF* const color = constant_of(context->state(), pname);
  if (color == nullptr) return answer(*context, scalar_of(*context, pname), params);
  if (params == nullptr) return context->raise(GlError::invalid_value);
  for (std::size_t i = 0; i < color->size(); ++i) convert((*color)[i], params[i]);
}

}  // namespace

void glGetIntegerv(GLenum pname, GLint* params) {
  get(pname, params);
}

void glGetFloatv(GLenum pname, GLfloat* params) {
  get(pname, params);
}

void glGetCombinerInputParameterivNV(GLenum stage, GLenum portion, GLenum variable, GLenum pname, GLint* params) {
  get_general_input(stage, portion, variable, pname, params);
}

void glGetCombinerInputParameterfvNV(GLenum stage, GLenum portion, GLenum variable, GLenum pname, GLfloat* params) {
  get_general_input(stage, portion, variable, pname, params);
}

void glGetFinalCombinerInputParameterivNV(GLenum variable, GLenum pname, GLint* params) {
  get_final_input(variable, pname, params);
}

void glGetFinalCombinerInputParameterfvNV(GLenum variable, GLenum pname, GLfloat* params) {
  get_final_input(variable, pname, params);
}

void glGetCombinerOutputParameterivNV(GLenum stage, GLenum portion, GLenum pname, GLint* params) {
  get_output(stage, portion, pname, params);
}

void glGetCombinerOutputParameterfvNV(GLenum stage, GLenum portion, GLenum pname, GLfloat* params) {
  get_output(stage, portion, pname, params);
}

void glGetCombinerStageParameterfvNV(GLenum stage, GLenum pname, GLfloat* params) {
  Context* const context = CurrentContext::get();
  if (context == nullptr) return;
  const auto s = existing_stage(*context, stage);
  if (!s || !context->profile().per_stage_constants) return context->raise(GlError::invalid_enum);
  const ColorF* const color = constant_of(detail::stage_of(context->state(), *s), pname);
  if (color == nullptr) return context->raise(GlError::invalid_enum);
  if (params == nullptr) return context->raise(GlError::invalid_value);
  for (std::size_t i = 0; i < color->size(); ++i) params[i] = (*color)[i];
}

}  // namespace ninebit::gl

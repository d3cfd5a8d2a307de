#include <cmath>
#include <vector>

#include "ninebit/language/gl_nv.h"
#include "src/language/gl_nv/gl_nv_access.h"

namespace ninebit::gl {
namespace {

thread_local Context* current_context = nullptr;

void set_enabled(GLenum cap, bool enabled) {
  Context* const context = current_context;
  if (context == nullptr) return;
  if (cap == GL_REGISTER_COMBINERS_NV) {
    context->enable_register_combiners(enabled);
  } else if (cap == GL_PER_STAGE_CONSTANTS_NV && context->profile().per_stage_constants) {
    context->state().per_stage_constants = enabled;
  } else if (cap == GL_TEXTURE_SHADER_NV && context->profile().texture_shaders) {
    context->texture_shader().enabled = enabled;
  } else {
    context->raise(GlError::invalid_enum);
  }
}

}  // namespace

void Context::raise(GlError error) {
  if (error_ == GlError::no_error) error_ = error;
}

GlError Context::take_error() {
  const GlError error = error_;
  error_ = GlError::no_error;
  return error;
}

CurrentContext::CurrentContext(Context& context) : former_(current_context) {
  current_context = &context;
}

CurrentContext::~CurrentContext() {
  current_context = former_;
}

Context* CurrentContext::get() {
  return current_context;
}

void glEnable(GLenum cap) {
  set_enabled(cap, true);
}

void glDisable(GLenum cap) {
  set_enabled(cap, false);
}

GLboolean glIsEnabled(GLenum cap) {
  Context* const context = current_context;
  if (context == nullptr) return GL_FALSE;
  if (cap == GL_REGISTER_COMBINERS_NV) return context->register_combiners_enabled() ? GL_TRUE : GL_FALSE;
  if (cap == GL_PER_STAGE_CONSTANTS_NV && context->profile().per_stage_constants) {
    return context->state().per_stage_constants ? GL_TRUE : GL_FALSE;
  }
  if (cap == GL_TEXTURE_SHADER_NV && context->profile().texture_shaders) {
    return context->texture_shader().enabled ? GL_TRUE : GL_FALSE;
  }
  context->raise(GlError::invalid_enum);
  return GL_FALSE;
}

GLenum glGetError() {
  if (current_context == nullptr) return GL_INVALID_OPERATION;
  return static_cast<GLenum>(current_context->take_error());
}

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

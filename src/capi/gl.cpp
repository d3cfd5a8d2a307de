// GL's calls on a state.
#include "src/capi/handles.h"

namespace {

using ninebit::GlError;
namespace gl = ninebit::gl;

// Runs `body` with the state's context current and returns the GL error that it raised. Setters allocate only for
// diagnostics; if that fails, the result is GL_OUT_OF_MEMORY.
template <class Body>
unsigned on(ninebit_state* state, const Body& body) noexcept {
  constexpr unsigned kOutOfMemory = 0x0505;  // GL_OUT_OF_MEMORY
  if (state == nullptr) return static_cast<unsigned>(GlError::invalid_operation);
  try {
    const gl::CurrentContext current(state->context);
    body();
    return static_cast<unsigned>(state->context.take_error());
  } catch (...) {
    return kOutOfMemory;
  }
}

gl::GLboolean boolean(int value) {
  return value != 0 ? gl::GL_TRUE : gl::GL_FALSE;
}

}  // namespace

unsigned ninebit_gl_combiner_parameteri(ninebit_state* state, unsigned pname, int param) {
  return on(state, [&] { gl::glCombinerParameteriNV(pname, param); });
}

unsigned ninebit_gl_combiner_parameterfv(ninebit_state* state, unsigned pname, const float* params) {
  return on(state, [&] { gl::glCombinerParameterfvNV(pname, params); });
}

unsigned ninebit_gl_combiner_input(ninebit_state* state, unsigned stage, unsigned portion, unsigned variable,
                                   unsigned input, unsigned mapping, unsigned component_usage) {
  return on(state, [&] { gl::glCombinerInputNV(stage, portion, variable, input, mapping, component_usage); });
}

unsigned ninebit_gl_combiner_output(ninebit_state* state, unsigned stage, unsigned portion, unsigned ab_output,
                                    unsigned cd_output, unsigned sum_output, unsigned scale, unsigned bias,
                                    int ab_dot_product, int cd_dot_product, int mux_sum) {
  return on(state, [&] {
    gl::glCombinerOutputNV(stage, portion, ab_output, cd_output, sum_output, scale, bias, boolean(ab_dot_product),
                           boolean(cd_dot_product), boolean(mux_sum));
  });
}

unsigned ninebit_gl_final_combiner_input(ninebit_state* state, unsigned variable, unsigned input, unsigned mapping,
                                         unsigned component_usage) {
  return on(state, [&] { gl::glFinalCombinerInputNV(variable, input, mapping, component_usage); });
}

unsigned ninebit_gl_combiner_stage_parameterfv(ninebit_state* state, unsigned stage, unsigned pname,
                                               const float* params) {
  return on(state, [&] { gl::glCombinerStageParameterfvNV(stage, pname, params); });
}

unsigned ninebit_gl_enable(ninebit_state* state, unsigned capability, int enabled) {
  return on(state, [&] { enabled != 0 ? gl::glEnable(capability) : gl::glDisable(capability); });
}

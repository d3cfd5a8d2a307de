// The thirteen entry points of NV_register_combiners and NV_register_combiners2. ninebit's own front end (gl_nv.h)
// executes them.
#include <algorithm>
#include <array>

#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/driver.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names
namespace front = ninebit::gl;

namespace {

// A command that changes the combiners' state, and can go into a display list. What it captures must be values.
template <class Command>
void set(const Command& command) {
  Context* const context = current();
  if (context == nullptr) return;
  context->touched = true;
  if (context->open_list != nullptr) {
    if (context->list_in_begin()) return record_begin_error(*context);
    return record(*context, [command] { set(command); });
  }
  if (!context->outside_begin()) return;
  context->run(command);
  context->program_stale = context->constants_stale = true;
}

// The same for a command that changes a constant colour.
template <class Command>
void set_constant(const Command& command) {
  Context* const context = current();
  if (context == nullptr) return;
  if (context->in_begin || context->open_list != nullptr) return set(command);
  context->touched = context->constants_stale = true;
  context->run(command);
}

template <class Command>
void get(const Command& command) {
  Context* const context = current();
  if (context != nullptr && context->outside_begin()) context->run(command);
}

// The values behind a pointer of glCombinerParameter: four of a colour, one of a number, none of an unknown name. A
// null pointer stays one.
template <class T>
class Copied {
 public:
  Copied(GLenum pname, const T* params) : null_(params == nullptr) {
    const bool is_number = pname == GL_NUM_GENERAL_COMBINERS_NV || pname == GL_COLOR_SUM_CLAMP_NV;
    if (!null_) std::copy_n(params, is_color(pname) ? 4 : is_number ? 1 : 0, values_.begin());
  }
  [[nodiscard]] const T* get() const { return null_ ? nullptr : values_.data(); }
  static bool is_color(GLenum pname) { return pname == GL_CONSTANT_COLOR0_NV || pname == GL_CONSTANT_COLOR1_NV; }

 private:
  bool null_;
  std::array<T, 4> values_{};
};

template <class T, class Command>
void set_parameters(GLenum pname, const T* params, Command command) {
  const Copied<T> copied(pname, params);
  const auto call = [pname, copied, command] { command(pname, copied.get()); };
  if (Copied<T>::is_color(pname)) return set_constant(call);
  set(call);
}

}  // namespace

GLAPI void GLAPIENTRY glCombinerParameterfvNV(GLenum pname, const GLfloat* params) {
  set_parameters(pname, params, [](GLenum p, const GLfloat* v) { front::glCombinerParameterfvNV(p, v); });
}

GLAPI void GLAPIENTRY glCombinerParameterivNV(GLenum pname, const GLint* params) {
  set_parameters(pname, params, [](GLenum p, const GLint* v) { front::glCombinerParameterivNV(p, v); });
}

GLAPI void GLAPIENTRY glCombinerParameterfNV(GLenum pname, GLfloat param) {
  set([=] { front::glCombinerParameterfNV(pname, param); });
}

GLAPI void GLAPIENTRY glCombinerParameteriNV(GLenum pname, GLint param) {
  set([=] { front::glCombinerParameteriNV(pname, param); });
}

GLAPI void GLAPIENTRY glCombinerInputNV(GLenum stage, GLenum portion, GLenum variable, GLenum input, GLenum mapping,
                                        GLenum componentUsage) {
  set([=] { front::glCombinerInputNV(stage, portion, variable, input, mapping, componentUsage); });
}

GLAPI void GLAPIENTRY glCombinerOutputNV(GLenum stage, GLenum portion, GLenum abOutput, GLenum cdOutput,
                                         GLenum sumOutput, GLenum scale, GLenum bias, GLboolean abDotProduct,
                                         GLboolean cdDotProduct, GLboolean muxSum) {
  set([=] {
    front::glCombinerOutputNV(stage, portion, abOutput, cdOutput, sumOutput, scale, bias, abDotProduct, cdDotProduct,
                              muxSum);
  });
}

GLAPI void GLAPIENTRY glFinalCombinerInputNV(GLenum variable, GLenum input, GLenum mapping, GLenum componentUsage) {
  set([=] { front::glFinalCombinerInputNV(variable, input, mapping, componentUsage); });
}

GLAPI void GLAPIENTRY glCombinerStageParameterfvNV(GLenum stage, GLenum pname, const GLfloat* params) {
  // An unknown stage is refused without a look behind the pointer: OGRE 1.12 passes the end of its array there.
  const Context* const context = current();
  const GLfloat none[4]{};
  const bool known =
      context != nullptr &&
      stage - GL_COMBINER0_NV < static_cast<GLuint>(context->combiners.profile().general_combiners.value);
  const Copied<GLfloat> copied(pname, known ? params : none);
  set_constant([=] { front::glCombinerStageParameterfvNV(stage, pname, copied.get()); });
}

GLAPI void GLAPIENTRY glGetCombinerInputParameterfvNV(GLenum stage, GLenum portion, GLenum variable, GLenum pname,
                                                      GLfloat* params) {
  get([=] { front::glGetCombinerInputParameterfvNV(stage, portion, variable, pname, params); });
}

GLAPI void GLAPIENTRY glGetCombinerInputParameterivNV(GLenum stage, GLenum portion, GLenum variable, GLenum pname,
                                                      GLint* params) {
  get([=] { front::glGetCombinerInputParameterivNV(stage, portion, variable, pname, params); });
}

GLAPI void GLAPIENTRY glGetCombinerOutputParameterfvNV(GLenum stage, GLenum portion, GLenum pname, GLfloat* params) {
  get([=] { front::glGetCombinerOutputParameterfvNV(stage, portion, pname, params); });
}

GLAPI void GLAPIENTRY glGetCombinerOutputParameterivNV(GLenum stage, GLenum portion, GLenum pname, GLint* params) {
  get([=] { front::glGetCombinerOutputParameterivNV(stage, portion, pname, params); });
}

GLAPI void GLAPIENTRY glGetFinalCombinerInputParameterfvNV(GLenum variable, GLenum pname, GLfloat* params) {
  get([=] { front::glGetFinalCombinerInputParameterfvNV(variable, pname, params); });
}

GLAPI void GLAPIENTRY glGetFinalCombinerInputParameterivNV(GLenum variable, GLenum pname, GLint* params) {
  get([=] { front::glGetFinalCombinerInputParameterivNV(variable, pname, params); });
}

GLAPI void GLAPIENTRY glGetCombinerStageParameterfvNV(GLenum stage, GLenum pname, GLfloat* params) {
  get([=] { front::glGetCombinerStageParameterfvNV(stage, pname, params); });
}

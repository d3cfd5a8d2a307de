// Commands that set uniforms. One of the layer's own programs is none to the program that runs: glUniform raises
// GL_INVALID_OPERATION as it does where no program is in use, and glProgramUniform gets a name that was not given out.
#include "src/gl_layer/calls/uniforms.h"

#include <algorithm>
#include <memory>
#include <vector>

#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/symbols.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

namespace {

bool goes_into_steps(const Context* context) {
  return context != nullptr && context->recording() && !context->list_in_begin();
}

template <class Command>
void set_uniform(const Command& command) {
  Context* const context = current();
  if (goes_into_steps(context)) return record(*context, [command] { set_uniform(command); });
  const bool own = context != nullptr && context->bound && context->open_list == nullptr && !context->in_begin;
  own ? context->raise(GL_INVALID_OPERATION) : command();
}

// `command` gets the numbers, which a display list keeps.
template <class T, class Command>
void set_uniforms(const T* values, GLsizei count, int size, const Command& command) {
  if (!goes_into_steps(current())) return set_uniform([=] { command(values); });
  const auto numbers = static_cast<std::size_t>(std::max<GLsizei>(count, 0)) * static_cast<std::size_t>(size);
  const auto kept = std::make_shared<const std::vector<T>>(values, values + numbers);
  set_uniform([=] { command(kept->data()); });
}

}  // namespace

#define NINEBIT_ALL(...) __VA_ARGS__
#define NINEBIT_NEXT(name) static const auto next = next_function_as<decltype(&::name)>(#name)

#define NINEBIT_SCALAR(form, parameters, arguments)                                      \
  GLAPI void GLAPIENTRY glUniform##form parameters {                                     \
    NINEBIT_NEXT(glUniform##form);                                                       \
    if (next != nullptr) set_uniform([=] { next arguments; });                           \
  }                                                                                      \
  GLAPI void GLAPIENTRY glProgramUniform##form(GLuint program, NINEBIT_ALL parameters) { \
    NINEBIT_NEXT(glProgramUniform##form);                                                \
    if (next != nullptr) next(visible_program(program), NINEBIT_ALL arguments);          \
  }
#define NINEBIT_VECTOR(form, T, size)                                                                            \
  GLAPI void GLAPIENTRY glUniform##form(GLint at, GLsizei count, const T* values) {                              \
    NINEBIT_NEXT(glUniform##form);                                                                               \
    if (next != nullptr) set_uniforms(values, count, size, [=](const T* numbers) { next(at, count, numbers); }); \
  }                                                                                                              \
  GLAPI void GLAPIENTRY glProgramUniform##form(GLuint program, GLint at, GLsizei count, const T* values) {       \
    NINEBIT_NEXT(glProgramUniform##form);                                                                        \
    if (next != nullptr) next(visible_program(program), at, count, values);                                      \
  }
#define NINEBIT_MATRIX(form, T, size)                                                                        \
  GLAPI void GLAPIENTRY glUniform##form(GLint at, GLsizei count, GLboolean transpose, const T* values) {     \
    NINEBIT_NEXT(glUniform##form);                                                                           \
    if (next == nullptr) return;                                                                             \
    set_uniforms(values, count, size, [=](const T* numbers) { next(at, count, transpose, numbers); });       \
  }                                                                                                          \
  GLAPI void GLAPIENTRY glProgramUniform##form(GLuint program, GLint at, GLsizei count, GLboolean transpose, \
                                               const T* values) {                                            \
    NINEBIT_NEXT(glProgramUniform##form);                                                                    \
    if (next != nullptr) next(visible_program(program), at, count, transpose, values);                       \
  }
NINEBIT_FIRST_UNIFORMS(NINEBIT_SCALAR, NINEBIT_VECTOR, NINEBIT_MATRIX)
NINEBIT_LATER_UNIFORMS(NINEBIT_SCALAR, NINEBIT_VECTOR, NINEBIT_MATRIX)

// The names of ARB_shader_objects.
#define NINEBIT_ARB_SCALAR(form, parameters, arguments)   \
  GLAPI void GLAPIENTRY glUniform##form##ARB parameters { \
    glUniform##form arguments;                            \
  }
#define NINEBIT_ARB_VECTOR(form, T, size)                                                \
  GLAPI void GLAPIENTRY glUniform##form##ARB(GLint at, GLsizei count, const T* values) { \
    glUniform##form(at, count, values);                                                  \
  }
#define NINEBIT_ARB_MATRIX(form, T, size)                                                                     \
  GLAPI void GLAPIENTRY glUniform##form##ARB(GLint at, GLsizei count, GLboolean transpose, const T* values) { \
    glUniform##form(at, count, transpose, values);                                                            \
  }
NINEBIT_FIRST_UNIFORMS(NINEBIT_ARB_SCALAR, NINEBIT_ARB_VECTOR, NINEBIT_ARB_MATRIX)

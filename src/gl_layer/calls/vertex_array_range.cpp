// GL_NV_vertex_array_range as plain memory: the range is state that draws do not depend on, and a flush has nothing to
// wait for, because a draw call has read its vertices when it returns.
#include <cstdlib>

#include "src/gl_layer/context/context.h"
#include "src/gl_layer/draw/vertex_programs.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/lookups.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

namespace {

Context* range_context() {
  Context* const context = current();
  return context != nullptr && context->features.extras.have(Extra::vertex_array_range) ? context : nullptr;
}

void set_attribute_array(Context& context, GLuint index, bool enabled) {
  if (!context.outside_begin()) return;
  enabled ? found_driver.EnableVertexAttribArrayARB(index) : found_driver.DisableVertexAttribArrayARB(index);
  find_attribute_array(context, index);
}

void set_client_state(GLenum array, bool enabled) {
  if (is_attribute_array(current(), array)) {
    return set_attribute_array(*current(), array - GL_VERTEX_ATTRIB_ARRAY0_NV, enabled);
  }
  Context* const context = range_context();
  if (context == nullptr || array != GL_VERTEX_ARRAY_RANGE_NV) {
    return enabled ? find_driver().EnableClientState(array) : find_driver().DisableClientState(array);
  }
  if (context->outside_begin()) context->vertex_range.enabled = enabled;
}

}  // namespace

GLAPI void GLAPIENTRY glVertexArrayRangeNV(GLsizei length, const void* pointer) {
  Context* const context = range_context();
  if (context == nullptr) {
    const auto call = find_driver().VertexArrayRangeNV;
    return call != nullptr ? call(length, pointer) : void();
  }
  if (!context->outside_begin()) return;
  if (length < 0) return context->raise(GL_INVALID_VALUE);
  note_use(Asked::vertex_array_range);
  context->vertex_range.length = length;
  context->vertex_range.pointer = pointer;
}

GLAPI void GLAPIENTRY glFlushVertexArrayRangeNV() {
  Context* const context = range_context();
  if (context != nullptr) return static_cast<void>(context->outside_begin());
  const auto call = find_driver().FlushVertexArrayRangeNV;
  if (call != nullptr) call();
}

GLAPI void GLAPIENTRY glEnableClientState(GLenum array) {
  set_client_state(array, true);
}

GLAPI void GLAPIENTRY glDisableClientState(GLenum array) {
  set_client_state(array, false);
}

GLAPI void GLAPIENTRY glGetPointerv(GLenum pname, GLvoid** params) {
  Context* const context = range_context();
  if (context == nullptr || pname != GL_VERTEX_ARRAY_RANGE_POINTER_NV) return find_driver().GetPointerv(pname, params);
  if (context->outside_begin()) *params = const_cast<GLvoid*>(context->vertex_range.pointer);
}

GLAPI void GLAPIENTRY glPushClientAttrib(GLbitfield mask) {
  Context* const context = range_context();
  if (context == nullptr || context->in_begin) return find_driver().PushClientAttrib(mask);
  const int before = driver_integer(GL_CLIENT_ATTRIB_STACK_DEPTH);
  found_driver.PushClientAttrib(mask);
  if (driver_integer(GL_CLIENT_ATTRIB_STACK_DEPTH) == before) return;
  const bool saves = (mask & GL_CLIENT_VERTEX_ARRAY_BIT) != 0;
  context->saved_ranges.push_back(saves ? std::optional(context->vertex_range) : std::nullopt);
}

GLAPI void GLAPIENTRY glPopClientAttrib() {
  Context* const context = range_context();
  find_driver().PopClientAttrib();
  if (has_vertex_programs(current()) && !current()->in_begin) find_attribute_arrays(*current());
  if (context == nullptr || context->in_begin || context->saved_ranges.empty()) return;
  if (context->saved_ranges.back()) context->vertex_range = *context->saved_ranges.back();
  context->saved_ranges.pop_back();
}

extern "C" {
#pragma GCC visibility push(default)

// Where the driver has no memory of its own for vertices, which is none of a context's.
void* glXAllocateMemoryNV(GLsizei size, GLfloat read_frequency, GLfloat write_frequency, GLfloat priority) {
  static const auto next = next_function_as<decltype(&glXAllocateMemoryNV)>("glXAllocateMemoryNV");
  if (!wanted_extras().have(Extra::vertex_array_range)) {
    return next != nullptr ? next(size, read_frequency, write_frequency, priority) : nullptr;
  }
  return size > 0 ? std::malloc(static_cast<std::size_t>(size)) : nullptr;
}

void glXFreeMemoryNV(void* pointer) {
  static const auto next = next_function_as<decltype(&glXFreeMemoryNV)>("glXFreeMemoryNV");
  if (wanted_extras().have(Extra::vertex_array_range)) return std::free(pointer);
  if (next != nullptr) next(pointer);
}

#pragma GCC visibility pop
}  // extern "C"

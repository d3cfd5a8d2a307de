// GL_NV_fence, which programs use to know when vertices in memory have been read: here a draw call has read them when
// it returns, so a fence that is set is passed. Names are a context's own.
#include "src/gl_layer/calls/display_lists.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/lookups.h"

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are OpenGL's names

namespace {

// The context, if the layer has its fences; not between glBegin and glEnd, where it raises the error.
Context* fence_context() {
  Context* const context = current();
  return context != nullptr && context->features.extras.have(Extra::fence) && context->outside_begin() ? context
                                                                                                       : nullptr;
}

bool are_the_drivers() {
  const Context* const context = current();
  return context == nullptr || !context->features.extras.have(Extra::fence);
}

// A name becomes a fence when it is set.
bool is_fence(const Context& context, GLuint name) {
  const auto found = context.fences.find(name);
  return found != context.fences.end() && found->second;
}

// The context of an existing fence; otherwise an error is raised.
Context* context_of_fence(GLuint name) {
  Context* const context = fence_context();
  if (context == nullptr || is_fence(*context, name)) return context;
  context->raise(GL_INVALID_OPERATION);
  return nullptr;
}

void set_fence(GLuint fence, GLenum condition) {
  Context* const context = current();
  if (context->open_list != nullptr) {
    if (context->list_in_begin()) return record_begin_error(*context);
    return record(*context, [=] { set_fence(fence, condition); });
  }
  if (!context->outside_begin()) return;
  if (condition != GL_ALL_COMPLETED_NV) return context->raise(GL_INVALID_ENUM);
  context->fences[fence] = true;
  note_use(Asked::fence);
}

}  // namespace

GLAPI void GLAPIENTRY glGenFencesNV(GLsizei n, GLuint* fences) {
  if (are_the_drivers()) {
    const auto call = find_driver().GenFencesNV;
    return call != nullptr ? call(n, fences) : void();
  }
  Context* const context = fence_context();
  if (context == nullptr) return;
  if (n < 0) return context->raise(GL_INVALID_VALUE);
  GLuint name = 0;
  for (GLsizei i = 0; i < n; ++i) {
    do ++name;
    while (context->fences.contains(name));
    context->fences[name] = false;
    fences[i] = name;
  }
}

GLAPI void GLAPIENTRY glDeleteFencesNV(GLsizei n, const GLuint* fences) {
  if (are_the_drivers()) {
    const auto call = find_driver().DeleteFencesNV;
    return call != nullptr ? call(n, fences) : void();
  }
  Context* const context = fence_context();
  if (context == nullptr) return;
  if (n < 0) return context->raise(GL_INVALID_VALUE);
  for (GLsizei i = 0; i < n; ++i) context->fences.erase(fences[i]);
}

GLAPI GLboolean GLAPIENTRY glIsFenceNV(GLuint fence) {
  if (are_the_drivers()) {
    const auto call = find_driver().IsFenceNV;
    return call != nullptr ? call(fence) : GLboolean{GL_FALSE};
  }
  const Context* const context = fence_context();
  return context != nullptr && is_fence(*context, fence) ? GL_TRUE : GL_FALSE;
}

GLAPI GLboolean GLAPIENTRY glTestFenceNV(GLuint fence) {
  if (are_the_drivers()) {
    const auto call = find_driver().TestFenceNV;
    return call != nullptr ? call(fence) : GLboolean{GL_TRUE};
  }
  static_cast<void>(context_of_fence(fence));
  return GL_TRUE;  // also after an error
}

GLAPI void GLAPIENTRY glGetFenceivNV(GLuint fence, GLenum pname, GLint* params) {
  if (are_the_drivers()) {
    const auto call = find_driver().GetFenceivNV;
    return call != nullptr ? call(fence, pname, params) : void();
  }
  Context* const context = context_of_fence(fence);
  if (context == nullptr) return;
  if (pname != GL_FENCE_STATUS_NV && pname != GL_FENCE_CONDITION_NV) return context->raise(GL_INVALID_ENUM);
  *params = pname == GL_FENCE_STATUS_NV ? GL_TRUE : GL_ALL_COMPLETED_NV;
}

GLAPI void GLAPIENTRY glFinishFenceNV(GLuint fence) {
  if (are_the_drivers()) {
    const auto call = find_driver().FinishFenceNV;
    return call != nullptr ? call(fence) : void();
  }
  static_cast<void>(context_of_fence(fence));
}

GLAPI void GLAPIENTRY glSetFenceNV(GLuint fence, GLenum condition) {
  if (are_the_drivers()) {
    const auto call = find_driver().SetFenceNV;
    return call != nullptr ? call(fence, condition) : void();
  }
  set_fence(fence, condition);
}

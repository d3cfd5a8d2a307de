#include "ninebit/language/gl_nv.h"

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
  context->raise(GlError::invalid_enum);
  return GL_FALSE;
}

GLenum glGetError() {
  if (current_context == nullptr) return GL_INVALID_OPERATION;
  return static_cast<GLenum>(current_context->take_error());
}

}  // namespace ninebit::gl

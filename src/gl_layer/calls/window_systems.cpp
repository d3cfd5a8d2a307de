// GLX and EGL: which context is current on a thread, which contexts share their objects, where frames end. Types of the
// window systems are plain pointers here, so that their headers are not needed.
#include <map>
#include <memory>
#include <mutex>

#include "src/gl_layer/capture/dump.h"
#include "src/gl_layer/context/context.h"
#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/driver_features.h"
#include "src/gl_layer/driver/log.h"
#include "src/gl_layer/driver/symbols.h"

namespace ninebit::gl_layer {
namespace {

using Handle = void*;

// The contexts of the process by their handles. Never destroyed: programs draw from their own destructors.
struct Contexts {
  std::mutex mutex{};
  std::map<Handle, std::shared_ptr<Context>> by_handle{};
  std::map<Handle, std::shared_ptr<ShareGroup>> groups{};  // of those that were not current yet, too
};

Contexts& contexts() {
  static auto& all = *new Contexts;
  return all;
}

// Keeps a context that is current alive when the program destroys it. It has no destructor: programs release contexts
// at their exit, when a thread's objects are gone.
constinit thread_local std::shared_ptr<Context>* held_context = nullptr;

void created(Handle handle, Handle share) {
  if (handle == nullptr) return;
  Contexts& all = contexts();
  const std::lock_guard lock(all.mutex);
  std::shared_ptr<ShareGroup> group;
  if (const auto found = all.groups.find(share); share != nullptr && found != all.groups.end()) group = found->second;
  all.by_handle.erase(handle);
  all.groups[handle] = group != nullptr ? group : std::make_shared<ShareGroup>();
}

void destroyed(Handle handle) {
  Contexts& all = contexts();
  const std::lock_guard lock(all.mutex);
  all.by_handle.erase(handle);
  all.groups.erase(handle);
}

// The driver's error, if it cannot, comes from the X server later.
void copied(Handle handle) {
  Contexts& all = contexts();
  const std::lock_guard lock(all.mutex);
  const auto found = all.by_handle.find(handle);
  const bool has_state = found != all.by_handle.end() && found->second != nullptr &&
                         (found->second->touched || found->second->vertex.is_bound);
  if (has_state) log_once("glXCopyContext: the state of the extensions that the layer adds is not copied");
}

// After contexts of its group may have gone.
void clean_up_current() {
  Context* const context = current();
  if (context != nullptr && !context->in_begin) context->group->own_programs.delete_abandoned();
}

void made_current(Handle handle) {
  current_context = nullptr;
  delete held_context;
  held_context = nullptr;
  if (handle == nullptr) return;
  Contexts& all = contexts();
  const std::lock_guard lock(all.mutex);
  std::shared_ptr<Context>& context = all.by_handle[handle];
  if (context == nullptr) {
    auto& group = all.groups[handle];
    if (group == nullptr) group = std::make_shared<ShareGroup>();
    context = std::make_shared<Context>(group, layer_profile());
    context->features = find_features();
  }
  held_context = new std::shared_ptr<Context>(context);
  if (context->features.enough) current_context = context.get();
  clean_up_current();
}

void end_frame() {
  Context* const context = current();
  if (context == nullptr) return;
  ++context->frame;
  frame_ended(*context);
}

}  // namespace
}  // namespace ninebit::gl_layer

using namespace ninebit::gl_layer;  // NOLINT(google-build-using-namespace): these are GLX's and EGL's names

extern "C" {
#pragma GCC visibility push(default)

void* glXCreateContext(void* display, void* visual, void* share, int direct) {
  static const auto next = next_function_as<decltype(&glXCreateContext)>("glXCreateContext");
  if (next == nullptr) return nullptr;
  void* const context = next(display, visual, share, direct);
  created(context, share);
  return context;
}

void* glXCreateNewContext(void* display, void* config, int type, void* share, int direct) {
  static const auto next = next_function_as<decltype(&glXCreateNewContext)>("glXCreateNewContext");
  if (next == nullptr) return nullptr;
  void* const context = next(display, config, type, share, direct);
  created(context, share);
  return context;
}

void* glXCreateContextAttribsARB(void* display, void* config, void* share, int direct, const int* attributes) {
  static const auto next = next_function_as<decltype(&glXCreateContextAttribsARB)>("glXCreateContextAttribsARB");
  if (next == nullptr) return nullptr;
  void* const context = next(display, config, share, direct, attributes);
  created(context, share);
  return context;
}

void glXCopyContext(void* display, void* from, void* to, unsigned long mask) {
  static const auto next = next_function_as<decltype(&glXCopyContext)>("glXCopyContext");
  if (next != nullptr) next(display, from, to, mask);
  copied(from);
}

void glXDestroyContext(void* display, void* context) {
  static const auto next = next_function_as<decltype(&glXDestroyContext)>("glXDestroyContext");
  if (next != nullptr) next(display, context);
  destroyed(context);
  clean_up_current();
}

int glXMakeCurrent(void* display, unsigned long drawable, void* context) {
  static const auto next = next_function_as<decltype(&glXMakeCurrent)>("glXMakeCurrent");
  const int done = next != nullptr ? next(display, drawable, context) : 0;
  if (done != 0) made_current(context);
  return done;
}

int glXMakeContextCurrent(void* display, unsigned long draw, unsigned long read, void* context) {
  static const auto next = next_function_as<decltype(&glXMakeContextCurrent)>("glXMakeContextCurrent");
  const int done = next != nullptr ? next(display, draw, read, context) : 0;
  if (done != 0) made_current(context);
  return done;
}

void glXSwapBuffers(void* display, unsigned long drawable) {
  static const auto next = next_function_as<decltype(&glXSwapBuffers)>("glXSwapBuffers");
  end_frame();
  if (next != nullptr) next(display, drawable);
}

void* eglCreateContext(void* display, void* config, void* share, const int* attributes) {
  static const auto next = next_function_as<decltype(&eglCreateContext)>("eglCreateContext");
  if (next == nullptr) return nullptr;
  void* const context = next(display, config, share, attributes);
  created(context, share);
  return context;
}

unsigned eglDestroyContext(void* display, void* context) {
  static const auto next = next_function_as<decltype(&eglDestroyContext)>("eglDestroyContext");
  const unsigned done = next != nullptr ? next(display, context) : 0;
  if (done != 0) destroyed(context);
  clean_up_current();
  return done;
}

unsigned eglMakeCurrent(void* display, void* draw, void* read, void* context) {
  static const auto next = next_function_as<decltype(&eglMakeCurrent)>("eglMakeCurrent");
  const unsigned done = next != nullptr ? next(display, draw, read, context) : 0;
  if (done != 0) made_current(context);
  return done;
}

unsigned eglReleaseThread() {
  static const auto next = next_function_as<decltype(&eglReleaseThread)>("eglReleaseThread");
  const unsigned done = next != nullptr ? next() : 0;
  if (done != 0) made_current(nullptr);
  return done;
}

unsigned eglSwapBuffers(void* display, void* surface) {
  static const auto next = next_function_as<decltype(&eglSwapBuffers)>("eglSwapBuffers");
  end_frame();
  return next != nullptr ? next(display, surface) : 0;
}

#pragma GCC visibility pop
}  // extern "C"

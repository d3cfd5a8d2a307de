#include "src/bench/egl_context.h"

#ifdef NINEBIT_HAS_EGL
#define EGL_EGL_PROTOTYPES 0
#include <EGL/egl.h>
#include <EGL/eglext.h>

#include <array>

#include "src/system/process.h"

// Functions of the leak sanitizer, if the program is built with it.
extern "C" {
__attribute__((weak)) void __lsan_disable();  // NOLINT(bugprone-reserved-identifier): the sanitizer's name
__attribute__((weak)) void __lsan_enable();   // NOLINT(bugprone-reserved-identifier)
}
#endif

namespace ninebit::bench {

#ifndef NINEBIT_HAS_EGL

DriverCode::DriverCode() = default;
DriverCode::~DriverCode() = default;

Result<std::unique_ptr<EglContext>> EglContext::make(int) {
  return Diagnostic{.message = "this ninebit was built without EGL; install libegl-dev and libgl-dev, and rebuild"};
}

#else
namespace {

// The library stays loaded: drivers leave threads and exit handlers behind.
class Context final : public EglContext {
 public:
  Context() = default;
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;
  ~Context() override {
    if (display_ == EGL_NO_DISPLAY) return;
    const DriverCode driver_code;
    make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) destroy_context_(display_, context_);
    terminate_(display_);
  }

  Status open() {
    const DriverCode driver_code;
    library_ = posix::load_library("libEGL.so.1");
    if (library_ == nullptr) return fault("EGL is not installed; install libegl1");
    PFNEGLGETPLATFORMDISPLAYPROC get_platform_display = nullptr;
    PFNEGLINITIALIZEPROC initialize = nullptr;
    PFNEGLBINDAPIPROC bind_api = nullptr;
    PFNEGLCREATECONTEXTPROC create_context = nullptr;
    if (!load(get_platform_display, "eglGetPlatformDisplay") || !load(initialize, "eglInitialize") ||
        !load(bind_api, "eglBindAPI") || !load(create_context, "eglCreateContext") ||
        !load(make_current_, "eglMakeCurrent") || !load(destroy_context_, "eglDestroyContext") ||
        !load(terminate_, "eglTerminate") || !load(get_proc_address_, "eglGetProcAddress")) {
      return fault("the installed EGL is too old; expected version 1.5 or later");
    }
    display_ = get_platform_display(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (display_ == EGL_NO_DISPLAY || initialize(display_, nullptr, nullptr) == EGL_FALSE) {
      display_ = EGL_NO_DISPLAY;
      return fault("EGL has no surfaceless platform; install libegl-mesa0 and libgl1-mesa-dri");
    }
    const std::array<EGLint, 7> attributes{
        EGL_CONTEXT_MAJOR_VERSION,           3,       EGL_CONTEXT_MINOR_VERSION, 3, EGL_CONTEXT_OPENGL_PROFILE_MASK,
        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT, EGL_NONE};
    bind_api(EGL_OPENGL_API);
    context_ = create_context(display_, EGL_NO_CONFIG_KHR, EGL_NO_CONTEXT, attributes.data());
    if (context_ == EGL_NO_CONTEXT || make_current_(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) == EGL_FALSE) {
      return fault("EGL cannot create an OpenGL 3.3 context");
    }
    return {};
  }

  [[nodiscard]] Function function(const char* name) const override { return get_proc_address_(name); }

 private:
  static Diagnostic fault(const char* message) { return Diagnostic{.message = message}; }

  template <class Entry>
  bool load(Entry& entry, const char* name) {
    entry = reinterpret_cast<Entry>(posix::find_symbol(library_, name));
    return entry != nullptr;
  }

  void* library_ = nullptr;
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
  PFNEGLMAKECURRENTPROC make_current_ = nullptr;
  PFNEGLDESTROYCONTEXTPROC destroy_context_ = nullptr;
  PFNEGLTERMINATEPROC terminate_ = nullptr;
  PFNEGLGETPROCADDRESSPROC get_proc_address_ = nullptr;
};

}  // namespace

DriverCode::DriverCode() {
  if (__lsan_disable != nullptr) __lsan_disable();
}
DriverCode::~DriverCode() {
  if (__lsan_enable != nullptr) __lsan_enable();
}

Result<std::unique_ptr<EglContext>> EglContext::make(int threads) {
  posix::set_environment("LIBGL_ALWAYS_SOFTWARE", "true");
  posix::set_environment("GALLIUM_DRIVER", "llvmpipe");
  posix::set_environment("LP_NUM_THREADS", std::to_string(threads));
  // Leaves nothing in the user's home. Timing does not need the cache: shaders are compiled before the measurement.
  posix::set_environment("MESA_SHADER_CACHE_DISABLE", "true");
  auto context = std::make_unique<Context>();
  if (Status opened = context->open(); !opened) return opened.error();
  return std::unique_ptr<EglContext>(std::move(context));
}
#endif

}  // namespace ninebit::bench

// OpenGL contexts on a software renderer, without a window. The test program links the layer before the driver, which
// is what loading it before a program amounts to.
#pragma once

#include "ninebit/combiner/state.h"
#include "ninebit/language/gl_enums.h"
#include "ninebit/numerics/hardware_profile.h"

#define GL_GLEXT_PROTOTYPES 1
#include <GL/gl.h>
#include <GL/glext.h>

#include <memory>
#include <string>

namespace ninebit::test {

// A compatibility context with a picture of 16 x 16 pixels.
class GlContext {
 public:
  // A new context, current on this thread; nullptr if there is no driver: then `why_not` says so. The layer takes
  // `profile`, one of the shipped ones. `share`: a context to share objects with.
  static std::unique_ptr<GlContext> make(std::string& why_not, const HardwareProfile& profile = profiles::nv2a,
                                         const GlContext* share = nullptr);
  ~GlContext();
  GlContext(const GlContext&) = delete;
  GlContext& operator=(const GlContext&) = delete;

  void make_current() const;
  static void release();

 private:
  GlContext() = default;
  void* surface_ = nullptr;
  void* context_ = nullptr;
};

// While it lives, new contexts have the further extensions of a list, as `--extensions` takes it.
class WithExtensions {
 public:
  explicit WithExtensions(const char* list);
  ~WithExtensions();
  WithExtensions(const WithExtensions&) = delete;
  WithExtensions& operator=(const WithExtensions&) = delete;
};

inline constexpr int kPictureSize = 16;

// What glGetError returns, of its type.
inline constexpr GLenum kNoError = GL_NO_ERROR, kInvalidEnum = GL_INVALID_ENUM, kInvalidValue = GL_INVALID_VALUE,
                        kInvalidOperation = GL_INVALID_OPERATION, kStackOverflow = GL_STACK_OVERFLOW,
                        kStackUnderflow = GL_STACK_UNDERFLOW;

// A test that ends has asked for all errors of its context.
struct NoErrorIsLeft {
  ~NoErrorIsLeft();
};

// Sets the combiners to a valid state by GL's calls, and enables them.
void set_combiners(const CombinerState& state, const HardwareProfile& profile);

}  // namespace ninebit::test

// Begins a test: a current context, without an error at the test's end; or a skipped test that says why.
#define NINEBIT_GL_CONTEXT(name, ...)                                                   \
  std::string why_not;                                                                  \
  const auto name = ninebit::test::GlContext::make(why_not __VA_OPT__(, ) __VA_ARGS__); \
  if (name == nullptr) GTEST_SKIP() << why_not;                                         \
  [[maybe_unused]] const ninebit::test::NoErrorIsLeft name##_has_no_error

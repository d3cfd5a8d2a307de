#include "combiner_tests/gl_layer/gl_context.h"

#include <EGL/egl.h>
#include <EGL/eglext.h>
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>

#include "ninebit/language/gl_nv.h"

// At the end of the process LeakSanitizer looks through the memory of Mesa's threads, and crashes there now and then
// ("Tracer caught signal 11"). So it does not look.
extern "C" int __lsan_is_turned_off();  // NOLINT(bugprone-reserved-identifier): LeakSanitizer's name for it
extern "C" int __lsan_is_turned_off() {
  return 1;
}  // NOLINT(bugprone-reserved-identifier)

namespace ninebit::test {
namespace {

// One display for all tests; it stays open.
EGLDisplay display_of_tests() {
  static const EGLDisplay display = []() -> EGLDisplay {
    setenv("MESA_SHADER_CACHE_DISABLE", "true", 1);
    setenv("LP_NUM_THREADS", "0", 1);
    setenv("GALLIVM_PERF", "nopt", 1);  // llvmpipe's own optimizer takes longer than it saves
    const EGLDisplay opened = eglGetPlatformDisplay(EGL_PLATFORM_SURFACELESS_MESA, EGL_DEFAULT_DISPLAY, nullptr);
    if (opened == EGL_NO_DISPLAY || eglInitialize(opened, nullptr, nullptr) == EGL_FALSE) return EGL_NO_DISPLAY;
    return opened;
  }();
  return display;
}

EGLConfig find_config(EGLDisplay display) {
  constexpr EGLint wanted[][2]{{EGL_SURFACE_TYPE, EGL_PBUFFER_BIT},
                               {EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT},
                               {EGL_RED_SIZE, 8},
                               {EGL_GREEN_SIZE, 8},
                               {EGL_BLUE_SIZE, 8},
                               {EGL_ALPHA_SIZE, 8},
                               {EGL_DEPTH_SIZE, 24},
                               {EGL_STENCIL_SIZE, 8},
                               {EGL_NONE, EGL_NONE}};
  EGLConfig config = nullptr;
  EGLint number = 0;
  eglChooseConfig(display, wanted[0], &config, 1, &number);
  return number > 0 ? config : nullptr;
}

void set_input(int stage, PortionName portion, Variable variable, const CombinerInput& in) {
  glCombinerInputNV(GL_COMBINER0_NV + static_cast<GLenum>(stage), gl::to_enum(portion), gl::to_enum(variable),
                    gl::to_enum(in.reg), gl::to_enum(in.mapping), gl::to_enum(in.usage));
}

void set_portion(int stage, PortionName name, const Portion& p) {
  set_input(stage, name, Variable::a, p.a);
  set_input(stage, name, Variable::b, p.b);
  set_input(stage, name, Variable::c, p.c);
  set_input(stage, name, Variable::d, p.d);
  const PortionOutput& out = p.out;
  const auto boolean = [](bool value) -> GLboolean { return value ? GL_TRUE : GL_FALSE; };
  glCombinerOutputNV(GL_COMBINER0_NV + static_cast<GLenum>(stage), gl::to_enum(name), gl::to_enum(out.ab),
                     gl::to_enum(out.cd), gl::to_enum(out.sum), gl::to_enum(out.scale), gl::to_enum(out.bias),
                     boolean(out.ab_dot_product), boolean(out.cd_dot_product), boolean(out.mux_sum));
}

}  // namespace

std::unique_ptr<GlContext> GlContext::make(std::string& why_not, const HardwareProfile& profile,
                                           const GlContext* share) {
  setenv("NINEBIT_GL_PROFILE", std::string(profile.name).c_str(), 1);
  const EGLDisplay display = display_of_tests();
  if (display == EGL_NO_DISPLAY) {
    why_not = "EGL has no surfaceless platform here (install libegl1, libegl-mesa0 and libgl1-mesa-dri)";
    return nullptr;
  }
  eglBindAPI(EGL_OPENGL_API);
  const EGLConfig config = find_config(display);
  constexpr std::array<EGLint, 5> size{EGL_WIDTH, kPictureSize, EGL_HEIGHT, kPictureSize, EGL_NONE};
  std::unique_ptr<GlContext> made(new GlContext);
  made->surface_ = eglCreatePbufferSurface(display, config, size.data());
  made->context_ = eglCreateContext(display, config, share != nullptr ? share->context_ : nullptr, nullptr);
  if (made->surface_ == EGL_NO_SURFACE || made->context_ == EGL_NO_CONTEXT) {
    why_not = "EGL gives no OpenGL context with a picture";
    return nullptr;
  }
  made->make_current();
  return made;
}

GlContext::~GlContext() {
  release();
  if (context_ != nullptr) eglDestroyContext(display_of_tests(), context_);
  if (surface_ != nullptr) eglDestroySurface(display_of_tests(), surface_);
}

void GlContext::make_current() const {
  eglMakeCurrent(display_of_tests(), surface_, surface_, context_);
}

void GlContext::release() {
  eglMakeCurrent(display_of_tests(), EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
}

WithExtensions::WithExtensions(const char* list) {
  setenv("NINEBIT_GL_EXTENSIONS", list, 1);
}

WithExtensions::~WithExtensions() {
  unsetenv("NINEBIT_GL_EXTENSIONS");
}

NoErrorIsLeft::~NoErrorIsLeft() {
  EXPECT_EQ(glGetError(), kNoError) << "an error that the test has not asked for";
}

void set_combiners(const CombinerState& state, const HardwareProfile& profile) {
  glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, state.num_general_combiners);
  glCombinerParameteriNV(GL_COLOR_SUM_CLAMP_NV, state.color_sum_clamp ? 1 : 0);
  glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, state.constant0.data());
  glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, state.constant1.data());
  for (int i = 0; i < profile.general_combiners; ++i) {
    const GeneralCombiner& general = state.general[static_cast<std::size_t>(i)];
    set_portion(i, PortionName::rgb, general.rgb);
    set_portion(i, PortionName::alpha, general.alpha);
    if (!profile.per_stage_constants) continue;
    const GLenum stage = GL_COMBINER0_NV + static_cast<GLenum>(i);
    glCombinerStageParameterfvNV(stage, GL_CONSTANT_COLOR0_NV, general.constant0.data());
    glCombinerStageParameterfvNV(stage, GL_CONSTANT_COLOR1_NV, general.constant1.data());
  }
  const FinalCombiner& f = state.final_combiner;
  const CombinerInput* const inputs[]{&f.a, &f.b, &f.c, &f.d, &f.e, &f.f, &f.g};
  for (std::size_t i = 0; i < 7; ++i) {
    glFinalCombinerInputNV(gl::to_enum(static_cast<Variable>(i)), gl::to_enum(inputs[i]->reg),
                           gl::to_enum(inputs[i]->mapping), gl::to_enum(inputs[i]->usage));
  }
  if (profile.per_stage_constants) {
    (state.per_stage_constants ? glEnable : glDisable)(GL_PER_STAGE_CONSTANTS_NV);
  }
  glEnable(GL_REGISTER_COMBINERS_NV);
}

}  // namespace ninebit::test

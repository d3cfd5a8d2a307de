// NV_register_combiners and NV_register_combiners2 as C++ functions with their GL names, so that code written for GL
// compiles unchanged:
//
//   #include <ninebit/language/gl_nv.h>
//   using namespace ninebit::gl;
//   Context context;                  // a GeForce 2
//   CurrentContext current(context);  // what the calls below this line speak to
//   glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
//   …
//   const auto program = ninebit::compile(context.state(), context.profile());
//
// Errors are GL's: a command with an error leaves the state as it was, and the first error stays until glGetError.
// Where a command has several errors, GL_INVALID_ENUM goes first. Without a current context the calls below do nothing
// (what would be returned through a pointer is left alone) and glGetError returns GL_INVALID_OPERATION.
// Beyond GL's own errors, a null pointer raises GL_INVALID_VALUE.
#pragma once

#include "ninebit/combiner/state.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/gl_enums.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {
namespace gl {

// What a GL context knows of the register combiners: their state, whether they are enabled, and the pending error.
// A value: copies are independent. One thread at a time may use it.
class Context {
 public:
  // The profile says how many general combiners and texture units there are, and whether NV_register_combiners2 is.
  explicit Context(const HardwareProfile& profile = profiles::geforce2) : profile_(profile) {}

  // As it was given.
  [[nodiscard]] const HardwareProfile& profile() const { return profile_; }

  // What is written through state() is not checked.
  [[nodiscard]] const CombinerState& state() const { return state_; }
  [[nodiscard]] CombinerState& state() { return state_; }

  // GL_REGISTER_COMBINERS_NV.
  [[nodiscard]] bool register_combiners_enabled() const { return register_combiners_enabled_; }
  void enable_register_combiners(bool enabled) { register_combiners_enabled_ = enabled; }

  // The pending error. raise() is without effect while one is pending; take_error() returns and clears it.
  [[nodiscard]] GlError error() const { return error_; }
  void raise(GlError error);
  GlError take_error();

 private:
  HardwareProfile profile_;
  CombinerState state_{};
  bool register_combiners_enabled_ = false;
  GlError error_ = GlError::no_error;
};

// Makes a context the current one of this thread for as long as this object lives, then the former one again. These
// objects end on the thread and in the reverse order of their making, as local variables do; the context outlives them.
class CurrentContext {
 public:
  // `context` must outlive this object.
  explicit CurrentContext(Context& context);
  ~CurrentContext();
  CurrentContext(const CurrentContext&) = delete;
  CurrentContext& operator=(const CurrentContext&) = delete;

  // This thread's current context, or nullptr.
  [[nodiscard]] static Context* get();

 private:
  Context* former_;
};

// GL_NUM_GENERAL_COMBINERS_NV (1 to the profile's number, else GL_INVALID_VALUE; a float is rounded to nearest) and
// GL_COLOR_SUM_CLAMP_NV (anything but 0 is true).
void glCombinerParameteriNV(GLenum pname, GLint param);
void glCombinerParameterfNV(GLenum pname, GLfloat param);
// The same, and GL_CONSTANT_COLOR0_NV and GL_CONSTANT_COLOR1_NV, red, green, blue, alpha: floats are clamped to [0, 1]
// (NaN becomes 0), an integer c stands for (2c + 1) / (2^32 - 1) and is then clamped.
void glCombinerParameterivNV(GLenum pname, const GLint* params);
void glCombinerParameterfvNV(GLenum pname, const GLfloat* params);

// One variable of a general combiner's portion.
void glCombinerInputNV(GLenum stage, GLenum portion, GLenum variable, GLenum input, GLenum mapping,
                       GLenum componentUsage);
// What a general combiner's portion does with its products.
void glCombinerOutputNV(GLenum stage, GLenum portion, GLenum abOutput, GLenum cdOutput, GLenum sumOutput, GLenum scale,
                        GLenum bias, GLboolean abDotProduct, GLboolean cdDotProduct, GLboolean muxSum);
// One variable of the final combiner.
void glFinalCombinerInputNV(GLenum variable, GLenum input, GLenum mapping, GLenum componentUsage);

// NV_register_combiners2: one stage's GL_CONSTANT_COLOR0_NV or GL_CONSTANT_COLOR1_NV, floats as above. Legal whether
// GL_PER_STAGE_CONSTANTS_NV is enabled or not; GL_INVALID_ENUM with a profile that lacks the extension.
void glCombinerStageParameterfvNV(GLenum stage, GLenum pname, const GLfloat* params);

// GL_REGISTER_COMBINERS_NV and, where the profile has it, GL_PER_STAGE_CONSTANTS_NV.
void glEnable(GLenum cap);
void glDisable(GLenum cap);
[[nodiscard]] GLboolean glIsEnabled(GLenum cap);

// Returns and clears the pending error.
GLenum glGetError();

// GL_NUM_GENERAL_COMBINERS_NV, GL_MAX_GENERAL_COMBINERS_NV, GL_COLOR_SUM_CLAMP_NV, the two enables, and
// GL_CONSTANT_COLOR0_NV and GL_CONSTANT_COLOR1_NV, which write four values: as integers, 1.0 is 2^31 - 1 and 0.0 is 0.
void glGetIntegerv(GLenum pname, GLint* params);
void glGetFloatv(GLenum pname, GLfloat* params);

// GL_COMBINER_INPUT_NV, GL_COMBINER_MAPPING_NV, GL_COMBINER_COMPONENT_USAGE_NV.
void glGetCombinerInputParameterivNV(GLenum stage, GLenum portion, GLenum variable, GLenum pname, GLint* params);
void glGetCombinerInputParameterfvNV(GLenum stage, GLenum portion, GLenum variable, GLenum pname, GLfloat* params);
void glGetFinalCombinerInputParameterivNV(GLenum variable, GLenum pname, GLint* params);
void glGetFinalCombinerInputParameterfvNV(GLenum variable, GLenum pname, GLfloat* params);

// GL_COMBINER_{AB,CD,SUM}_OUTPUT_NV, GL_COMBINER_{AB,CD}_DOT_PRODUCT_NV, GL_COMBINER_MUX_SUM_NV, GL_COMBINER_SCALE_NV,
// GL_COMBINER_BIAS_NV.
void glGetCombinerOutputParameterivNV(GLenum stage, GLenum portion, GLenum pname, GLint* params);
void glGetCombinerOutputParameterfvNV(GLenum stage, GLenum portion, GLenum pname, GLfloat* params);

// NV_register_combiners2; the four values as they were stored, clamped.
void glGetCombinerStageParameterfvNV(GLenum stage, GLenum pname, GLfloat* params);

}  // namespace gl
}  // namespace ninebit

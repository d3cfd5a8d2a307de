// NV_register_combiners, NV_register_combiners2 and the state of NV_texture_shader as C++ functions with their GL
// names, so that code written for GL compiles unchanged:
//
//   #include <ninebit/language/gl_nv.h>
//   using namespace ninebit::gl;
//   Context context;                  // a GeForce 2
//   CurrentContext current(context);  // the context of the calls below this line
//   glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
//   …
//   const auto program = ninebit::compile(context.state(), context.profile());
//
// Errors are GL's: a command with an error does not change the state, and the first error stays until glGetError. If a
// command has several errors, GL_INVALID_ENUM takes precedence. Without a current context, the calls below do nothing
// (values returned through a pointer are not written) and glGetError returns GL_INVALID_OPERATION. Beyond GL's own
// errors, a null pointer raises GL_INVALID_VALUE.
#pragma once

#include "ninebit/combiner/state.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/gl_enums.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {
namespace gl {

// The register-combiner part of a GL context: the state, whether the combiners are enabled, and the pending error. It
// is a value: copies are independent. Only one thread at a time may use it.
class Context {
 public:
  // The profile defines the number of general combiners and texture units, and whether NV_register_combiners2 is
  // available.
  explicit Context(const HardwareProfile& profile = profiles::geforce2) : profile_(profile) {}

  // The profile given to the constructor.
  [[nodiscard]] const HardwareProfile& profile() const { return profile_; }

  // Writes through state() are not checked.
  [[nodiscard]] const CombinerState& state() const { return state_; }
  [[nodiscard]] CombinerState& state() { return state_; }

  // The constants that calls have set, by place; last are those of glCombinerParameter.
  [[nodiscard]] const ByConstant<bool>& constants_set() const { return constants_set_; }
  [[nodiscard]] ByConstant<bool>& constants_set() { return constants_set_; }

  // The texture-shader stages, and the active texture unit (GL_ACTIVE_TEXTURE, from 0), whose stage glTexEnv sets.
  [[nodiscard]] const TextureShaderState& texture_shader() const { return texture_shader_; }
  [[nodiscard]] TextureShaderState& texture_shader() { return texture_shader_; }
  [[nodiscard]] int active_texture() const { return active_texture_; }
  void set_active_texture(int unit) { active_texture_ = unit; }

  // Whether GL_REGISTER_COMBINERS_NV is enabled.
  [[nodiscard]] bool register_combiners_enabled() const { return register_combiners_enabled_; }
  void enable_register_combiners(bool enabled) { register_combiners_enabled_ = enabled; }

  // The pending error. raise() has no effect while one is pending; take_error() returns and clears it.
  [[nodiscard]] GlError error() const { return error_; }
  void raise(GlError error);
  GlError take_error();

 private:
  HardwareProfile profile_;
  CombinerState state_{};
  TextureShaderState texture_shader_{};
  int active_texture_ = 0;
  ByConstant<bool> constants_set_{};
  bool register_combiners_enabled_ = false;
  GlError error_ = GlError::no_error;
};

// Makes a context current on this thread for the lifetime of this object, then restores the previous one. Destroy these
// objects on the same thread and in the reverse order of construction, as with local variables.
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

// GL_NUM_GENERAL_COMBINERS_NV (1 to the profile's number, otherwise GL_INVALID_VALUE; a float is rounded to nearest)
// and GL_COLOR_SUM_CLAMP_NV (anything but 0 is true).
void glCombinerParameteriNV(GLenum pname, GLint param);
void glCombinerParameterfNV(GLenum pname, GLfloat param);
// The same, and GL_CONSTANT_COLOR0_NV and GL_CONSTANT_COLOR1_NV, red, green, blue, alpha: floats are clamped to [0, 1]
// (NaN becomes 0), an integer c stands for (2c + 1) / (2^32 - 1) and is then clamped.
void glCombinerParameterivNV(GLenum pname, const GLint* params);
void glCombinerParameterfvNV(GLenum pname, const GLfloat* params);

// One variable of a general combiner's portion.
void glCombinerInputNV(GLenum stage, GLenum portion, GLenum variable, GLenum input, GLenum mapping,
                       GLenum componentUsage);
// The outputs of a general combiner's portion.
void glCombinerOutputNV(GLenum stage, GLenum portion, GLenum abOutput, GLenum cdOutput, GLenum sumOutput, GLenum scale,
                        GLenum bias, GLboolean abDotProduct, GLboolean cdDotProduct, GLboolean muxSum);
// One variable of the final combiner.
void glFinalCombinerInputNV(GLenum variable, GLenum input, GLenum mapping, GLenum componentUsage);

// NV_register_combiners2: one stage's GL_CONSTANT_COLOR0_NV or GL_CONSTANT_COLOR1_NV, floats as above. Legal whether
// GL_PER_STAGE_CONSTANTS_NV is enabled or not; GL_INVALID_ENUM if the profile does not have the extension.
void glCombinerStageParameterfvNV(GLenum stage, GLenum pname, const GLfloat* params);

// The active texture unit: GL_TEXTURE0 and so on, as many as the profile has; otherwise GL_INVALID_ENUM.
void glActiveTexture(GLenum texture);
void glActiveTextureARB(GLenum texture);  // the same

// NV_texture_shader: a parameter of the active unit's stage. `target` must be GL_TEXTURE_SHADER_NV, of a profile that
// has texture shaders; otherwise GL_INVALID_ENUM. GL_CULL_MODES_NV and GL_OFFSET_TEXTURE_MATRIX_NV (four values) and
// GL_CONST_EYE_NV (three) need a vector; GL_SHADER_OPERATION_NV, GL_PREVIOUS_TEXTURE_INPUT_NV,
// GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV, GL_OFFSET_TEXTURE_SCALE_NV and GL_OFFSET_TEXTURE_BIAS_NV have one value.
// Operations are those of the GeForce 3 (stage_operation.h); errors are those of validate_stages.h.
void glTexEnvi(GLenum target, GLenum pname, GLint param);
void glTexEnvf(GLenum target, GLenum pname, GLfloat param);
void glTexEnviv(GLenum target, GLenum pname, const GLint* params);
void glTexEnvfv(GLenum target, GLenum pname, const GLfloat* params);
// The same parameters. GL_SHADER_CONSISTENT_NV depends on textures, which a context does not have: GL_INVALID_ENUM;
// compile() in stage_program.h decides it.
void glGetTexEnviv(GLenum target, GLenum pname, GLint* params);
void glGetTexEnvfv(GLenum target, GLenum pname, GLfloat* params);

// GL_REGISTER_COMBINERS_NV and, if the profile has them, GL_PER_STAGE_CONSTANTS_NV and GL_TEXTURE_SHADER_NV.
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

// NV_register_combiners2; the four values as stored, clamped.
void glGetCombinerStageParameterfvNV(GLenum stage, GLenum pname, GLfloat* params);

}  // namespace gl
}  // namespace ninebit

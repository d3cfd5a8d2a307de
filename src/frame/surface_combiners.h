// The register-combiner programs of textured and masked surfaces.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_nv.h"
#include "ninebit/numerics/result.h"

namespace ninebit {

// The colour that a surface program returns.
enum class SurfaceColor : std::uint8_t {
  primary_times_texture,  // primary × texture0, for the colour passes
  primary                 // for passes that draw an index, or no colour
};

// One general combiner: spare0 = the colour, spare0.alpha = texture0.alpha × alpha / 255. The final combiner passes
// spare0 on. Reports a profile that refuses the set-up.
[[nodiscard]] Result<CombinerState> surface_state(const HardwareProfile& profile, SurfaceColor color,
                                                  std::uint8_t alpha);
[[nodiscard]] Result<Program> surface_program(const HardwareProfile& profile, SurfaceColor color, std::uint8_t alpha);

// Helpers for the techniques' register-combiner set-ups: GL calls in, a state out.

// The state after the GL calls that `set` makes, with the register combiners enabled. Reports a call that the profile
// refuses; `what` names the set-up.
template <class SetUp>
Result<CombinerState> combiner_state_after(const HardwareProfile& profile, std::string_view what, const SetUp& set) {
  gl::Context context(profile);
  const gl::CurrentContext current(context);
  set();
  gl::glEnable(gl::GL_REGISTER_COMBINERS_NV);
  if (context.error() != GlError::no_error) {
    return Diagnostic{.message = "profile " + std::string(profile.name) + " refuses the " + std::string(what) + ": " +
                                 std::string(name_of(context.error()))};
  }
  if (!context.register_combiners_enabled()) {
    return Diagnostic{.message = "the register combiners of the " + std::string(what) + " are not enabled"};
  }
  return context.state();
}

// Discards all outputs of one portion of a stage.
inline void discard_portion(gl::GLenum stage, gl::GLenum portion) {
  using namespace gl;
  glCombinerOutputNV(stage, portion, GL_DISCARD_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, GL_FALSE, GL_FALSE,
                     GL_FALSE);
}

}  // namespace ninebit

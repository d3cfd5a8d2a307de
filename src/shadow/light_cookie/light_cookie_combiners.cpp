// The register-combiner set-up of the lit pass, made with the GL-named entry points.
#include <array>

#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_nv.h"
#include "ninebit/shadow/light_cookie.h"
#include "src/frame/camera_frame.h"
#include "src/frame/combiner_setup.h"

namespace ninebit {
namespace {

// Scaling a rounded register by 6 would multiply its rounding error. So the last stage computes the product again at
// full precision, and takes only the smaller summand of 6 = 4 + 2 from a register: 4 (product + spare0 / 8), with
// spare0 = 4 · product. A register holds at most 1; where spare0 is clamped to 1, the result is 1 anyway.
constexpr float kEighth = 32.0F / 255.0F;

// If narrowing drops fractions, stage 0 adds (8/255)². Times 4 this is one code, and half a code after the eighth and
// the scale of stage 1, so the result is rounded instead of truncated.
constexpr float kRounding = 8.0F / 255.0F;

Result<CombinerState> cookie_state(const HardwareProfile& profile, bool textured) {
  using namespace gl;
  return combiner_state_after(profile, "two stages of light-cookie", [&profile, textured] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
    const float rounding = profile.general_narrowing.value == Narrowing::toward_zero ? kRounding : 0.0F;
    const std::array<GLfloat, 4> constant0{kEighth, kEighth, kEighth, 0.0F};
    const std::array<GLfloat, 4> constant1{rounding, rounding, rounding, 0.0F};
    glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, constant0.data());
    glCombinerParameterfvNV(GL_CONSTANT_COLOR1_NV, constant1.data());

    // Stage 0, RGB: spare0 = 4 (primary · texture0 + constant1 · constant1).
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_C_NV, GL_CONSTANT_COLOR1_NV, GL_UNSIGNED_IDENTITY_NV,
                      GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_D_NV, GL_CONSTANT_COLOR1_NV, GL_UNSIGNED_IDENTITY_NV,
                      GL_RGB);
    glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_SCALE_BY_FOUR_NV,
                       GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE);
    discard_portion(GL_COMBINER0_NV, GL_ALPHA);

    // Stage 1, RGB: spare0 = 4 (primary · texture0 + spare0 · constant0).
    glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_B_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_C_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_D_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV,
                      GL_RGB);
    glCombinerOutputNV(GL_COMBINER1_NV, GL_RGB, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_SCALE_BY_FOUR_NV,
                       GL_NONE, GL_FALSE, GL_FALSE, GL_FALSE);
    discard_portion(GL_COMBINER1_NV, GL_ALPHA);

    // Final combiner, alpha = 1: RGB = spare0 · 1 + secondary, or texture1 · (spare0 + secondary).
    glFinalCombinerInputNV(GL_VARIABLE_A_NV, textured ? GL_TEXTURE1_ARB : GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV,
                           GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_B_NV, textured ? GL_SPARE0_PLUS_SECONDARY_COLOR_NV : GL_ZERO,
                           textured ? GL_UNSIGNED_IDENTITY_NV : GL_UNSIGNED_INVERT_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_D_NV, textured ? GL_ZERO : GL_SECONDARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV,
                           GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_G_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
  });
}

Result<PipelineState> pass_with(const RenderSettings& settings, const Result<CombinerState>& state) {
  if (!state) return state.error();
  const auto program = compile(*state, settings.profile);
  if (!program) return program.error();
  PipelineState pass = frame_passes(settings).lit;
  pass.program = *program;
  return pass;
}

}  // namespace

Result<CombinerState> light_cookie_state(const HardwareProfile& profile) {
  return cookie_state(profile, false);
}

Result<CombinerState> light_cookie_textured_state(const HardwareProfile& profile) {
  return cookie_state(profile, true);
}

Result<PipelineState> light_cookie_pass(const RenderSettings& settings) {
  return pass_with(settings, light_cookie_state(settings.profile));
}

Result<PipelineState> light_cookie_textured_pass(const RenderSettings& settings) {
  return pass_with(settings, light_cookie_textured_state(settings.profile));
}

}  // namespace ninebit

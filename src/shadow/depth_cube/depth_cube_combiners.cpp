// The register-combiner set-ups of the depth cube, made with the GL-named entry points.
#include "ninebit/language/gl_nv.h"
#include "ninebit/shadow/depth_cube.h"
#include "src/frame/combiner_setup.h"

namespace ninebit {
namespace {

using namespace gl;

// spare0 = texture0 · 1 + texture1 · (-1), of the portion's own components.
void subtract_textures(GLenum stage, GLenum portion) {
  glCombinerInputNV(stage, portion, GL_VARIABLE_A_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, portion);
  glCombinerInputNV(stage, portion, GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, portion);
  glCombinerInputNV(stage, portion, GL_VARIABLE_C_NV, GL_TEXTURE1_ARB, GL_UNSIGNED_IDENTITY_NV, portion);
  glCombinerInputNV(stage, portion, GL_VARIABLE_D_NV, GL_ZERO, GL_EXPAND_NORMAL_NV, portion);
  glCombinerOutputNV(stage, portion, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_NONE, GL_NONE, GL_FALSE, GL_FALSE,
                     GL_FALSE);
}

// RGB = D, alpha = G. A negative alpha is clamped to 0.
void final_combiner(GLenum d, GLenum g, GLenum g_usage) {
  for (const GLenum variable : {GL_VARIABLE_A_NV, GL_VARIABLE_B_NV, GL_VARIABLE_C_NV}) {
    glFinalCombinerInputNV(variable, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  }
  glFinalCombinerInputNV(GL_VARIABLE_D_NV, d, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glFinalCombinerInputNV(GL_VARIABLE_G_NV, g, GL_UNSIGNED_IDENTITY_NV, g_usage);
}

}  // namespace

Result<CombinerState> ramp_copy_state(const HardwareProfile& profile) {
  return combiner_state_after(profile, "copy of the ramp", [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
    discard_portion(GL_COMBINER0_NV, GL_RGB);
    discard_portion(GL_COMBINER0_NV, GL_ALPHA);
    final_combiner(GL_TEXTURE0_ARB, GL_TEXTURE0_ARB, GL_ALPHA);
  });
}

Result<CombinerState> luminance_above_state(const HardwareProfile& profile) {
  return combiner_state_after(profile, "comparison of luminances", [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
    subtract_textures(GL_COMBINER0_NV, GL_RGB);
    discard_portion(GL_COMBINER0_NV, GL_ALPHA);
    final_combiner(GL_ZERO, GL_SPARE0_NV, GL_BLUE);
  });
}

Result<CombinerState> high_byte_above_state(const HardwareProfile& profile) {
  return combiner_state_after(profile, "comparison of high bytes", [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
    discard_portion(GL_COMBINER0_NV, GL_RGB);
    subtract_textures(GL_COMBINER0_NV, GL_ALPHA);
    final_combiner(GL_ZERO, GL_SPARE0_NV, GL_ALPHA);
  });
}

Result<CombinerState> low_byte_above_state(const HardwareProfile& profile) {
  return combiner_state_after(profile, "comparison of low bytes", [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);

    // Stage 0, RGB: the difference of the low bytes. Alpha: texture1 · 1 + (1 - texture0) · 1 - 1/2, which is one half
    // or more exactly if texture 1 has the larger high byte: the sum is 255 where they are equal, and 255 - 128 is 127.
    subtract_textures(GL_COMBINER0_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_TEXTURE1_ARB, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_C_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
    glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_NONE,
                       GL_BIAS_BY_NEGATIVE_ONE_HALF_NV, GL_FALSE, GL_FALSE, GL_FALSE);

    // Stage 1, alpha: 0 if the mux finds one half or more, otherwise the difference of the low bytes.
    discard_portion(GL_COMBINER1_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_SPARE0_NV, GL_SIGNED_IDENTITY_NV, GL_BLUE);
    glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerOutputNV(GL_COMBINER1_NV, GL_ALPHA, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, GL_NONE, GL_NONE,
                       GL_FALSE, GL_FALSE, GL_TRUE);

    final_combiner(GL_ZERO, GL_SPARE0_NV, GL_ALPHA);
  });
}

}  // namespace ninebit

#include "src/frame/surface_combiners.h"

#include <array>

#include "ninebit/language/gl_nv.h"

namespace ninebit {

Result<CombinerState> surface_state(const HardwareProfile& profile, SurfaceColor color, std::uint8_t alpha) {
  using namespace gl;
  return combiner_state_after(profile, "surface's texture", [color, alpha] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);
    const std::array<GLfloat, 4> constant0{0.0F, 0.0F, 0.0F, static_cast<GLfloat>(alpha) / 255.0F};
    glCombinerParameterfvNV(GL_CONSTANT_COLOR0_NV, constant0.data());

    // Stage 0, RGB: spare0 = primary · texture0, or primary · 1.
    const bool textured = color == SurfaceColor::primary_times_texture;
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_B_NV, textured ? GL_TEXTURE0_ARB : GL_ZERO,
                      textured ? GL_UNSIGNED_IDENTITY_NV : GL_UNSIGNED_INVERT_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerInputNV(GL_COMBINER0_NV, GL_RGB, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glCombinerOutputNV(GL_COMBINER0_NV, GL_RGB, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, GL_FALSE,
                       GL_FALSE, GL_FALSE);

    // Stage 0, alpha: spare0 = texture0 · constant0.
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_B_NV, GL_CONSTANT_COLOR0_NV, GL_UNSIGNED_IDENTITY_NV,
                      GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE,
                       GL_FALSE, GL_FALSE, GL_FALSE);

    // Final combiner: RGB = spare0, alpha = spare0.alpha.
    glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_G_NV, GL_SPARE0_NV, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
  });
}

Result<Program> surface_program(const HardwareProfile& profile, SurfaceColor color, std::uint8_t alpha) {
  const auto state = surface_state(profile, color, alpha);
  if (!state) return state.error();
  return compile(*state, profile);
}

}  // namespace ninebit

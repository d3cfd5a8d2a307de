// The register combiners of the shadow map's comparison.
#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_nv.h"
#include "ninebit/shadow/shadow_map.h"
#include "src/frame/camera_frame.h"
#include "src/frame/combiner_setup.h"

namespace ninebit {

Result<CombinerState> shadow_map_comparison_state(const HardwareProfile& profile) {
  using namespace gl;
  return combiner_state_after(profile, "shadow map's comparison", [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);

    // Stage 0, alpha: spare0 = texture0 · texture1, 1 if the fragment is lit and inside the beam.
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_B_NV, GL_TEXTURE1_ARB, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE,
                       GL_FALSE, GL_FALSE, GL_FALSE);
    discard_portion(GL_COMBINER0_NV, GL_RGB);

    // Final combiner: RGB 0, alpha = 1 - spare0.alpha: the alpha test lets the fragments in shadow through.
    glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_G_NV, GL_SPARE0_NV, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
  });
}

Result<ShadowMapPasses> shadow_map_passes(const RenderSettings& settings) {
  const auto state = shadow_map_comparison_state(settings.profile);
  if (!state) return state.error();
  const auto program = compile(*state, settings.profile);
  if (!program) return program.error();
  const PipelineState depth = frame_passes(settings).depth, marking = marking_pass(settings);
  ShadowMapPasses passes{depth, marking, surface_pass(settings), marking};
  const OffsetArguments offset = settings.shadow_map.polygon_offset.value_or(kShadowMapOffset);
  passes.map.polygon_offset = {.fill = true, .factor = offset.factor, .units = offset.units};
  passes.comparison.program = *program;
  passes.comparison.alpha_test = {.enabled = true, .function = CompareFunction::greater, .reference = 0};
  return passes;
}

}  // namespace ninebit

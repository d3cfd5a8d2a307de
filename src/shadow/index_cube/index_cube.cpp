// The technique's entry point: renders one frame.
#include "ninebit/shadow/index_cube.h"

#include <optional>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_nv.h"
#include "src/frame/camera_frame.h"
#include "src/frame/drawn_passes.h"
#include "src/frame/shading.h"
#include "src/shadow/index_cube/index_cube_renderer.h"

namespace ninebit {

Result<Rendering> render_index_cube(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  std::optional<IndexCubeRenderer> renderer;
  PassTimer timer(progress);
  PassTimes times;
  double camera = 0.0;
  Status status =
      timer.make("indices", 0.0, times.transform, renderer, [&] { return IndexCubeRenderer::make(scene, settings); });
  if (status) status = timer.run("index cube map", 0.1, times.maps, [&] { return renderer->draw_maps(); });
  if (status) renderer->find_vanished();
  if (status) status = timer.run("camera's passes", 0.5, camera, [&] { return renderer->draw_camera(); });
  if (status) status = renderer->add_evidence();
  if (status) status = renderer->finish();
  if (!status) return status.error();
  renderer->rendering().times.transform = times.transform;
  renderer->rendering().times.maps = times.maps;
  return std::move(renderer->rendering());
}

Result<IndexCubePasses> index_cube_passes(const RenderSettings& settings) {
  const auto state = index_comparison_state(settings.profile, settings.index.format, settings.index.scales);
  if (!state) return state.error();
  const auto program = compile(*state, settings.profile);
  if (!program) return program.error();
  FramePasses frame = frame_passes(settings);
  IndexCubePasses passes{.map = frame.depth,
                         .depth = frame.depth,
                         .comparison = marking_pass(settings),
                         .averted = marking_pass(settings),
                         .lit = frame.lit,
                         .shadow = frame.shadow,
                         .selection = frame.lit};
  passes.map.shade_model = ShadeModel::flat;
  passes.map.color_mask = {true, true, true, true};

  passes.comparison.program = *program;
  passes.comparison.alpha_test = {.enabled = true, .function = CompareFunction::greater, .reference = 0};

  passes.selection.shade_model = ShadeModel::flat;
  passes.selection.stencil_test = {};
  if (settings.pick) passes.selection.scissor = PixelRect{settings.pick->x, settings.pick->y, 1, 1};
  return passes;
}

namespace {

using namespace gl;

// The scales of the differences and of the sum of their squares.
struct StageScales {
  GLenum first, second;
};

StageScales stage_scales(IndexScales scales) {
  const bool first = scales == IndexScales::both || scales == IndexScales::first;
  const bool second = scales == IndexScales::both || scales == IndexScales::second;
  return {first ? GL_SCALE_BY_FOUR_NV : GL_NONE, second ? GL_SCALE_BY_FOUR_NV : GL_NONE};
}

// In one portion: spare0 = scale (primary · 1 + texture0 · -1), from the given component.
void set_difference(GLenum portion, GLenum component, GLenum scale) {
  const GLenum stage = GL_COMBINER0_NV;
  glCombinerInputNV(stage, portion, GL_VARIABLE_A_NV, GL_PRIMARY_COLOR_NV, GL_UNSIGNED_IDENTITY_NV, component);
  glCombinerInputNV(stage, portion, GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_INVERT_NV, portion);
  glCombinerInputNV(stage, portion, GL_VARIABLE_C_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, component);
  glCombinerInputNV(stage, portion, GL_VARIABLE_D_NV, GL_ZERO, GL_EXPAND_NORMAL_NV, portion);
  glCombinerOutputNV(stage, portion, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE0_NV, scale, GL_NONE, GL_FALSE, GL_FALSE,
                     GL_FALSE);
}

// RGB: spare0 = the differences of red, green and blue; spare1 = scale (spare0 · spare0), positive if any channel
// differs. Returns the component that holds the result.
GLenum compare_rgb(StageScales scale) {
  set_difference(GL_RGB, GL_RGB, scale.first);
  discard_portion(GL_COMBINER0_NV, GL_ALPHA);
  glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_A_NV, GL_SPARE0_NV, GL_SIGNED_IDENTITY_NV, GL_RGB);
  glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_B_NV, GL_SPARE0_NV, GL_SIGNED_IDENTITY_NV, GL_RGB);
  glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glCombinerInputNV(GL_COMBINER1_NV, GL_RGB, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
  glCombinerOutputNV(GL_COMBINER1_NV, GL_RGB, GL_SPARE1_NV, GL_DISCARD_NV, GL_DISCARD_NV, scale.second, GL_NONE,
                     GL_TRUE, GL_FALSE, GL_FALSE);
  discard_portion(GL_COMBINER1_NV, GL_ALPHA);
  return GL_BLUE;
}

// Stage 1's alpha portion: spare1.alpha = scale (spare0.alpha² + spare0.blue²), or without the blue term.
GLenum square_differences(bool with_blue, GLenum scale) {
  discard_portion(GL_COMBINER1_NV, GL_RGB);
  glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_SPARE0_NV, GL_SIGNED_IDENTITY_NV, GL_ALPHA);
  glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_B_NV, GL_SPARE0_NV, GL_SIGNED_IDENTITY_NV, GL_ALPHA);
  const GLenum other = with_blue ? GL_SPARE0_NV : GL_ZERO;
  const GLenum component = with_blue ? GL_BLUE : GL_ALPHA;
  glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_C_NV, other, GL_SIGNED_IDENTITY_NV, component);
  glCombinerInputNV(GL_COMBINER1_NV, GL_ALPHA, GL_VARIABLE_D_NV, other, GL_SIGNED_IDENTITY_NV, component);
  glCombinerOutputNV(GL_COMBINER1_NV, GL_ALPHA, GL_DISCARD_NV, GL_DISCARD_NV, GL_SPARE1_NV, scale, GL_NONE, GL_FALSE,
                     GL_FALSE, GL_FALSE);
  return GL_ALPHA;
}

// Both differences at once: luminance in the RGB portion, alpha in the alpha portion.
GLenum compare_luminance_alpha(StageScales scale) {
  set_difference(GL_RGB, GL_RGB, scale.first);
  set_difference(GL_ALPHA, GL_ALPHA, scale.first);
  return square_differences(true, scale.second);
}

// One channel needs only the alpha portion, which can read blue (a luminance is in blue) or alpha. The article's dot
// product would sum the square three times.
GLenum compare_one_channel(GLenum component, StageScales scale) {
  discard_portion(GL_COMBINER0_NV, GL_RGB);
  set_difference(GL_ALPHA, component, scale.first);
  return square_differences(false, scale.second);
}

GLenum compare_in(IndexFormat format, StageScales scale) {
  switch (format) {
    case IndexFormat::rgb:
      return compare_rgb(scale);
    case IndexFormat::luminance_alpha:
      return compare_luminance_alpha(scale);
    case IndexFormat::luminance:
      return compare_one_channel(GL_BLUE, scale);
    case IndexFormat::alpha:
      break;
  }
  return compare_one_channel(GL_ALPHA, scale);
}

}  // namespace

Result<CombinerState> index_comparison_state(const HardwareProfile& profile, IndexFormat format, IndexScales scales) {
  return combiner_state_after(profile, "two-stage index comparison", [format, scales] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 2);
    const GLenum result = compare_in(format, stage_scales(scales));

    // RGB 0, alpha = spare1's result. E and F keep their defaults: nothing reads E·F.
    for (const GLenum variable : {GL_VARIABLE_A_NV, GL_VARIABLE_B_NV, GL_VARIABLE_C_NV, GL_VARIABLE_D_NV}) {
      glFinalCombinerInputNV(variable, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    }
    glFinalCombinerInputNV(GL_VARIABLE_G_NV, GL_SPARE1_NV, GL_UNSIGNED_IDENTITY_NV, result);
  });
}

}  // namespace ninebit

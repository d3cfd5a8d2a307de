// The article's passes as pipeline states.
#include "ninebit/combiner/program.h"
#include "ninebit/shadow/index_cube.h"
#include "src/frame/camera_frame.h"

namespace ninebit {

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

}  // namespace ninebit

// The article's passes as pipeline states.
#include "ninebit/combiner/program.h"
#include "ninebit/shadow/index_cube.h"

namespace ninebit {

Result<IndexCubePasses> index_cube_passes(const RenderSettings& settings) {
  const auto state = index_comparison_state(settings.profile);
  if (!state) return state.error();
  const auto program = compile(*state, settings.profile);
  if (!program) return program.error();
  PipelineState base;
  base.profile = settings.profile;
  base.cull_face = settings.cull_face;
  constexpr DepthTest write_nearest{.enabled = true, .function = CompareFunction::less, .write = true};
  // The camera's passes transform and interpolate alike, so a polygon meets the very depth that it wrote.
  constexpr DepthTest same_surface{.enabled = true, .function = CompareFunction::equal, .write = false};
  constexpr std::array<bool, 4> no_color{false, false, false, false};

  IndexCubePasses passes{base, base, base, base, base, base};
  passes.map.shade_model = ShadeModel::flat;
  passes.map.depth_test = write_nearest;

  passes.depth.color_mask = no_color;
  passes.depth.depth_test = write_nearest;

  passes.averted.shade_model = ShadeModel::flat;
  passes.averted.color_mask = no_color;
  passes.averted.depth_test = same_surface;
  passes.averted.stencil_test = {.enabled = true, .front = {.reference = 1, .depth_pass = StencilOperation::replace}};

  passes.comparison = passes.averted;
  passes.comparison.program = *program;
  passes.comparison.alpha_test = {.enabled = true, .function = CompareFunction::greater, .reference = 0};

  for (PipelineState* pass : {&passes.lit, &passes.shadow}) {
    pass->depth_test = same_surface;
    pass->stencil_test = {.enabled = true, .front = {.function = CompareFunction::equal}};
  }
  passes.lit.stencil_test.front.reference = 0;
  passes.shadow.stencil_test.front.reference = 1;
  return passes;
}

}  // namespace ninebit

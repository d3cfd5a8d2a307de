#include "src/raster/fragment/fragment_operations.h"

#include "src/raster/fragment/blend.h"

namespace ninebit {

FragmentOperations::FragmentOperations(const PipelineState& state, const RenderTarget& target, bool reject_early)
    : target_(target),
      alpha_function_(state.alpha_test.function),
      depth_function_(state.depth_test.function),
      alpha_reference_(state.alpha_test.reference),
      alpha_enabled_(state.alpha_test.enabled && alpha_function_ != CompareFunction::always),
      stencil_enabled_(state.stencil_test.enabled && stencil_bits(target.format) > 0 && target.stencil),
      depth_enabled_(state.depth_test.enabled && target.depth),
      depth_write_(depth_enabled_ && state.depth_test.write),
      writes_color_(false),
      blends_(state.blend.enabled && !replaces(state.blend)),
      cuts_coverage_(state.profile.coverage_narrowing.value == Narrowing::toward_zero),
      early_stencil_(false),
      early_depth_front_(false),
      early_depth_back_(false),
      color_mask_(state.color_mask),
      blend_(state.blend),
      store_(target.color_format),
      reads_(target.color_format, state.profile.surface_blend) {
  for (std::size_t i = 0; i < 4; ++i) {
    color_mask_[i] = color_mask_[i] && target.color[i];
    writes_color_ = writes_color_ || color_mask_[i];
  }
  if (stencil_enabled_) {
    const StencilTest& test = state.stencil_test;
    front_ = StencilSide(test.front, stencil_bits(target.format));
    back_ = StencilSide(test.back.value_or(test.front), stencil_bits(target.format));
  }
  if (!reject_early) return;
  // Planes written at depth pass ignore the alpha and stencil tests.
  bool asks_depth_alone = false;
  for (const OutputPlane& output : target.outputs) {
    const bool holds = std::visit([](const auto& plane) { return static_cast<bool>(plane); }, output.plane);
    asks_depth_alone = asks_depth_alone || (holds && output.time == OutputTime::at_depth_pass);
  }
  // While no fragment of the draw, of either facing, changes a stencil value, the test's outcome cannot change under a
  // waiting batch.
  early_stencil_ = stencil_enabled_ && front_.changes_nothing() && back_.changes_nothing() && !asks_depth_alone;
  // A depth that a waiting fragment will write can only make the same test harder, except for NOTEQUAL. A fragment
  // that fails it leaves a trace where the operations of its own facing change the stencil. Blending reads only
  // the colours of drawn fragments, which a lost one is not.
  const bool early_depth = depth_enabled_ && !(depth_write_ && depth_function_ == CompareFunction::notequal);
  early_depth_front_ = early_depth && (!stencil_enabled_ || front_.failing_changes_nothing());
  early_depth_back_ = early_depth && (!stencil_enabled_ || back_.failing_changes_nothing());
}

void FragmentOperations::write_blended(const UncoloredFragment& f, const ColorBytes& color) const {
  ColorBytes there{0, 0, 0, 255};
  for (std::size_t i = 0; i < 4; ++i) {
    if (target_.color[i]) there[i] = target_.color[i].at(f.x, f.y);
  }
  write(f, blend(blend_, reads_.source(color), reads_.destination(there)));
}

}  // namespace ninebit

#include "src/raster/fragment_operations.h"

#include <algorithm>

namespace ninebit {
namespace {

std::uint8_t stencil_result(StencilOperation operation, std::uint8_t stored, std::uint8_t reference) {
  switch (operation) {
    case StencilOperation::keep:
      return stored;
    case StencilOperation::zero:
      return 0;
    case StencilOperation::replace:
      return reference;
    case StencilOperation::incr:
      return stored == 0xFF ? stored : static_cast<std::uint8_t>(stored + 1);
    case StencilOperation::decr:
      return stored == 0 ? stored : static_cast<std::uint8_t>(stored - 1);
    case StencilOperation::invert:
      return static_cast<std::uint8_t>(~stored);
    case StencilOperation::incr_wrap:
      return static_cast<std::uint8_t>(stored + 1);
    case StencilOperation::decr_wrap:
      return static_cast<std::uint8_t>(stored - 1);
  }
  return stored;
}

// The operation for every stored value, with the write mask applied: masked bits keep their old value.
std::array<std::uint8_t, 256> stencil_table(StencilOperation operation, const StencilTest& test) {
  std::array<std::uint8_t, 256> table{};
  for (unsigned stored = 0; stored < 256; ++stored) {
    const unsigned result = stencil_result(operation, static_cast<std::uint8_t>(stored), test.reference);
    const unsigned mask = test.write_mask;
    table[stored] = static_cast<std::uint8_t>((stored & ~mask) | (result & mask));
  }
  return table;
}

}  // namespace

FragmentOperations::FragmentOperations(const PipelineState& state, const RenderTarget& target)
    : target_(target),
      alpha_function_(state.alpha_test.enabled ? state.alpha_test.function : CompareFunction::always),
      alpha_reference_(state.alpha_test.reference),
      stencil_enabled_(state.stencil_test.enabled && target.stencil),
      stencil_function_(state.stencil_test.function),
      stencil_reference_(state.stencil_test.reference & state.stencil_test.mask),
      stencil_mask_(state.stencil_test.mask),
      stencil_fail_(stencil_table(state.stencil_test.fail, state.stencil_test)),
      stencil_depth_fail_(stencil_table(state.stencil_test.depth_fail, state.stencil_test)),
      stencil_depth_pass_(stencil_table(state.stencil_test.depth_pass, state.stencil_test)),
      depth_enabled_(state.depth_test.enabled && target.depth_z24),
      depth_function_(state.depth_test.function),
      depth_write_(depth_enabled_ && state.depth_test.write),
      color_mask_(state.color_mask),
      writes_color_(false) {
  for (std::size_t i = 0; i < 4; ++i) {
    color_mask_[i] = color_mask_[i] && target.color[i];
    writes_color_ = writes_color_ || color_mask_[i];
  }
  const auto keeps = [&](StencilOperation op) {
    return op == StencilOperation::keep || state.stencil_test.write_mask == 0;
  };
  const bool fail_leaves_no_trace =
      !stencil_enabled_ || (keeps(state.stencil_test.fail) && keeps(state.stencil_test.depth_fail));
  // While the draw writes no stencil, the test's outcome cannot change under a waiting batch. Captures do not ask it.
  early_stencil_ =
      stencil_enabled_ && fail_leaves_no_trace && keeps(state.stencil_test.depth_pass) && target.captures.empty();
  // A depth that a waiting fragment will write can only make the same test harder, except for NOTEQUAL.
  early_depth_ =
      depth_enabled_ && fail_leaves_no_trace && !(depth_write_ && depth_function_ == CompareFunction::notequal);
}

}  // namespace ninebit

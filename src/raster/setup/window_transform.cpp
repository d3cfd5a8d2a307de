#include "src/raster/setup/window_transform.h"

#include <algorithm>

namespace ninebit {
namespace {

float guard_factor(int size) {
  return static_cast<float>(kMaxSurfaceSize) / static_cast<float>(size);
}

double unit(float depth) {
  return std::clamp(static_cast<double>(depth), 0.0, 1.0);
}

}  // namespace

WindowTransform::WindowTransform(const PipelineState& state, const PixelRect& viewport, DepthStencilFormat format,
                                 const SampleShift& shift)
    : scale_{.guard_x = guard_factor(viewport.width),
             .guard_y = guard_factor(viewport.height),
             .half_width = static_cast<float>(viewport.width) * 0.5F,
             .half_height = static_cast<float>(viewport.height) * 0.5F,
             .centre_x = static_cast<float>(viewport.x) + static_cast<float>(viewport.width) * 0.5F,
             .centre_y = static_cast<float>(viewport.y) + static_cast<float>(viewport.height) * 0.5F,
             .steps = static_cast<float>(1 << state.profile.subpixel_bits),
             .to_q4_bits = 4 - state.profile.subpixel_bits,
             .shift = shift,
             .depth_half = (unit(state.depth_far) - unit(state.depth_near)) * 0.5,
             .depth_middle = (unit(state.depth_near) + unit(state.depth_far)) * 0.5},
      depth_(format, state.profile.depth_narrowing, state.float_depth_one) {}

}  // namespace ninebit

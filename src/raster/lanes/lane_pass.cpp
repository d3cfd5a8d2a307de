#include "src/raster/lanes/lane_pass.h"

namespace ninebit {

LanePass::LanePass(const DrawContext& draw, const RenderTarget& target)
    : context(draw),
      operations(draw.state, target, draw.stages && draw.stages->replaces_depth()),
      depths_are_codes(!draw.state.polygon_offset.fill && !draw.depth.is_real() && draw.depth.step_z24() == 1) {
  if (draw.has_flat_result) return;
  batch = std::make_unique<LaneBatch>();
  if (draw.stages) batch->stages = std::make_unique<FragmentStages>(draw);
}

}  // namespace ninebit

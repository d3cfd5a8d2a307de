#include "src/raster/lanes/lane_pass.h"

#include "src/raster/fragment/stipple.h"

namespace ninebit {
namespace {

std::unique_ptr<TileWords> stipple_of_tile(const StipplePattern& pattern) {
  static_assert(kTileSize % 32 == 0);
  auto words = std::make_unique<TileWords>();
  for (std::size_t i = 0; i < kTilePixels; ++i) {
    const auto place = static_cast<int>(i);
    (*words)[i] = has_pixel(pattern, place % kTileSize, place / kTileSize) ? 0xFFFFFFFF : 0;
  }
  return words;
}

}  // namespace

LanePass::LanePass(const DrawContext& draw, const RenderTarget& target)
    : context(draw),
      operations(draw.state, target, draw.stages && draw.stages->replaces_depth()),
      depths_are_codes(draw.depth.is_real() || (!draw.state.polygon_offset.fill && draw.depth.step_z24() == 1)),
      corners_are_codes(depths_are_codes && !draw.depth.is_real()) {
  if (operations.stipples) stipple = stipple_of_tile(*draw.state.polygon_stipple);
  if (draw.has_flat_result) return;
  batch = std::make_unique<LaneBatch>();
  if (draw.stages) batch->stages = std::make_unique<FragmentStages>(draw);
}

}  // namespace ninebit

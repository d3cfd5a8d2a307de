// One pixel drawn beside the draw itself, fragment by fragment, for FragmentProbe.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "ninebit/raster/fragment_probe.h"
#include "src/raster/fragment_batch.h"
#include "src/raster/tile.h"

namespace ninebit {

// Draws into planes of its own, of one sample each, so that the draw itself need not know of it: batches gather
// fragments and drop those that no test can let through, which could not be told truthfully from there.
class PixelProbe {
 public:
  PixelProbe(const DrawContext& draw, FragmentProbe& probe);
  PixelProbe(const PixelProbe&) = delete;
  PixelProbe& operator=(const PixelProbe&) = delete;

  [[nodiscard]] bool lies_in(const TileRect& tile) const {
    return probe_.x >= tile.left && probe_.x < tile.right && probe_.y >= tile.bottom && probe_.y < tile.top;
  }

  // Takes over what stands in the target's planes at the pixel: to be called before triangles are drawn there.
  void meet_planes();

  // Reports the fragments of triangles of one block, in the order of `indices`.
  void run(const SetupBlock& block, std::span<const std::uint32_t> indices);

 private:
  RenderTarget planes_of_one();

  const RenderTarget& real_;
  FragmentProbe& probe_;
  std::array<std::uint8_t, 4> color_{};
  std::uint32_t depth_z24_ = 0, primitive_ = 0;
  std::uint8_t stencil_ = 0;
  RenderTarget target_;
  FragmentOperations operations_;
  DrawContext context_;
  FragmentBatch batch_;
};

}  // namespace ninebit

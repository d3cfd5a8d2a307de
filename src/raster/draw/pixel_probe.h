// Draws one pixel separately from the draw itself, fragment by fragment, for FragmentProbe.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "ninebit/raster/fragment_probe.h"
#include "src/raster/draw/tile.h"
#include "src/raster/fragment/draw_context.h"
#include "src/raster/fragment/fragment_batch.h"

namespace ninebit {

// Draws into its own planes, one row of samples that stands for every row, independently of the draw itself: batches
// gather fragments and drop those that cannot pass the tests, so they could not report every fragment.
class PixelProbe {
 public:
  // The arguments must outlive the probe.
  PixelProbe(const PipelineState& state, const VertexArrays& arrays, std::span<const TextureUnit> units,
             const RenderTarget& target, FragmentProbe& probe);
  PixelProbe(const PixelProbe&) = delete;
  PixelProbe& operator=(const PixelProbe&) = delete;

  [[nodiscard]] bool lies_in(const PixelBox& pixels) const {
    return probe_.x >= pixels.left && probe_.x < pixels.right && probe_.y >= pixels.bottom && probe_.y < pixels.top;
  }

  // Copies the values of the target's planes at the pixel; call it before anything is drawn there.
  void meet_planes();

  // Reports the fragments of primitives of one block, in the order of `indices`.
  void run(const SetupBlock& block, std::span<const std::uint32_t> indices);

 private:
  RenderTarget planes_of_one_row();

  const RenderTarget& real_;
  FragmentProbe& probe_;
  std::array<std::vector<std::uint8_t>, 4> color_;
  std::vector<std::uint32_t> depth_;
  std::vector<std::uint8_t> stencil_;
  const RenderTarget target_;
  const DrawContext context_;
  FragmentBatch batch_;
};

// One for each of the target's probes. The arguments must outlive them.
[[nodiscard]] std::deque<PixelProbe> pixel_probes(const PipelineState& state, const VertexArrays& arrays,
                                                  std::span<const TextureUnit> units, const RenderTarget& target);

}  // namespace ninebit

// Records the combiners of a pass: what goes in and what comes out at each pixel.
#pragma once

#include <optional>
#include <span>

#include "ninebit/effect/effect_renderer.h"
#include "ninebit/raster/rasterizer.h"

namespace ninebit {

// A draw of a pass into a target that it has not changed yet.
struct RecordedDraw {
  const PipelineState& state;  // with a program
  const glm::mat4& projection;
  const VertexArrays& arrays;
  std::span<const TextureUnit> units;
  const std::optional<ClearValues>& clear;  // before the draw
};

// Draws the pass twice on a copy of the target's depth and stencil. Reports what rasterize() reports.
[[nodiscard]] Result<CombinerRecord> record_combiners(const RecordedDraw& draw, const RenderTarget& target);

}  // namespace ninebit

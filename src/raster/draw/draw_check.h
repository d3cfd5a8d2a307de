// What every kind of draw call begins with.
#pragma once

#include <span>

#include "ninebit/numerics/result.h"
#include "ninebit/raster/rasterizer.h"
#include "src/raster/fragment/draw_context.h"
#include "src/raster/setup/window_transform.h"

namespace ninebit {

// The viewport, or the whole target.
[[nodiscard]] PixelRect viewport_of(const PipelineState& state, const RenderTarget& target);
// The target's pixels within viewport and scissor.
[[nodiscard]] PixelBox drawn_pixels(const PipelineState& state, const RenderTarget& target);

// Reports what can be wrong with a draw call, but for what check_indices and check_units look at.
[[nodiscard]] Status check_draw(const PipelineState& state, const VertexArrays& arrays,
                                std::span<const TextureUnit> units, const RenderTarget& target);

// Reports units that are on and have no texture coordinates.
[[nodiscard]] Status check_units(const DrawContext& context);

}  // namespace ninebit

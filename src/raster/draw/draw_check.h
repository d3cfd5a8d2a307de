// Checks of a draw call, and the pixels that it may draw.
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

// Reports errors in a draw call, except those that check_indices and check_units report.
[[nodiscard]] Status check_call(const PipelineState& state, const VertexArrays& arrays,
                                std::span<const TextureUnit> units, const RenderTarget& target);

// Reports units that are on and have no texture coordinates.
[[nodiscard]] Status check_units(const DrawContext& context);

// Whether the matrix gives all vertices the same w.
[[nodiscard]] bool has_one_w(const glm::mat4& clip_from_object, const VertexArrays& arrays);
// Reports a depth test in a W buffer of such vertices.
[[nodiscard]] Status check_w(const PipelineState& state, bool one_w, const RenderTarget& target);

}  // namespace ninebit

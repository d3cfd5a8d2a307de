// Checks a target and the values of a state that the fragment operations read.
#pragma once

#include "ninebit/numerics/result.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/surface.h"

namespace ninebit {

// Reports sizes out of range, planes that the state's enabled tests need but the target does not have, rows that
// overlap, scissors of negative size, blending into a format that the chip does not blend into, output planes with an
// invalid source, a component, register or attribute out of range, or samples that cannot hold their source.
[[nodiscard]] Status check_target(const PipelineState& state, const RenderTarget& target);

// Reports a target with several samples for each pixel that the profile's chip does not have, or that is probed.
[[nodiscard]] Status check_samples(const PipelineState& state, const RenderTarget& target);

// Reports output planes of attributes that the vertices do not have.
[[nodiscard]] Status check_output_attributes(const RenderTarget& target, const VertexArrays& arrays);

// The pixels of the target within the scissor; of width or height 0 where there are none.
[[nodiscard]] PixelRect scissored(const PipelineState& state, const RenderTarget& target);

}  // namespace ninebit

// Blending a fragment's colour with the one that is there, in bytes.
#pragma once

#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/rasterizer.h"

namespace ninebit {

// The colour that replaces `destination`: each component as pipeline_state.h says at Blend; `enabled` is not looked at.
[[nodiscard]] ColorBytes blend(const Blend& state, const ColorBytes& source, const ColorBytes& destination);

// Whether the result is the source colour whatever the destination.
[[nodiscard]] constexpr bool replaces(const Blend& state) {
  return state.equation == BlendEquation::add && state.source == BlendFactor::one &&
         state.destination == BlendFactor::zero;
}

}  // namespace ninebit

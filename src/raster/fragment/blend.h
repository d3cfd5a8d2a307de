// Blends a fragment's colour with the stored one, in bytes.
#pragma once

#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/rasterizer.h"

namespace ninebit {

// The colour that replaces `destination`: for each component see Blend in pipeline_state.h; `enabled` is ignored.
[[nodiscard]] ColorBytes blend(const Blend& state, const ColorBytes& source, const ColorBytes& destination);

// Whether a factor may be the stored alpha.
[[nodiscard]] constexpr bool reads_stored_alpha(const Blend& state) {
  const auto reads = [](BlendFactor factor) {
    return factor == BlendFactor::dst_alpha || factor == BlendFactor::one_minus_dst_alpha ||
           factor == BlendFactor::src_alpha_saturate;
  };
  return reads(state.source) || reads(state.destination);
}

// Whether the result is the source colour for every destination.
[[nodiscard]] constexpr bool replaces(const Blend& state) {
  return state.equation == BlendEquation::add && state.source == BlendFactor::one &&
         state.destination == BlendFactor::zero;
}

}  // namespace ninebit

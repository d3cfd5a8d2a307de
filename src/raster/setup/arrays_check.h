// Checks the state, vertex arrays, textures and indices of a draw call.
#pragma once

#include <span>

#include "ninebit/numerics/result.h"
#include "ninebit/raster/rasterizer.h"

namespace ninebit {

// Reports numbers of the state out of their ranges, a program of another profile, a viewport beyond the target.
[[nodiscard]] Status check_state(const PipelineState& state, const RenderTarget& target);

// Reports positions of both kinds, arrays of unequal lengths, colours both a vertex and a primitive, more primitives
// than numbers, more texture units than the profile has, textures that GL would refuse. (check_coordinates
// checks a unit that is on.)
[[nodiscard]] Status check_arrays(const PipelineState& state, const VertexArrays& arrays,
                                  std::span<const TextureUnit> units);

// Reports indices out of range. There are at most 2^32 - 1 positions (check_arrays).
[[nodiscard]] Status check_indices(const VertexArrays& arrays);

// Reports a unit that is on and has no texture coordinates.
[[nodiscard]] Status check_coordinates(const VertexArrays& arrays, std::size_t unit);

}  // namespace ninebit

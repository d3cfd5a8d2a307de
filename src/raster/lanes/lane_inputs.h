// What the fragments of a batch have that is no matter of vectors.
#pragma once

#include <cstddef>

#include "src/raster/fragment/draw_context.h"
#include "src/raster/lanes/lane_batch.h"

namespace ninebit {

// From weights of clipped corners to weights of the vertices.
void unclip(LaneFragments& fragments);

// Primary colours that are constant over each primitive.
void fill_flat_colors(const LaneFragments& fragments, LaneBatch& batch, const DrawContext& context);

// Registers that are the same for all fragments; the first time all of them, then those that the program overwrites.
void refill_constants(LaneBatch& batch, const DrawContext& context);

// Reads a unit's texture at the batch's coordinates into its registers.
void sample(LaneBatch& batch, std::size_t count, const DrawContext& context, std::size_t unit);

}  // namespace ninebit

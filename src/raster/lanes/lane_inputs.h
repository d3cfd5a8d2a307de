// Per-fragment batch inputs that are not vectorized.
#pragma once

#include <cstddef>

#include "src/raster/fragment/draw_context.h"
#include "src/raster/lanes/lane_batch.h"

namespace ninebit {

// Turns shares of clipped corners, or their changes, into those of the vertices.
void unclip(const LaneFragments& fragments, std::array<LaneFragments::Lanes<float>, 3>& shares);

// Fills in primary colours that are constant over each primitive.
void fill_flat_colors(const LaneFragments& fragments, LaneBatch& batch, const DrawContext& context);

// Replaces a unit's coordinates, and their changes if asked for, at fragments of points: the change of s is the one
// that the context has, and coordinates of sprites run across their points.
void place_points(const LaneFragments& fragments, LaneBatch& batch, const DrawContext& context, std::size_t unit,
                  bool changes);

// The same of a unit's coordinates for stages.
void place_stage_points(const LaneFragments& fragments, LaneBatch& batch, const DrawContext& context, std::size_t unit);

// Fills registers that are the same for all fragments: all of them the first time, later those that the program
// overwrites.
void refill_constants(LaneBatch& batch, const DrawContext& context);

// Reads a unit's texture at the batch's coordinates into its registers, and notes fragments that its colour key kills.
// one_change: TextureCoordinates::one_change.
void sample(LaneBatch& batch, std::size_t count, const DrawContext& context, std::size_t unit, bool one_change);

}  // namespace ninebit

// One draw call as vectors draw it in one thread.
#pragma once

#include <memory>

#include "src/raster/fragment/draw_context.h"
#include "src/raster/lanes/lane_batch.h"
#include "src/raster/lanes/lane_operations.h"
#include "src/raster/lanes/tile_planes.h"

namespace ninebit {

// A pass's use of the fragments that it gathers; see FragmentReuse.
enum class FragmentRole {
  draws,   // draws them
  keeps,   // draws them, and keeps them for the next passes
  repeats  // draws those that an earlier pass kept
};

struct LanePass {
  // The arguments must outlive the pass.
  LanePass(const DrawContext& draw, const RenderTarget& target);

  const DrawContext& context;
  const LaneOperations operations;
  // Whether find_depths() gives codes, and whether those of primitives' corners are codes, too.
  const bool depths_are_codes, corners_are_codes;
  // The polygon stipple, if it is enabled: all ones for the pixels of a tile that are drawn, else 0. (Tiles repeat it.)
  std::unique_ptr<TileWords> stipple;
  std::unique_ptr<LaneBatch> batch;  // of a pass that gathers fragments: none where the draw's result is flat

  // Set by plan_reuse.
  FragmentRole role = FragmentRole::draws;
  bool notes_owners = false;  // see PixelOwners

  // True if the pass can reuse fragments of another pass for which this is true, and the other way round.
  // (Shares that are kept have no changes.)
  [[nodiscard]] bool can_reuse() const {
    return batch && operations.asks_equal_depth && !context.needs_texture_changes;
  }

  // True if the pass has flat results, keeps the nearest depth and makes no other test.
  [[nodiscard]] bool draws_nearest_alone() const { return !batch && operations.is_nearest_alone && depths_are_codes; }

  // Fragments that are kept are those of all stencil values: they are tested when they are drawn, not when gathered.
  [[nodiscard]] bool gathers_by_stencil() const { return operations.stencil_decides && role != FragmentRole::keeps; }
  [[nodiscard]] bool draws_by_stencil() const { return operations.stencil_decides && role != FragmentRole::draws; }
};

}  // namespace ninebit

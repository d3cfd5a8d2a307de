// Triangles drawn into one tile by vectors of fragments: what tile.cpp does with one fragment after the other, with the
// same result.
#pragma once

#include <array>
#include <memory>
#include <span>
#include <vector>

#include "src/raster/fragment/draw_context.h"
#include "src/raster/lanes/lane_batch.h"
#include "src/raster/lanes/lane_operations.h"
#include "src/raster/lanes/tile_planes.h"
#include "src/raster/setup/window_primitives.h"
#include "src/raster/setup/window_transform.h"

namespace ninebit {

// One draw call as vectors draw it in one thread.
struct LanePass {
  LanePass(const DrawContext& draw, const RenderTarget& target);

  const DrawContext& context;
  const LaneOperations operations;
  const bool depths_are_codes;       // window depths, without a polygon offset
  std::unique_ptr<LaneBatch> batch;  // none where the draw's result is flat

  // Of passes that follow one another over the same primitives, each with asks_equal_depth, all ask the same depths:
  // the first `keeps` the fragments that pass the depth test, which the others draw again (`repeats`).
  bool keeps = false, repeats = false;
  [[nodiscard]] bool can_repeat() const { return batch && operations.asks_equal_depth; }

  [[nodiscard]] bool draws_nearest_alone() const { return !batch && operations.is_nearest_alone && depths_are_codes; }
  // Whether this draws the nearest depth alone and the next pass asks for it: who leaves it is noted.
  bool notes_owners = false;
};

// One thread's tile, which passes draw into one after the other: large.
struct LaneTile {
  explicit LaneTile(const RenderTarget& planes) : target(planes) {}

  const RenderTarget& target;
  // Planes of the target that the tile holds, and those of them that it is written back to.
  bool depth = false, stencil = false, writes_depth = false, writes_stencil = false;
  std::array<bool, 4> color{};
  [[nodiscard]] bool has_color() const { return color[0] || color[1] || color[2] || color[3]; }
  // Where the target's colours lie as the tile's; where planes have other gaps, through which vectors do not reach.
  bool has_words = false, has_gaps = false;
  void look_at_steps();  // when the planes are known

  PixelBox pixels{};         // of this tile, may be drawn
  int left = 0, bottom = 0;  // the tile's lowest corner
  TilePlanes tile;
  // Of the depths as they were when a pass began that asks: no depth can have become farther since.
  bool knows_farthest = false;
  FarthestDepths farthest;

  // The numbers of the primitives that left the depths of a pass that notes them, from 0 in the order of the tile's, or
  // kNoOwner. As long as no depth changes, fragments of equal depth are these alone, unless some came as near as what
  // was there already: then owners are no longer known. (But for single pixels, which are asked for their depth.)
  static constexpr std::uint32_t kNoOwner = 0xFFFFFFFF;
  bool knows_owners = false;
  std::uint32_t next_number = 0;  // of the primitives that are drawn next

  // The first `kept` batches are those that a pass keeps; the next one is being gathered.
  static constexpr std::size_t kMostKept = 64;
  std::vector<std::unique_ptr<LaneFragments>> batches;
  std::size_t kept = 0;
  bool has_kept_all = false;                            // or there were too many
  LaneFragments* fragments = nullptr;                   // being gathered
  std::array<std::uint64_t, kTileSize + 3> occupied{};  // a bit for each pixel of a row that has one of them

  void keep_none();
  // Starts with the next batch, which may replace the last one if that need not stay.
  void begin_batch(bool keeps_last);
};

// Whether vectors can draw all of a draw.
[[nodiscard]] bool lanes_can_draw(const DrawContext& context, const RenderTarget& target);

// Draws triangles of one block; the block must stay until the batch is flushed.
void draw_lanes(LaneTile& tile, LanePass& pass, const SetupBlock& block, std::span<const std::uint32_t> indices);

// To be called before each pass of a tile.
void begin_pass(LaneTile& tile, LanePass& pass);

// Sends what has been gathered through the combiners and the fragment operations.
void flush_lanes(LaneTile& tile, LanePass& pass);

// The same with all batches that an earlier pass kept.
void repeat_fragments(LaneTile& tile, LanePass& pass);

// Takes over the pixels that may be drawn from the planes of the target, or fills the tile, and gives them back.
void load_tile(LaneTile& tile);
void fill_tile(LaneTile& tile, const ClearValues& values);  // and has the target's lines fetched meanwhile
void store_tile(const LaneTile& tile);

}  // namespace ninebit

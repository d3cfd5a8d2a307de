// Coverage and depth of triangles within one tile.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "src/raster/fragment_batch.h"

namespace ninebit {

inline constexpr int kTileSize = 64;

struct TileRect {
  int left, bottom, right, top;  // pixels, right and top exclusive
};

// Draws triangles of one block, in the order of `indices`, as far as they cover the tile. Fragments whose colour is
// the triangle's go through the fragment operations at once, the others into the batch.
void draw_in_tile(const DrawContext& context, const TileRect& tile, const SetupBlock& block,
                  std::span<const std::uint32_t> indices, bool flat_result, FragmentBatch& batch);

}  // namespace ninebit

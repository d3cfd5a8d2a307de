#include "src/raster/draw/draw_geometry.h"

#include <algorithm>
#include <span>

namespace ninebit {

DrawGeometry::DrawGeometry(const SetupContext& context, const glm::mat4& clip_from_object, const VertexArrays& arrays,
                           const TileGrid& grid, RawVector<PackedVertex>& packed)
    : grid_(grid), assembly_(arrays), clip_(clip_from_object, arrays) {
  std::span<const PackedVertex> vertices;
  if (PrimitiveSetup::takes_packed_vertices(context, assembly_, arrays.vertex_count())) {
    packed.resize(arrays.vertex_count());
    transform_vertices(clip_, context.window, packed.data());
    vertices = packed;
  }
  setup_.emplace(context, assembly_, clip_, vertices);
  items_ = setup_->items();
  // The lists of the blocks stay within 2^28 entries even if every item produces the most primitives and each of them
  // covers every tile.
  const std::size_t items = (std::size_t{1} << 28) / grid.count() / setup_->most_of_an_item();
  // A large block gives a tile many primitives at a time; a small mesh should still have a block for each thread.
  const std::size_t worth_it = std::clamp(items_ / 8, std::size_t{2048}, std::size_t{4096});
  items_per_block_ = std::clamp(items, std::size_t{64}, worth_it);
  blocks_at_a_time_ = std::clamp(items / items_per_block_, std::size_t{1}, blocks_per_chunk());
}

bool DrawGeometry::set_up(std::size_t number, BinnedBlock& block) const {
  block.clear();
  const std::size_t begin = number * items_per_block_;
  const bool in_range = setup_->set_up(begin, std::min(begin + items_per_block_, items_), grid_, block);
  sort_into_tiles(grid_, block);
  return in_range;
}

}  // namespace ninebit

// The geometry of one draw call: from vertex arrays to blocks of primitives sorted by tile.
#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "src/raster/draw/primitive_setup.h"
#include "src/raster/setup/primitive_assembly.h"
#include "src/raster/setup/setup_context.h"
#include "src/raster/setup/tile_bins.h"
#include "src/raster/setup/vertex_transform.h"
#include "src/raster/surface/raw_vector.h"

namespace ninebit {

class DrawGeometry {
 public:
  // The arguments must outlive the geometry and have been checked, except the indices if takes_packed_vertices. At
  // least one pixel may be drawn. `packed` is memory to use, which may come from an earlier draw.
  DrawGeometry(const SetupContext& context, const glm::mat4& clip_from_object, const VertexArrays& arrays,
               const TileGrid& grid, RawVector<PackedVertex>& packed);
  DrawGeometry(const DrawGeometry&) = delete;
  DrawGeometry& operator=(const DrawGeometry&) = delete;

  [[nodiscard]] const TileGrid& grid() const { return grid_; }
  [[nodiscard]] std::size_t blocks() const { return (items_ + items_per_block_ - 1) / items_per_block_; }
  // With most meshes this many blocks stay in the caches.
  [[nodiscard]] std::size_t blocks_per_chunk() const {
    return std::min((std::size_t{1} << 17) / items_per_block_, kMostBlocks);
  }
  // This many blocks keep the threads busy, and their memory is bounded whatever they hold.
  [[nodiscard]] std::size_t blocks_at_a_time() const { return blocks_at_a_time_; }
  // Replaces the contents of `block`. Returns false if an index is out of range, as PrimitiveSetup::set_up does.
  [[nodiscard]] bool set_up(std::size_t number, BinnedBlock& block) const;

 private:
  static constexpr std::size_t kMostBlocks = 128;  // each lists tiles

  TileGrid grid_;
  PrimitiveAssembly assembly_;
  ClipPositions clip_;
  std::optional<PrimitiveSetup> setup_;
  std::size_t items_ = 0;
  std::size_t items_per_block_ = 1;
  std::size_t blocks_at_a_time_ = 1;
};

}  // namespace ninebit

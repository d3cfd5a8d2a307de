// Filled triangles set up several at a time.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "src/raster/setup/polygon_offset.h"
#include "src/raster/setup/primitive_assembly.h"
#include "src/raster/setup/setup_context.h"
#include "src/raster/setup/vertex_transform.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// Vertex numbers times four have to fit into signed 32 bits.
inline constexpr std::size_t kMaxPackedVertices = std::size_t{1} << 29;

struct TriangleBatch {
  const SetupContext& context;        // its polygon modes are both `fill`
  const PrimitiveAssembly& assembly;  // triangles, a strip or a fan
  std::span<const PackedVertex> vertices;
  int tile_columns;
};

// Where to write: room for every triangle of the range.
struct TriangleBatchOutput {
  SetupPrimitive* primitives;
  SetupCorners* corners;  // null where the context does not need them
  std::uint32_t* tile;    // of each, see BinnedBlock::tile
};

struct TriangleBatchResult {
  std::size_t count = 0;  // primitives written
  // The range has been done up to `next`, but for the triangles first_left_over + i of the bits i of `left_over`: those
  // come after all that was written, and set_up_triangle has to set them up, because they are clipped or large.
  std::size_t first_left_over = 0;
  std::uint64_t left_over = 0;
  std::size_t next = 0;
  // An index names no vertex: nothing more was done.
  bool is_beyond_vertices = false;
};

// Sets up the triangles from `begin` until `end` or the first ones that it has to leave over, in order. What it writes
// is what set_up_triangle would, without those that cover no pixel's centre, and with those that draw a single pixel
// as such.
[[nodiscard]] TriangleBatchResult set_up_triangles(const TriangleBatch& batch, std::size_t begin, std::size_t end,
                                                   const TriangleBatchOutput& out);

}  // namespace ninebit

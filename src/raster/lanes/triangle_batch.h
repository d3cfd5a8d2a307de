// Filled triangles set up several at a time, in vectors.
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

// The arrays to write to, with room for every triangle of the range.
struct TriangleBatchOutput {
  SetupPrimitive* primitives;
  SetupCorners* corners;  // null where the context does not need them
  std::uint32_t* tile;    // of each, see BinnedBlock::tile
};

struct TriangleBatchResult {
  std::size_t count = 0;  // primitives written
  // All triangles before `next` have been processed, except for first_left_over + i for each bit i of `left_over`.
  // These come after everything that was written; set_up_triangle has to set them up, because they are clipped or
  // large.
  std::size_t first_left_over = 0;
  std::uint64_t left_over = 0;
  std::size_t next = 0;
  // True if an index is out of range: processing ended there.
  bool is_beyond_vertices = false;
};

// Sets up the triangles from `begin` to `end`, in order, or up to the first ones that it has to leave over. Writes what
// set_up_triangle would write, except that triangles which cover no pixel's centre are left out, and triangles which
// cover a single one are written as pixels.
[[nodiscard]] TriangleBatchResult set_up_triangles(const TriangleBatch& batch, std::size_t begin, std::size_t end,
                                                   const TriangleBatchOutput& out);

}  // namespace ninebit

// Setting up a draw call's primitives, a range of them at a time.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "src/raster/setup/primitive_assembly.h"
#include "src/raster/setup/setup_context.h"
#include "src/raster/setup/tile_bins.h"
#include "src/raster/setup/triangle_setup.h"
#include "src/raster/setup/vertex_transform.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// What a draw call's primitives are set up with. Work is counted in items: primitives, but the triangles of a polygon,
// which may have many.
class PrimitiveSetup {
 public:
  // Whether triangles may be set up several at a time, for which their vertices have to be transformed before.
  static bool takes_packed_vertices(const SetupContext& context, const PrimitiveAssembly& assembly,
                                    std::size_t vertices);

  // `packed`: all vertices, or none where they are not taken.
  PrimitiveSetup(const SetupContext& context, const PrimitiveAssembly& assembly, const ClipPositions& clip,
                 std::span<const PackedVertex> packed);

  [[nodiscard]] std::size_t items() const;
  // At most so many window primitives come of one item, as long as clipping keeps polygons convex.
  [[nodiscard]] std::size_t most_of_an_item() const;
  // Appends what is to be drawn of the items [begin, end), and in which tiles. Where vertices are packed, indices need
  // not have been checked: false says that one is out of range, and that something may be missing.
  [[nodiscard]] bool set_up(std::size_t begin, std::size_t end, const TileGrid& grid, BinnedBlock& block) const;

 private:
  [[nodiscard]] PolygonTriangle triangle_of(std::size_t primitive, std::size_t cut) const;
  [[nodiscard]] PolygonFacts facts_of(std::size_t primitive) const;
  void set_up_polygons(std::size_t begin, std::size_t end, SetupBlock& block) const;
  void set_up_one_by_one(std::size_t begin, std::size_t end, SetupBlock& block) const;
  [[nodiscard]] bool set_up_packed(std::size_t begin, std::size_t end, const TileGrid& grid, BinnedBlock& block) const;

  const SetupContext& context_;
  const PrimitiveAssembly& assembly_;
  const ClipPositions& clip_;
  std::span<const PackedVertex> packed_;
  PolygonFacts polygon_;  // of the type polygon
};

}  // namespace ninebit

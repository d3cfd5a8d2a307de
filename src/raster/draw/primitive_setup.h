// Sets up a draw call's primitives, one range at a time.
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

// Sets up the primitives of a draw call. Work is counted in items: an item is a primitive, but a single triangle if the
// draw call is of the type polygon.
class PrimitiveSetup {
 public:
  // Whether triangles may be set up several at a time; this requires vertices that are already transformed.
  static bool takes_packed_vertices(const SetupContext& context, const PrimitiveAssembly& assembly,
                                    std::size_t vertices);

  // `packed`: all vertices, or none if not takes_packed_vertices.
  PrimitiveSetup(const SetupContext& context, const PrimitiveAssembly& assembly, const ClipPositions& clip,
                 std::span<const PackedVertex> packed);

  [[nodiscard]] std::size_t items() const;
  // The most window primitives that one item produces, as long as clipping keeps polygons convex.
  [[nodiscard]] std::size_t most_of_an_item() const;
  // Appends the primitives of the items [begin, end) and their tiles. With packed vertices, the indices need not have
  // been checked: returns false if one is out of range; primitives may then be missing.
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

// Setting up a draw call's primitives, a range of them at a time.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "src/raster/primitive_assembly.h"
#include "src/raster/setup_context.h"
#include "src/raster/setup_primitive.h"
#include "src/raster/triangle_setup.h"

namespace ninebit {

// What a draw call's primitives are set up with. Work is counted in items: primitives, but the triangles of a polygon,
// which may have many.
class PrimitiveSetup {
 public:
  // `clip` holds the positions in clip coordinates.
  PrimitiveSetup(const SetupContext& context, const PrimitiveAssembly& assembly, std::span<const glm::vec4> clip);

  [[nodiscard]] std::size_t items() const;
  // At most so many window primitives come of one item, as long as clipping keeps polygons convex.
  [[nodiscard]] std::size_t most_of_an_item() const;
  // Appends what is to be drawn of the items [begin, end).
  void set_up(std::size_t begin, std::size_t end, SetupBlock& block) const;

 private:
  [[nodiscard]] PolygonTriangle triangle_of(std::size_t primitive, std::size_t cut) const;
  [[nodiscard]] PolygonFacts facts_of(std::size_t primitive) const;
  void set_up_polygons(std::size_t begin, std::size_t end, SetupBlock& block) const;

  const SetupContext& context_;
  const PrimitiveAssembly& assembly_;
  std::span<const glm::vec4> clip_;
  PolygonFacts polygon_;  // of the type polygon
};

}  // namespace ninebit

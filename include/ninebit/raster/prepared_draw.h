// Geometry that is set up once and drawn several times.
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/rasterizer.h"

namespace NINEBIT_PUBLIC ninebit {

// One draw of prepared geometry.
struct DrawPass {
  const PipelineState* state = nullptr;      // not nullptr; agrees with the preparation
  VertexArrays arrays{};                     // type, positions and indices: the prepared ones
  std::span<const TextureUnit> units{};      // as rasterize() takes them
  std::chrono::nanoseconds* time = nullptr;  // receives the threads' total time in this pass; nullptr: not measured
};

// Further actions on the target's planes.
struct DrawActions {
  std::optional<ClearValues> clear{};  // fills colour, depth and stencil before the first pass, without masks
  bool discard_depth = false;          // the content of the depth plane is undefined after the last pass
};

// A draw call's geometry, ready for its fragments: transformed, clipped, culled, snapped to the window and sorted into
// tiles. Several passes over the same geometry and view, each with its own tests, textures, colours and planes, share
// this work. They draw exactly what rasterize() draws. Takes about 95 bytes per primitive that is not culled.
class PreparedDraw {
 public:
  PreparedDraw();  // empty
  ~PreparedDraw();
  // A moved-from object is of no draw call.
  PreparedDraw(PreparedDraw&& other) noexcept;
  PreparedDraw& operator=(PreparedDraw&& other) noexcept;

  struct Geometry;

 private:
  friend Status prepare(const PipelineState& state, const glm::mat4& clip_from_object, const VertexArrays& arrays,
                        const RenderTarget& target, PreparedDraw& prepared);
  friend Status rasterize(std::span<const DrawPass> passes, const PreparedDraw& prepared, const DrawActions& actions,
                          RenderTarget& target);
  friend void mark_covering_polygons(const PreparedDraw& prepared, std::vector<bool>& covering);
  std::unique_ptr<Geometry> geometry_;
};

// Prepares a draw into `prepared`, which keeps its memory for the next one. Reads the arrays' type, positions and
// indices, the target's size and depth format, and the state that draw-time checks compare (see below).
//
// Reports the errors that rasterize() reports for these; then `prepared` is of no draw call.
[[nodiscard]] Status prepare(const PipelineState& state, const glm::mat4& clip_from_object, const VertexArrays& arrays,
                             const RenderTarget& target, PreparedDraw& prepared);

// Draws the prepared geometry, pass after pass, as rasterize() does with the prepared matrix and each pass's state.
// With `clear`, the target's colour, depth and stencil planes are filled first, without masks. Positions and indices
// must be the prepared ones, the indices in the same memory and unchanged; everything else in the arrays may differ. No
// pass may read a plane of the target as a texture. Several threads may draw one PreparedDraw at the same time.
//
// Passes are drawn tile by tile, which reads and writes the target's planes once, if
// - vectors can draw all passes (docs/rasterizer.md lists what they cannot: lines and points of one colour, for
// example),
// - all passes write the same colour components,
// - the target has neither output planes nor a probe.
// The clear is part of that if, in addition, scissor and viewport cover the whole target, the passes write all of its
// colour components, and its stencil, if any, has eight bits. Results are the same either way.
//
// Reports, before anything is drawn: the errors of rasterize(); that nothing has been prepared; each difference from
// the preparation in: size and depth format of the target; viewport, scissor, depth range, float_depth_one; culling,
// front face, polygon modes, polygon offset (and profile.polygon_offset_slope and polygon_offset_fraction), point size,
// line width, profile.subpixel_bits; type, number of positions, indices.
[[nodiscard]] Status rasterize(std::span<const DrawPass> passes, const PreparedDraw& prepared,
                               const DrawActions& actions, RenderTarget& target);

// Sets `covering[i]` for each primitive i of the prepared draw that is a filled polygon and covers the centre of at
// least one pixel, regardless of the fragments' tests. The other elements stay as they are.
void mark_covering_polygons(const PreparedDraw& prepared, std::vector<bool>& covering);

// Draws the prepared geometry in a single pass.
[[nodiscard]] inline Status rasterize(const PipelineState& state, const PreparedDraw& prepared,
                                      const VertexArrays& arrays, std::span<const TextureUnit> units,
                                      RenderTarget& target) {
  const DrawPass pass{.state = &state, .arrays = arrays, .units = units};
  return rasterize({&pass, 1}, prepared, {}, target);
}

}  // namespace ninebit

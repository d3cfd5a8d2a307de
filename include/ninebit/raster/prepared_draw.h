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
  const PipelineState* state = nullptr;  // not nullptr; agrees with the preparation
  VertexArrays arrays{};                 // same type, positions and indices as prepared
  std::span<const TextureUnit> units{};  // as rasterize() takes them
  std::chrono::nanoseconds* time =
      nullptr;  // receives the sum of the threads' times on the pass; nullptr: not measured
};

// Further operations on the target's planes.
struct DrawActions {
  std::optional<ClearValues> clear{};  // fills colour, depth and stencil before the first pass, ignoring masks
  bool discard_depth = false;          // the depth plane is undefined after the last pass
};

// The geometry of a draw call before its fragments are drawn: transformed, clipped, culled, snapped to the window and
// sorted into tiles. Passes over the same geometry from the same view share this work. Each has its own tests,
// textures, colours and planes and draws exactly what rasterize() without preparation would draw. It takes about 95
// bytes for each primitive that may be drawn.
class PreparedDraw {
 public:
  PreparedDraw();  // empty
  ~PreparedDraw();
  // A moved-from object is empty.
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

// Prepares a draw into `prepared`, which keeps its memory for the next one. It reads the type,
// positions and indices of the arrays, the size and depth format of the target, and those fields of the state that the
// overloads of rasterize() below compare.
//
// Reports the same errors as rasterize(); `prepared` is then empty.
[[nodiscard]] Status prepare(const PipelineState& state, const glm::mat4& clip_from_object, const VertexArrays& arrays,
                             const RenderTarget& target, PreparedDraw& prepared);

// Draws the prepared geometry in one pass after the other, as rasterize() does with the prepared matrix and each pass's
// state; before the first pass, with `clear`, the target's colour, depth and stencil planes are filled with
// its values, ignoring masks. The arrays' positions and indices must be those that were prepared, the indices unchanged
// and in the same memory; everything else in the arrays may differ. No pass may read a plane of the target as a
// texture. One PreparedDraw may be drawn by several threads at a time.
//
// Passes are drawn tile by tile, so that the target's planes are read and written once, where no pass draws lines or
// points, blends, has secondary colours, fog factors or mip-maps, or writes different colour components,
// and the target has neither output planes nor a probe. The clearing is part of that where, besides, the scissor and
// the viewport leave out no pixel, those components are all that the target has, and its stencil, if it has one, has
// eight bits. This changes nothing but the time.
//
// Before anything is drawn, it reports the errors of rasterize(), a PreparedDraw that is empty, and any difference from
// the preparation in: size and depth format of the target; viewport, scissor, depth range; culling, front
// face, polygon modes, polygon offset (and profile.polygon_offset_slope), point size, line width,
// profile.subpixel_bits; the type, the number of positions and the indices.
[[nodiscard]] Status rasterize(std::span<const DrawPass> passes, const PreparedDraw& prepared,
                               const DrawActions& actions, RenderTarget& target);

// `covering` has one element for each primitive of the prepared draw. Sets those whose filled polygon covers the centre
// of at least one pixel, regardless of the tests. The other elements keep their values.
void mark_covering_polygons(const PreparedDraw& prepared, std::vector<bool>& covering);

// Draws the prepared geometry in a single pass.
[[nodiscard]] inline Status rasterize(const PipelineState& state, const PreparedDraw& prepared,
                                      const VertexArrays& arrays, std::span<const TextureUnit> units,
                                      RenderTarget& target) {
  const DrawPass pass{.state = &state, .arrays = arrays, .units = units};
  return rasterize({&pass, 1}, prepared, {}, target);
}

}  // namespace ninebit

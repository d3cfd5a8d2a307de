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
  VertexArrays arrays{};                     // type, positions and indices as they were prepared
  std::span<const TextureUnit> units{};      // as rasterize() takes them
  std::chrono::nanoseconds* time = nullptr;  // gets the time that threads spent on the pass, together; nullptr: unasked
};

// What else is done with the target's planes.
struct DrawActions {
  std::optional<ClearValues> clear{};  // before the first pass, colour, depth and stencil are filled, through no mask
  bool discard_depth = false;          // after the last one, what the depth plane holds has no meaning
};

// What becomes of a draw call's vertices before its fragments are drawn: transformed, clipped, culled, snapped to the
// window and sorted into tiles. Passes over the same geometry from the same view, each with its own tests, textures,
// colours and planes, then share that work and draw exactly what rasterize() without it would. About 95 bytes for each
// primitive that may be drawn.
class PreparedDraw {
 public:
  PreparedDraw();  // of no draw call
  ~PreparedDraw();
  // What was moved from is of no draw call.
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

// Prepares a draw into `prepared`, which keeps its memory for the next one. Of the arrays it reads type, positions and
// indices; of the target its size and depth format; of the state what the drawing below compares.
//
// Reports what rasterize() reports of all these; `prepared` is then of no draw call.
[[nodiscard]] Status prepare(const PipelineState& state, const glm::mat4& clip_from_object, const VertexArrays& arrays,
                             const RenderTarget& target, PreparedDraw& prepared);

// Draws what was prepared in one pass after the other, as rasterize() with the matrix of its preparation and the state
// of each pass does; before the first pass, with `clear`, the target's colour, depth and stencil planes are filled with
// its values, through no mask. The arrays' positions and indices are those that were prepared, the latter in the same
// memory, unchanged; all else in them may differ. No pass may read a plane of the target as a texture. One PreparedDraw
// may be drawn by several threads at a time.
//
// Passes are drawn tile by tile, so that the target's planes are read and written once, where no pass draws lines or
// points, blends, has secondary colours, fog factors or mip-maps, or writes other colour components than another one,
// and the target has neither output planes nor a probe. The clearing is part of that where, besides, the scissor and
// the viewport leave out no pixel, those components are all that the target has, and its stencil, if it has one, has
// eight bits. This changes nothing but the time.
//
// Reports, before anything is drawn, besides what rasterize() reports, that nothing has been prepared, and whatever
// differs from the preparation of: size and depth format of the target; viewport, scissor, depth range; culling, front
// face, polygon modes, polygon offset (and profile.polygon_offset_slope), point size, line width,
// profile.subpixel_bits; the type, the number of positions and the indices.
[[nodiscard]] Status rasterize(std::span<const DrawPass> passes, const PreparedDraw& prepared,
                               const DrawActions& actions, RenderTarget& target);

// Sets `covering`, which has an element for each primitive of the draw that was prepared, where a filled polygon covers
// the centre of at least one pixel, whatever the tests would say of its fragments. The other elements stay as they are.
void mark_covering_polygons(const PreparedDraw& prepared, std::vector<bool>& covering);

// rasterize() in one pass.
[[nodiscard]] inline Status rasterize(const PipelineState& state, const PreparedDraw& prepared,
                                      const VertexArrays& arrays, std::span<const TextureUnit> units,
                                      RenderTarget& target) {
  const DrawPass pass{.state = &state, .arrays = arrays, .units = units};
  return rasterize({&pass, 1}, prepared, {}, target);
}

}  // namespace ninebit

#include "src/raster/draw/tile.h"

#include <algorithm>
#include <array>
#include <optional>

#include "src/raster/fragment/stipple.h"
#include "src/raster/setup/coverage_samples.h"
#include "src/raster/setup/line_pixels.h"
#include "src/raster/setup/primitive_assembly.h"
#include "src/raster/setup/primitive_depth.h"
#include "src/raster/setup/triangle_edges.h"

namespace ninebit {
namespace {

// The colour planes that a pass writes.
std::array<bool, 4> planes_written(const DrawContext& pass, const RenderTarget& target) {
  std::array<bool, 4> written{};
  for (std::size_t k = 0; k < 4; ++k) written[k] = pass.state.color_mask[k] && target.color[k];
  return written;
}

// The planes that the passes need, or all of them where the tile is cleared.
TileContents tile_contents(std::span<const LanePass> passes, const RenderTarget& target, const TileActions& actions) {
  TileContents all;
  for (const LanePass& pass : passes) {
    all.depth = all.depth || pass.operations.depth;
    all.stencil = all.stencil || pass.operations.stencil;
    all.writes_depth = all.writes_depth || pass.operations.depth_write;
    all.writes_stencil = all.writes_stencil || pass.operations.stencil_write;
    const std::array<bool, 4> color = planes_written(pass.context, target);
    for (std::size_t k = 0; k < 4; ++k) all.color[k] = all.color[k] || color[k];
  }
  all.draws_depth_stencil = all.writes_depth || all.writes_stencil;
  all.clears = actions.clear != nullptr;
  if (all.clears) {
    all.depth = all.writes_depth = static_cast<bool>(target.depth);
    all.stencil = all.writes_stencil = static_cast<bool>(target.stencil);
    for (std::size_t k = 0; k < 4; ++k) all.color[k] = static_cast<bool>(target.color[k]);
  }
  if (actions.discards_depth) all.writes_depth = false;
  all.is_sample = actions.is_sample;
  return all;
}

// Makes the early tests of a primitive's fragments, and hands the others to `Next`. (It copies
// what each fragment reads: the compiler assumes that stores of bytes may change anything else.)
template <class Next>
class FragmentSink {
 public:
  FragmentSink(const DrawContext& context, const SetupPrimitive& primitive, Next next)
      : operations_(context.operations),
        primitive_(primitive.primitive),
        front_facing_(primitive.front_facing),
        stipple_(is_polygon(primitive) && context.state.polygon_stipple ? &*context.state.polygon_stipple : nullptr),
        next_(next) {}

  void operator()(int x, int y, std::uint32_t depth, const std::array<std::int64_t, 3>& edge,
                  std::uint8_t coverage = 255) const {
    if (stipple_ != nullptr && !has_pixel(*stipple_, x, y)) return;
    // Two objects: the first stays in registers.
    if (operations_.is_lost_early({x, y, depth, primitive_, front_facing_})) return;
    next_({x, y, depth, primitive_, front_facing_, coverage}, edge);
  }

 private:
  static bool is_polygon(const SetupPrimitive& p) {
    return p.kind == SetupKind::triangle || p.kind == SetupKind::pixel;
  }

  const FragmentOperations& operations_;
  const std::uint32_t primitive_;
  const bool front_facing_;
  const StipplePattern* const stipple_;  // null: all pixels are drawn
  const Next next_;
};

// Not inlined: the caller would be large and short of registers.
template <class Sink>
[[gnu::noinline]] void draw_triangle(const PixelBox& tile, const SetupPrimitive& t, const WindowDepth& window,
                                     Sink sink) {
  const TriangleEdges plane(t);
  const PrimitiveDepth depth(window, t, plane.area());
  const int left = std::max<int>(tile.left, t.box.left), right = std::min<int>(tile.right - 1, t.box.right);
  const int bottom = std::max<int>(tile.bottom, t.box.bottom), top = std::min<int>(tile.top - 1, t.box.top);
  const bool narrow = right - left < 8;  // testing each pixel costs less than dividing for the span
  for (int y = bottom; y <= top; ++y) {
    int first = left, last = right;
    if (!narrow && !plane.span(y, first, last)) continue;
    std::array<std::int64_t, 3> e = plane.at(first, y);
    for (int x = first; x <= last; ++x, plane.step_right(e)) {
      if (narrow && !plane.inside(e)) continue;
      sink(x, y, depth(e), e);
    }
  }
}

// A pixel with any sample inside is drawn. Where its centre lies outside, an edge function below 0 counts as 0 there:
// the fragment's values are those of a place on the triangle (assumed).
template <class Sink>
[[gnu::noinline]] void draw_smooth_triangle(const PixelBox& tile, const SetupPrimitive& t, const WindowDepth& window,
                                            Sink sink) {
  const TriangleEdges plane(t);
  const PixelBox box = common_pixels(tile, t.box);
  for (int y = box.bottom; y < box.top; ++y) {
    std::array<std::int64_t, 3> e = plane.at(box.left, y);
    for (int x = box.left; x < box.right; ++x, plane.step_right(e)) {
      const int inside = plane.samples_inside(e);
      if (inside == 0) continue;
      const std::array<std::int64_t, 3> place{std::max(e[0], std::int64_t{0}), std::max(e[1], std::int64_t{0}),
                                              std::max(e[2], std::int64_t{0})};
      const PrimitiveDepth depth(window, t, place[0] + place[1] + place[2]);
      sink(x, y, depth(place), place, coverage_byte(inside));
    }
  }
}

template <class Sink>
void draw_pixel(const PixelBox& tile, const SetupPrimitive& t, const WindowDepth& window, Sink sink) {
  const int x = t.box.left, y = t.box.bottom;
  if (x < tile.left || x >= tile.right || y < tile.bottom || y >= tile.top) return;  // (a probe's tile is one pixel)
  const TriangleEdges plane(t);
  const std::array<std::int64_t, 3> edge = plane.at(x, y);
  sink(x, y, PrimitiveDepth(window, t, plane.area())(edge), edge);
}

template <class Next>
void draw_primitive(const DrawContext& context, const PixelBox& tile, const SetupPrimitive& p, Next next) {
  const FragmentSink<Next> sink(context, p, next);
  switch (p.kind) {
    case SetupKind::triangle:
      context.state.polygon_smooth ? draw_smooth_triangle(tile, p, context.depth, sink)
                                   : draw_triangle(tile, p, context.depth, sink);
      break;
    case SetupKind::line:
    case SetupKind::point:
      draw_line_or_point(context.state, tile, p, context.depth, sink);
      break;
    case SetupKind::pixel:
      draw_pixel(tile, p, context.depth, sink);
      break;
  }
}

}  // namespace

void draw_in_tile(const DrawContext& context, const PixelBox& tile, const SetupBlock& block,
                  std::span<const std::uint32_t> indices, FragmentBatch* batch) {
  using Edge = std::array<std::int64_t, 3>;
  const FragmentOperations& operations = context.operations;
  for (const std::uint32_t index : indices) {
    const SetupPrimitive& p = block.primitives[index];
    if (!context.has_flat_result) {
      draw_primitive(context, tile, p,
                     [&](const UncoloredFragment& f, const Edge& edge) { batch->push(f, p, block, edge); });
      continue;
    }
    const ColorBytes color = context.flat_primary(p.primitive);
    if (context.outputs.empty()) {
      draw_primitive(context, tile, p,
                     [&operations, color](const UncoloredFragment& f, const Edge&) { operations.apply(f, color); });
    } else {
      draw_primitive(context, tile, p, [&context, color](const UncoloredFragment& f, const Edge&) {
        draw_fragment(context.operations, context.outputs, f, color);
      });
    }
  }
}

bool TileRasterizer::can_share_tiles(std::span<const DrawContext* const> passes, const RenderTarget& target) {
  // A probe needs the stored planes, cleared, before each pass.
  if (target.probes != nullptr) return false;
  // The tile holds whole pixels: each pass has to write either all colour components that any pass writes, or none.
  std::optional<std::array<bool, 4>> written;
  for (const DrawContext* pass : passes) {
    if (!lanes_can_draw(*pass, target)) return false;
    const std::array<bool, 4> color = planes_written(*pass, target);
    if (color == std::array<bool, 4>{}) continue;
    if (written.value_or(color) != color) return false;
    written = color;
  }
  return true;
}

bool TileRasterizer::can_clear_tiles(std::span<const DrawContext* const> passes, const RenderTarget& target) {
  if (!can_share_tiles(passes, target)) return false;
  // Tiles are cleared to the default number of window depth 1.
  const auto has_own_one = [](const DrawContext* pass) { return pass->state.float_depth_one.has_value(); };
  if (std::any_of(passes.begin(), passes.end(), has_own_one)) return false;
  // Clearing leaves the bits beyond the stencil bits as they are.
  if (target.stencil && stencil_bits(target.format) < 8) return false;
  // A cleared tile holds every colour plane: each pass has to write all of them, or none.
  std::array<bool, 4> all{};
  for (std::size_t k = 0; k < 4; ++k) all[k] = static_cast<bool>(target.color[k]);
  return std::all_of(passes.begin(), passes.end(), [&](const DrawContext* pass) {
    const std::array<bool, 4> written = planes_written(*pass, target);
    return written == all || written == std::array<bool, 4>{};
  });
}

TileRasterizer::TileRasterizer(std::span<const DrawContext* const> passes, const RenderTarget& target,
                               const TileActions& actions)
    : context_(passes[0]), clear_(actions.clear) {
  if (!lanes_can_draw(*context_, target)) {
    if (!context_->has_flat_result) batch_ = std::make_unique<FragmentBatch>(*context_);
    return;
  }
  passes_.reserve(passes.size());
  for (const DrawContext* pass : passes) passes_.emplace_back(*pass, target);
  plan_reuse(passes_);
  lanes_ = std::make_unique<LaneTile>(target, tile_contents(passes_, target, actions));
}

void TileRasterizer::begin(const PixelBox& pixels) {
  pixels_ = pixels;
  if (!lanes_) return;
  lanes_->owners.are_known = false;
  lanes_->planes.move_to(pixels);
  clear_ != nullptr ? fill_tile(lanes_->planes, *clear_) : load_tile(lanes_->planes);
}

void TileRasterizer::begin_pass(std::size_t pass) {
  if (lanes_) ninebit::begin_pass(*lanes_, passes_[pass]);
}

void TileRasterizer::draw(std::size_t pass, const SetupBlock& block, std::span<const std::uint32_t> indices) {
  if (lanes_) {
    draw_lanes(*lanes_, passes_[pass], block, indices);
  } else {
    draw_in_tile(*context_, pixels_, block, indices, batch_.get());
  }
}

void TileRasterizer::end_pass(std::size_t pass) {
  if (batch_) batch_->flush();
  if (lanes_ && passes_[pass].batch) flush_lanes(*lanes_, passes_[pass]);
}

void TileRasterizer::end() {
  if (lanes_) store_tile(lanes_->planes);
}

}  // namespace ninebit

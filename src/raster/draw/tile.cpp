#include "src/raster/draw/tile.h"

#include <algorithm>
#include <array>
#include <optional>

#include "src/raster/setup/line_walk.h"
#include "src/raster/setup/triangle_edges.h"
#include "src/raster/surface/floor_divider.h"

namespace ninebit {
namespace {

// The colour planes that a pass writes.
std::array<bool, 4> planes_written(const DrawContext& pass, const RenderTarget& target) {
  std::array<bool, 4> written{};
  for (std::size_t k = 0; k < 4; ++k) written[k] = pass.state.color_mask[k] && target.color[k];
  return written;
}

// Takes a primitive's fragments on their way: depth code and early tests, then what `Next` does with them. (A copy of
// what is asked for each fragment: writing bytes could change anything else, as far as a compiler can know.)
template <class Next>
class FragmentSink {
 public:
  FragmentSink(const DrawContext& context, const SetupPrimitive& primitive, Next next)
      : operations_(context.operations),
        depth_(context.depth),
        primitive_(primitive.primitive),
        offset_z24_(primitive.offset_z24),
        front_facing_(primitive.front_facing),
        is_code_(primitive.offset_z24 == 0 && context.depth.step_z24() == 1),
        next_(next) {}

  void operator()(int x, int y, std::uint32_t z24, const std::array<std::int64_t, 3>& edge) const {
    const std::uint32_t depth = is_code_ ? z24 : depth_.code(z24, offset_z24_);
    // Two of them: the first stays in registers.
    if (operations_.is_lost_early({x, y, depth, primitive_, front_facing_})) return;
    next_({x, y, depth, primitive_, front_facing_}, edge);
  }

 private:
  const FragmentOperations& operations_;
  const WindowDepth depth_;
  const std::uint32_t primitive_;
  const std::int32_t offset_z24_;
  const bool front_facing_;
  const bool is_code_;
  const Next next_;
};

// Not part of its caller, which would be large and short of registers.
template <class Sink>
[[gnu::noinline]] void draw_triangle(const PixelBox& tile, const SetupPrimitive& t, Sink sink) {
  const TriangleEdges plane(t);
  const int left = std::max<int>(tile.left, t.box.left), right = std::min<int>(tile.right - 1, t.box.right);
  const int bottom = std::max<int>(tile.bottom, t.box.bottom), top = std::min<int>(tile.top - 1, t.box.top);
  const bool narrow = right - left < 8;  // testing each pixel costs less than dividing for the span
  for (int y = bottom; y <= top; ++y) {
    int first = left, last = right;
    if (!narrow && !plane.span(y, first, last)) continue;
    std::array<std::int64_t, 3> e = plane.at(first, y);
    for (int x = first; x <= last; ++x, plane.step_right(e)) {
      if (narrow && !plane.inside(e)) continue;
      sink(x, y, plane.z24(e), e);
    }
  }
}

// The pixels of one column (row) share the place along the line of the lowest one's centre; beyond an end, they have
// what the end has.
template <class Sink>
void draw_line(const PixelBox& tile, const SetupPrimitive& line, int width, Sink sink) {
  const LineWalk walk(line);
  const std::array<std::int32_t, 3> x_q4 = line.x_q4(), y_q4 = line.y_q4();
  const bool x_major = walk.is_x_major();
  const std::int64_t dx = x_q4[1] - x_q4[0], dy = y_q4[1] - y_q4[0];
  const std::int64_t squared_length = dx * dx + dy * dy;
  const FloorDivider divide(2 * squared_length);
  const int first = std::max(walk.first(), x_major ? tile.left : tile.bottom);
  const int last = std::min(walk.last(), (x_major ? tile.right : tile.top) - 1);
  const int minor_first = x_major ? tile.bottom : tile.left, minor_end = x_major ? tile.top : tile.right;
  for (int major = first; major <= last; ++major) {
    int minor = 0;
    if (!walk.pixel_at(major, minor)) continue;
    const int x = x_major ? major : minor, y = x_major ? minor : major;
    const std::int64_t along = dx * (16 * std::int64_t{x} + 8 - x_q4[0]) + dy * (16 * std::int64_t{y} + 8 - y_q4[0]);
    const std::int64_t from_start = std::clamp(along, std::int64_t{0}, squared_length);
    const std::array<std::int64_t, 3> edge{squared_length - from_start, from_start, 0};
    const std::int64_t wide = edge[0] * line.z24[0] + edge[1] * line.z24[1];
    const auto z24 = static_cast<std::uint32_t>(divide(2 * wide + squared_length));
    for (int m = std::max(minor, minor_first); m < std::min(minor + width, minor_end); ++m) {
      sink(x_major ? x : m, x_major ? m : y, z24, edge);
    }
  }
}

template <class Sink>
void draw_point(const PixelBox& tile, const SetupPrimitive& point, int size, Sink sink) {
  const int left = point.x_q4()[0] >> 4, bottom = point.y_q4()[0] >> 4;
  for (int y = std::max(bottom, tile.bottom); y < std::min(bottom + size, tile.top); ++y) {
    for (int x = std::max(left, tile.left); x < std::min(left + size, tile.right); ++x) {
      sink(x, y, point.z24[0], {1, 0, 0});
    }
  }
}

template <class Sink>
void draw_pixel(const PixelBox& tile, const SetupPrimitive& t, Sink sink) {
  const int x = t.box.left, y = t.box.bottom;
  if (x < tile.left || x >= tile.right || y < tile.bottom || y >= tile.top) return;  // (a probe's tile is one pixel)
  sink(x, y, t.z24[0], TriangleEdges(t).at(x, y));
}

template <class Next>
void draw_primitive(const DrawContext& context, const PixelBox& tile, const SetupPrimitive& p, Next next) {
  const FragmentSink<Next> sink(context, p, next);
  switch (p.kind) {
    case SetupKind::triangle:
      draw_triangle(tile, p, sink);
      break;
    case SetupKind::line:
      draw_line(tile, p, context.state.line_width, sink);
      break;
    case SetupKind::point:
      draw_point(tile, p, context.state.point_size, sink);
      break;
    case SetupKind::pixel:
      draw_pixel(tile, p, sink);
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
  // The tile holds pixels with all their colour components: a pass writes either all that any does, or none.
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
  // Memory beyond the stencil bits is not cleared.
  if (target.stencil && stencil_bits(target.format) < 8) return false;
  // The tile then holds every colour plane, which a pass writes all or none of, see above.
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
  lanes_ = std::make_unique<LaneTile>(target);
  LaneTile& t = *lanes_;
  passes_.reserve(passes.size());
  for (const DrawContext* pass : passes) {
    const LaneOperations& operations = passes_.emplace_back(*pass, target).operations;
    t.depth = t.depth || operations.depth;
    t.stencil = t.stencil || operations.stencil;
    t.writes_depth = t.writes_depth || operations.depth_write;
    t.writes_stencil = t.writes_stencil || operations.stencil_write;
    const std::array<bool, 4> color = planes_written(*pass, target);
    for (std::size_t k = 0; k < 4; ++k) t.color[k] = t.color[k] || color[k];
  }
  for (std::size_t i = 1; i < passes_.size(); ++i) {
    passes_[i - 1].notes_owners = passes_[i - 1].draws_nearest_alone() && passes_[i].can_repeat();
    if (!passes_[i - 1].can_repeat() || !passes_[i].can_repeat()) continue;
    passes_[i].repeats = true;
    passes_[i - 1].keeps = !passes_[i - 1].repeats;
  }
  if (clear_ != nullptr) {
    t.depth = t.writes_depth = static_cast<bool>(target.depth);
    t.stencil = t.writes_stencil = static_cast<bool>(target.stencil);
    for (std::size_t k = 0; k < 4; ++k) t.color[k] = static_cast<bool>(target.color[k]);
  }
  if (actions.discards_depth) t.writes_depth = false;
  t.look_at_steps();
}

void TileRasterizer::begin(const PixelBox& pixels) {
  pixels_ = pixels;
  if (!lanes_) return;
  lanes_->knows_owners = false;
  lanes_->pixels = pixels;
  lanes_->left = pixels.left & -kTileSize;
  lanes_->bottom = pixels.bottom & -kTileSize;
  clear_ != nullptr ? fill_tile(*lanes_, *clear_) : load_tile(*lanes_);
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
  if (lanes_) store_tile(*lanes_);
}

}  // namespace ninebit

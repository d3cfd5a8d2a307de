#include "ninebit/raster/prepared_draw.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <deque>
#include <string>
#include <utility>
#include <vector>

#include "src/raster/draw/draw_check.h"
#include "src/raster/draw/draw_geometry.h"
#include "src/raster/draw/draw_scratch.h"
#include "src/raster/draw/pixel_probe.h"
#include "src/raster/draw/tile_work.h"
#include "src/raster/fragment/draw_context.h"
#include "src/raster/setup/arrays_check.h"
#include "src/raster/setup/setup_context.h"
#include "src/raster/setup/triangle_edges.h"
#include "src/raster/surface/target_check.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

// If `is_valid` is false, only the memory is kept.
struct PreparedDraw::Geometry {
  bool is_valid = false;
  bool one_w = false;     // has_one_w()
  PipelineState state{};  // as far as the geometry depends on it
  int width = 0;
  int height = 0;
  DepthStencilFormat format{};
  PixelBox drawn{};
  PrimitiveType type{};
  std::size_t positions = 0;
  std::span<const std::uint32_t> indices{};
  std::vector<BinnedBlock> blocks{};
  TileWork work{};
};

namespace {

// The state that the geometry depends on; the other fields keep their defaults.
PipelineState geometry_state(const PipelineState& state) {
  PipelineState s;
  s.profile = state.profile;
  s.viewport = state.viewport;
  s.depth_near = state.depth_near;
  s.depth_far = state.depth_far;
  s.float_depth_one = state.float_depth_one;
  s.cull_face = state.cull_face;
  s.front_face = state.front_face;
  s.front_mode = state.front_mode;
  s.back_mode = state.back_mode;
  s.polygon_offset = state.polygon_offset;
  s.point_size = state.point_size;
  s.line_width = state.line_width;
  s.polygon_smooth = state.polygon_smooth;
  s.line_smooth = state.line_smooth;
  s.scissor = state.scissor;
  return s;
}

bool same(const PolygonOffset& a, const PolygonOffset& b) {
  return a.fill == b.fill && a.line == b.line && a.point == b.point && a.factor == b.factor && a.units == b.units;
}

bool same(const PixelRect& a, const PixelRect& b) {
  return a.x == b.x && a.y == b.y && a.width == b.width && a.height == b.height;
}

bool same(const PixelBox& a, const PixelBox& b) {
  return a.left == b.left && a.bottom == b.bottom && a.right == b.right && a.top == b.top;
}

Status check_prepared(const PreparedDraw::Geometry& g, const PipelineState& state, const VertexArrays& arrays,
                      const RenderTarget& target) {
  const PipelineState& p = g.state;
  struct Part {
    bool is_same;
    const char* name;
  };
  const std::array parts{
      Part{g.width == target.width && g.height == target.height, "target's size"},
      Part{g.format == target.format, "target's depth format"},
      Part{same(p.viewport.value_or(PixelRect{0, 0, g.width, g.height}), viewport_of(state, target)), "viewport"},
      Part{same(g.drawn, drawn_pixels(state, target)), "scissor"},
      Part{p.depth_near == state.depth_near && p.depth_far == state.depth_far, "depth range"},
      Part{p.float_depth_one == state.float_depth_one, "number of window depth 1"},
      Part{p.cull_face == state.cull_face, "culling"},
      Part{p.front_face == state.front_face, "front face"},
      Part{p.front_mode == state.front_mode && p.back_mode == state.back_mode, "polygon mode"},
      Part{same(p.polygon_offset, state.polygon_offset), "polygon offset"},
      Part{p.profile.polygon_offset_slope.value == state.profile.polygon_offset_slope.value, "polygon offset's slope"},
      Part{p.profile.polygon_offset_fraction.value == state.profile.polygon_offset_fraction.value,
           "polygon offset's fraction"},
      Part{p.profile.depth_narrowing.value == state.profile.depth_narrowing.value, "narrowing of depths"},
      Part{p.profile.point_shape.value == state.profile.point_shape.value, "shape of points"},
      Part{p.profile.line_shape.value == state.profile.line_shape.value, "shape of lines"},
      Part{p.point_size == state.point_size, "point size"},
      Part{p.line_width == state.line_width, "line width"},
      Part{p.polygon_smooth == state.polygon_smooth, "smoothing of polygons"},
      Part{p.line_smooth == state.line_smooth, "smoothing of lines"},
      Part{p.profile.subpixel_bits.value == state.profile.subpixel_bits.value, "number of subpixel bits"},
      Part{g.type == arrays.type, "type of primitives"},
      Part{g.positions == arrays.vertex_count(), "number of positions"},
      Part{g.indices.data() == arrays.indices.data() && g.indices.size() == arrays.indices.size(), "list of indices"},
  };
  for (const Part& part : parts) {
    if (part.is_same) continue;
    return Diagnostic{.message = std::string("the ") + part.name + " is not the one that the draw was prepared with"};
  }
  return {};
}

// The data that drawing needs, in memory of exactly that size.
void keep(const BinnedBlock& block, BinnedBlock& to) {
  to.setup.primitives.assign(block.setup.primitives.begin(), block.setup.primitives.end());
  to.setup.corners.assign(block.setup.corners.begin(), block.setup.corners.end());
  to.setup.weights = block.setup.weights;
  to.indices.assign(block.indices.begin(), block.indices.end());
  to.first_tile = block.first_tile;
  to.first = block.first;
}

// Returns false if an index is out of range.
bool set_up(const DrawGeometry& geometry, std::vector<BinnedBlock>& blocks) {
  blocks.resize(geometry.blocks());
  std::atomic<bool> in_range = true;
  const auto set_up_block = [&](std::size_t b) {
    const ScratchLease scratch;
    if (scratch->blocks.empty()) scratch->blocks.resize(1);
    if (!geometry.set_up(b, scratch->blocks[0])) in_range = false;
    keep(scratch->blocks[0], blocks[b]);
  };
  if (blocks.size() == 1) {
    set_up_block(0);
  } else {
    parallel_for(blocks.size(), set_up_block);
  }
  return in_range;
}

}  // namespace

PreparedDraw::PreparedDraw() = default;
PreparedDraw::~PreparedDraw() = default;
PreparedDraw::PreparedDraw(PreparedDraw&& other) noexcept = default;
PreparedDraw& PreparedDraw::operator=(PreparedDraw&& other) noexcept = default;

Status prepare(const PipelineState& state, const glm::mat4& clip_from_object, const VertexArrays& arrays,
               const RenderTarget& target, PreparedDraw& prepared) {
  if (!prepared.geometry_) prepared.geometry_ = std::make_unique<PreparedDraw::Geometry>();
  PreparedDraw::Geometry& g = *prepared.geometry_;
  g.is_valid = false;
  g.state = geometry_state(state);
  const RenderTarget bare_target{
      .width = target.width, .height = target.height, .samples = target.samples, .format = target.format};
  const VertexArrays bare_arrays{.type = arrays.type,
                                 .positions = arrays.positions,
                                 .homogeneous_positions = arrays.homogeneous_positions,
                                 .indices = arrays.indices};
  if (Status checked = check_call(g.state, bare_arrays, {}, bare_target); !checked) return checked;
  g.one_w = has_one_w(clip_from_object, arrays);
  g.width = target.width;
  g.height = target.height;
  g.format = target.format;
  g.drawn = drawn_pixels(state, target);
  g.type = arrays.type;
  g.positions = arrays.vertex_count();
  g.indices = arrays.indices;
  const PrimitiveAssembly assembly(arrays);
  const SetupContext setup(state, viewport_of(state, target), g.drawn, target.format, true);
  const bool is_drawn = !g.drawn.empty() && assembly.primitives() > 0;
  // Setting up packed vertices checks their indices, except those left over at the end.
  const bool looks_at_indices =
      is_drawn && PrimitiveSetup::takes_packed_vertices(setup, assembly, arrays.vertex_count());
  VertexArrays unseen = bare_arrays;
  if (looks_at_indices) unseen.indices = arrays.indices.last(std::min<std::size_t>(2, arrays.indices.size()));
  if (Status checked = check_indices(unseen); !checked) return checked;
  if (!is_drawn) {
    g.blocks.clear();
  } else {
    const ScratchLease scratch;
    const TileGrid grid(target.width, target.height);
    const DrawGeometry geometry(setup, clip_from_object, bare_arrays, grid, scratch->packed);
    if (!set_up(geometry, g.blocks)) return check_indices(arrays);
  }
  g.work.collect(g.blocks);
  g.is_valid = true;
  return {};
}

namespace {

// Draws passes that share tiles, or a single pass of any kind.
void draw(const PreparedDraw::Geometry& g, std::span<const DrawPass> passes,
          std::span<const DrawContext* const> contexts, const TileActions& actions, RenderTarget& target) {
  std::deque<PixelProbe> probes = pixel_probes(*passes[0].state, passes[0].arrays, passes[0].units, target);
  const TileGrid grid(target.width, target.height);
  const bool is_timed = std::any_of(passes.begin(), passes.end(), [](const DrawPass& p) { return p.time != nullptr; });
  TileLoop loop({.grid = grid,
                 .drawn = g.drawn,
                 .passes = contexts,
                 .target = target,
                 .probes = probes,
                 .actions = actions,
                 .is_timed = is_timed});
  loop.draw(g.blocks, g.work);
  for (std::size_t i = 0; i < passes.size(); ++i) {
    if (passes[i].time != nullptr) *passes[i].time = loop.busy(i);
  }
}

}  // namespace

void mark_covering_polygons(const PreparedDraw& prepared, std::vector<bool>& covering) {
  if (!prepared.geometry_ || !prepared.geometry_->is_valid) return;
  const auto has_pixel = [](const SetupPrimitive& p) {
    if (p.kind != SetupKind::triangle) return p.kind == SetupKind::pixel;
    const TriangleEdges edges(p);
    for (int y = p.box.bottom; y <= p.box.top; ++y) {
      int first = p.box.left, last = p.box.right;
      if (edges.span(y, first, last)) return true;
    }
    return false;
  };
  for (const BinnedBlock& block : prepared.geometry_->blocks) {
    for (const SetupPrimitive& p : block.setup.primitives) {
      if (!covering[p.primitive] && has_pixel(p)) covering[p.primitive] = true;
    }
  }
}

Status rasterize(std::span<const DrawPass> passes, const PreparedDraw& prepared, const DrawActions& actions,
                 RenderTarget& target) {
  if (!prepared.geometry_ || !prepared.geometry_->is_valid) return Diagnostic{.message = "no draw has been prepared"};
  const PreparedDraw::Geometry& g = *prepared.geometry_;
  std::deque<DrawContext> contexts;
  std::vector<const DrawContext*> pointers;
  for (const DrawPass& pass : passes) {
    if (Status checked = check_call(*pass.state, pass.arrays, pass.units, target); !checked) return checked;
    if (Status checked = check_w(*pass.state, g.one_w, target); !checked) return checked;
    if (Status checked = check_prepared(g, *pass.state, pass.arrays, target); !checked) return checked;
    const DrawContext& context = contexts.emplace_back(*pass.state, pass.arrays, pass.units, target);
    if (Status checked = check_units(context); !checked) return checked;
    pointers.push_back(&context);
  }
  const bool share_tiles = TileRasterizer::can_share_tiles(pointers, target);
  const ClearValues* const clear = actions.clear ? &*actions.clear : nullptr;
  const bool fills_tiles = clear != nullptr && !passes.empty() && TileRasterizer::can_clear_tiles(pointers, target) &&
                           same(g.drawn, PixelBox{0, 0, target.width, target.height});
  if (clear != nullptr && !fills_tiles) {
    if (Status cleared = ninebit::clear({}, {}, *clear, target); !cleared) return cleared;
  }
  for (const DrawPass& pass : passes) {
    if (pass.time != nullptr) *pass.time = {};
  }
  if (g.work.tiles().empty() && !fills_tiles) return {};
  if (share_tiles && !passes.empty()) {
    draw(g, passes, pointers, {fills_tiles ? clear : nullptr, actions.discard_depth}, target);
    return {};
  }
  for (std::size_t i = 0; i < passes.size(); ++i) draw(g, passes.subspan(i, 1), {&pointers[i], 1}, {}, target);
  return {};
}

}  // namespace ninebit

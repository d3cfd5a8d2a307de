#include "ninebit/raster/rasterizer.h"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <span>

#include "src/raster/arrays_check.h"
#include "src/raster/draw_call.h"
#include "src/raster/draw_context.h"
#include "src/raster/draw_geometry.h"
#include "src/raster/draw_scratch.h"
#include "src/raster/pixel_probe.h"
#include "src/raster/setup_context.h"
#include "src/raster/tile_work.h"

namespace ninebit {
namespace {

// Blocks are set up and binned in parallel, a chunk of blocks is then drawn tile by tile. The indices are in range.
void draw(const DrawGeometry& geometry, TileLoop& tiles, DrawScratch& scratch) {
  const std::size_t blocks = geometry.blocks(), chunk = std::min(blocks, geometry.blocks_per_chunk());
  if (scratch.blocks.size() < chunk) scratch.blocks.resize(chunk);
  for (std::size_t first = 0; first < blocks; first += chunk) {
    const std::size_t count = std::min(chunk, blocks - first);
    const auto set_up = [&](std::size_t b) { static_cast<void>(geometry.set_up(first + b, scratch.blocks[b])); };
    if (count == 1) {
      set_up(0);
    } else {
      tbb::parallel_for(std::size_t{0}, count, set_up);
    }
    const std::span<const BinnedBlock> set(scratch.blocks.data(), count);
    scratch.work.look_at(set);
    tiles.draw(set, scratch.work);
  }
}

}  // namespace

Status rasterize(const PipelineState& state, const glm::mat4& clip_from_object, const VertexArrays& arrays,
                 std::span<const TextureUnit> units, RenderTarget& target) {
  if (Status checked = check_draw(state, arrays, units, target); !checked) return checked;
  if (Status checked = check_indices(arrays); !checked) return checked;
  const DrawContext context(state, arrays, units, target);
  if (Status checked = check_units(context); !checked) return checked;
  const PixelBox drawn = drawn_pixels(state, target);
  if (drawn.empty() || context.assembly.primitives() == 0) return {};

  const ScratchLease scratch;
  const TileGrid grid(target.width, target.height);
  const SetupContext setup(state, viewport_of(state, target), drawn, target.format);
  const DrawGeometry geometry(setup, clip_from_object, arrays, grid, scratch->packed);
  std::unique_ptr<PixelProbe> probe;
  if (target.probe != nullptr) probe = std::make_unique<PixelProbe>(state, arrays, units, target);
  const DrawContext* const pass = &context;
  TileLoop tiles(grid, drawn, {&pass, 1}, target, {}, false, probe.get());
  draw(geometry, tiles, *scratch);
  return {};
}

}  // namespace ninebit

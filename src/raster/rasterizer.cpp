#include "ninebit/raster/rasterizer.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/enumerable_thread_specific.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <memory>
#include <vector>

#include "src/raster/arrays_check.h"
#include "src/raster/draw_context.h"
#include "src/raster/pixel_probe.h"
#include "src/raster/primitive_setup.h"
#include "src/raster/setup_context.h"
#include "src/raster/target_check.h"
#include "src/raster/tile.h"
#include "src/raster/tile_bins.h"

namespace ninebit {
namespace {

// How a draw is cut: blocks are set up and binned in parallel, a chunk of blocks is then drawn tile by tile.
struct Cut {
  std::size_t items_per_block;
  std::size_t blocks_per_chunk;
};

// Enough blocks to keep the threads busy, and so few items that a chunk's lists stay within 2^28 entries even if as
// much as possible comes of every item and all of that covers every tile.
Cut cut_for(std::size_t tiles, std::size_t most_of_an_item) {
  const std::size_t items = (std::size_t{1} << 28) / tiles / most_of_an_item;
  const std::size_t block = std::clamp(items, std::size_t{64}, std::size_t{2048});
  return {block, std::clamp(items / block, std::size_t{1}, std::size_t{64})};
}

std::vector<glm::vec4> transform(const glm::mat4& m, std::span<const glm::vec3> positions) {
  std::vector<glm::vec4> clip(positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, clip.size(), 4096), [&](const auto& range) {
    for (std::size_t v = range.begin(); v != range.end(); ++v) {
      const glm::vec3& p = positions[v];
      for (int i = 0; i < 4; ++i) clip[v][i] = ((m[0][i] * p.x + m[1][i] * p.y) + m[2][i] * p.z) + m[3][i];
    }
  });
  return clip;
}

// The pixels within viewport and scissor.
PixelBox drawn_pixels(const PixelRect& viewport, const PixelRect& scissor) {
  return {std::max(viewport.x, scissor.x), std::max(viewport.y, scissor.y),
          std::min(viewport.x + viewport.width, scissor.x + scissor.width),
          std::min(viewport.y + viewport.height, scissor.y + scissor.height)};
}

void draw(const PrimitiveSetup& setup, const PixelBox& drawn, const DrawContext& context, const RenderTarget& target,
          PixelProbe* probe) {
  const TileGrid grid(target.width, target.height);
  const Cut cut = cut_for(grid.count(), setup.most_of_an_item());
  const std::size_t items = setup.items();
  const std::size_t blocks = (items + cut.items_per_block - 1) / cut.items_per_block;
  std::vector<BinnedBlock> chunk(std::min(blocks, cut.blocks_per_chunk));
  tbb::enumerable_thread_specific<TileRasterizer> rasterizers([&] { return TileRasterizer(context, target); });
  for (std::size_t first_block = 0; first_block < blocks; first_block += cut.blocks_per_chunk) {
    const std::size_t count = std::min(cut.blocks_per_chunk, blocks - first_block);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t b) {
      BinnedBlock& block = chunk[b];
      block.setup.primitives.clear();
      block.setup.weights.clear();
      const std::size_t begin = (first_block + b) * cut.items_per_block;
      setup.set_up(begin, std::min(begin + cut.items_per_block, items), block.setup);
      sort_into_tiles(grid, block);
    });
    tbb::parallel_for(std::size_t{0}, grid.count(), [&](std::size_t tile) {
      const PixelBox pixels = grid.pixels(tile, drawn);
      if (pixels.empty()) return;
      if (probe != nullptr && probe->lies_in(pixels)) {
        probe->meet_planes();
        for (std::size_t b = 0; b < count; ++b) probe->run(chunk[b].setup, chunk[b].in_tile(tile));
      }
      TileRasterizer& rasterizer = rasterizers.local();
      rasterizer.begin(pixels);
      for (std::size_t b = 0; b < count; ++b) rasterizer.draw(chunk[b].setup, chunk[b].in_tile(tile));
      rasterizer.end();
    });
  }
}

}  // namespace

Status rasterize(const PipelineState& state, const glm::mat4& clip_from_object, const VertexArrays& arrays,
                 std::span<const TextureUnit> units, RenderTarget& target) {
  if (Status checked = check_target(state, target); !checked) return checked;
  if (Status checked = check_state(state, target); !checked) return checked;
  if (Status checked = check_arrays(state, arrays, units); !checked) return checked;
  if (Status checked = check_output_attributes(target, arrays); !checked) return checked;
  const DrawContext context(state, arrays, units, target);
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    if (!context.samplers[unit]) continue;
    if (Status checked = check_coordinates(arrays, unit); !checked) return checked;
  }
  const PixelRect viewport = state.viewport.value_or(PixelRect{0, 0, target.width, target.height});
  const PixelBox drawn = drawn_pixels(viewport, scissored(state, target));
  if (drawn.empty() || context.assembly.primitives() == 0) return {};

  const std::vector<glm::vec4> clip = transform(clip_from_object, arrays.positions);
  const SetupContext setup_context(state, viewport, drawn, target.format);
  std::unique_ptr<PixelProbe> probe;
  if (target.probe != nullptr) probe = std::make_unique<PixelProbe>(state, arrays, units, target);
  draw(PrimitiveSetup(setup_context, context.assembly, clip), drawn, context, target, probe.get());
  return {};
}

}  // namespace ninebit

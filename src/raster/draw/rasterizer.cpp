#include "ninebit/raster/rasterizer.h"

#include <algorithm>
#include <atomic>
#include <deque>
#include <memory>
#include <numeric>
#include <span>
#include <vector>

#include "src/raster/draw/draw_check.h"
#include "src/raster/draw/draw_geometry.h"
#include "src/raster/draw/draw_scratch.h"
#include "src/raster/draw/pixel_probe.h"
#include "src/raster/draw/tile_work.h"
#include "src/raster/fragment/draw_context.h"
#include "src/raster/setup/arrays_check.h"
#include "src/raster/setup/setup_context.h"
#include "src/raster/surface/sample_planes.h"
#include "src/raster/surface/target_check.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// A chunk keeps collecting blocks while its tiles hold few primitives, because reading and writing tiles would take
// most of its time; it ends early where primitives cover many tiles.
constexpr std::size_t kEntriesPerTile = 1024, kEntriesPerChunk = std::size_t{1} << 22;

// The tiles in which blocks have primitives, recorded by several threads.
class OccupiedTiles {
 public:
  explicit OccupiedTiles(std::size_t tiles) : occupied_(tiles) {}
  void add(const BinnedBlock& block) {
    for_each_tile(block, [this](std::uint32_t tile, std::uint32_t) {
      std::atomic_ref(occupied_[tile]).store(1, std::memory_order_relaxed);
    });
  }
  // The number of occupied tiles.
  [[nodiscard]] std::size_t count() const {
    return std::accumulate(occupied_.begin(), occupied_.end(), std::size_t{0});
  }

 private:
  std::vector<std::uint8_t> occupied_;
};

// Sets up blocks in parallel, as many as memory allows whatever they hold; returns the number of blocks.
std::size_t set_up_chunk(const DrawGeometry& geometry, std::size_t first, std::vector<BinnedBlock>& to) {
  const std::size_t usual = geometry.blocks_per_chunk(), most = std::min(geometry.blocks() - first, 4 * usual);
  std::size_t count = 0, entries = 0;
  const bool allows_extra_blocks = most > usual;  // most draws have no more
  OccupiedTiles occupied(allows_extra_blocks ? geometry.grid().count() : 0);
  while (count < most && entries < kEntriesPerChunk &&
         (count < usual || most - count < usual / 2 || entries < kEntriesPerTile * occupied.count())) {
    const std::size_t end = std::min(count + geometry.blocks_at_a_time(), most);
    if (to.size() < end) to.resize(end);
    const auto set_up = [&](std::size_t b) {
      static_cast<void>(geometry.set_up(first + b, to[b]));
      if (allows_extra_blocks) occupied.add(to[b]);
    };
    if (end - count == 1) {
      set_up(count);
    } else {
      parallel_for(end - count, [&](std::size_t i) { set_up(count + i); });
    }
    for (; count < end; ++count) entries += to[count].indices.size();
  }
  return count;
}

// Sets up one chunk of blocks at a time and draws it tile by tile. The indices must be in range.
void draw(const DrawGeometry& geometry, TileLoop& tiles, DrawScratch& scratch) {
  for (std::size_t first = 0; first < geometry.blocks();) {
    const std::size_t count = set_up_chunk(geometry, first, scratch.blocks);
    const std::span<const BinnedBlock> set(scratch.blocks.data(), count);
    scratch.work.collect(set);
    tiles.draw(set, scratch.work);
    first += count;
  }
}

// Draws into a target with one sample for each pixel: `sample` of another target's pixels, if it is not null.
Status draw_sample(const PipelineState& state, const glm::mat4& clip_from_object, const VertexArrays& arrays,
                   std::span<const TextureUnit> units, RenderTarget& target, const SamplePlace* sample) {
  if (Status checked = check_call(state, arrays, units, target); !checked) return checked;
  if (Status checked = check_w(state, has_one_w(clip_from_object, arrays), target); !checked) return checked;
  if (Status checked = check_indices(arrays); !checked) return checked;
  const DrawContext context(state, arrays, units, target);
  if (Status checked = check_units(context); !checked) return checked;
  const PixelBox drawn = drawn_pixels(state, target);
  if (drawn.empty() || context.assembly.primitives() == 0) return {};

  const ScratchLease scratch;
  const TileGrid grid(target.width, target.height);
  const SetupContext setup(state, viewport_of(state, target), drawn, target.format,
                           !context.has_flat_result || target.probes != nullptr,
                           sample == nullptr ? SampleShift{} : sample->shift);
  const DrawGeometry geometry(setup, clip_from_object, arrays, grid, scratch->packed);
  std::deque<PixelProbe> probes = pixel_probes(state, arrays, units, target);
  const DrawContext* const pass = &context;
  TileLoop tiles({.grid = grid,
                  .drawn = drawn,
                  .passes = {&pass, 1},
                  .target = target,
                  .probes = probes,
                  .actions = {.is_sample = sample != nullptr}});
  draw(geometry, tiles, *scratch);
  return {};
}

}  // namespace

Status rasterize(const PipelineState& state, const glm::mat4& clip_from_object, const VertexArrays& arrays,
                 std::span<const TextureUnit> units, RenderTarget& target) {
  if (target.samples == SampleMode::center_1) {
    return draw_sample(state, clip_from_object, arrays, units, target, nullptr);
  }
  if (Status checked = check_samples(state, target); !checked) return checked;
  for (const SamplePlace& sample : sample_places(target.samples)) {
    RenderTarget planes = planes_of_sample(target, sample);
    Status drawn = draw_sample(state, clip_from_object, arrays, units, planes, &sample);
    if (!drawn) return drawn;
  }
  return {};
}

}  // namespace ninebit

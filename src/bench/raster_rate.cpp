#include "src/bench/raster_rate.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <numeric>
#include <vector>

#include "ninebit/raster/prepared_draw.h"
#include "src/bench/timing.h"

namespace ninebit::bench {

PipelineState flat_depth_state() {
  PipelineState state;
  state.shade_model = ShadeModel::flat;
  state.depth_test.enabled = true;
  return state;
}

Result<std::uint64_t> covered_pixels(const Mesh& mesh, int width, int height) {
  auto surface = Surface::make(width, height);
  if (!surface) return surface.error();
  PipelineState state;
  state.stencil_test = {.enabled = true, .front = {.depth_pass = StencilOperation::incr}};
  RenderTarget target = surface->target();
  if (Status drawn = rasterize(state, glm::mat4(1.0F), mesh.arrays(), {}, target); !drawn) return drawn.error();
  return std::accumulate(surface->stencil().begin(), surface->stencil().end(), std::uint64_t{0});
}

namespace {

// The duration of the shortest call of `draw` in seconds. The surface is cleared before each call.
template <class Draw>
Result<double> shortest_seconds(Surface& surface, double seconds, const Draw& draw) {
  double shortest = 1e9;
  const auto start = Clock::now();
  for (int runs = 0; runs < 2 || seconds_since(start) < seconds; ++runs) {
    surface.fill({});
    Status drawn;
    shortest = std::min(shortest, seconds_of([&] { drawn = draw(); }));
    if (!drawn) return drawn.error();
  }
  return shortest;
}

}  // namespace

Result<double> seconds_to_draw(const Mesh& mesh, Surface& surface, double seconds) {
  const PipelineState state = flat_depth_state();
  const VertexArrays arrays = mesh.arrays();
  RenderTarget target = surface.target();
  return shortest_seconds(surface, seconds, [&] { return rasterize(state, glm::mat4(1.0F), arrays, {}, target); });
}

Result<double> seconds_to_prepare_and_draw(const Mesh& mesh, Surface& surface, double seconds) {
  const PipelineState state = flat_depth_state();
  const VertexArrays arrays = mesh.arrays();
  RenderTarget target = surface.target();
  PreparedDraw prepared;
  return shortest_seconds(surface, seconds, [&] {
    Status made = prepare(state, glm::mat4(1.0F), arrays, target, prepared);
    return made ? rasterize(state, prepared, arrays, {}, target) : made;
  });
}

double memset_rate(std::size_t bytes, int threads, double seconds) {
  // One run fills everything so often that the threads' meeting does not count.
  constexpr int kFills = 8;
  const auto count = static_cast<std::size_t>(threads);
  const std::size_t piece = bytes / count;
  std::vector<std::uint8_t> memory(count * piece);
  const double shortest = shortest_together(threads, seconds, [&](std::size_t i) {
    for (int fill = 0; fill < kFills; ++fill) std::memset(memory.data() + i * piece, fill, piece);
  });
  return static_cast<double>(memory.size()) * kFills / shortest / 1e9;
}

}  // namespace ninebit::bench

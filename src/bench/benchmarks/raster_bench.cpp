// Draws depth-tested flat triangles with legs of several sizes (pixels) into a 320x240 target. Items are triangles.
#include <benchmark/benchmark.h>

#include "src/bench/raster_rate.h"

namespace {

using namespace ninebit;

void flat_triangles(benchmark::State& state) {
  constexpr int kWidth = 320, kHeight = 240;
  const bench::Mesh mesh = bench::small_triangles(kWidth, kHeight, static_cast<float>(state.range(0)));
  const PipelineState pipeline = bench::flat_depth_state();
  const VertexArrays arrays = mesh.arrays();
  auto surface = Surface::make(kWidth, kHeight);
  RenderTarget target = surface->target();
  for ([[maybe_unused]] auto _ : state) {
    surface->fill({});
    if (!rasterize(pipeline, glm::mat4(1.0F), arrays, {}, target)) state.SkipWithError("not drawn");
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) *
                          static_cast<std::int64_t>(mesh.triangles.size()));
}
BENCHMARK(flat_triangles)->Arg(1)->Arg(4)->Arg(16)->Arg(32)->UseRealTime();

}  // namespace

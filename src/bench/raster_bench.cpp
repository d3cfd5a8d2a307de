// Depth-tested flat triangles of several sizes into a 1024x768 target; items are triangles.
#include <benchmark/benchmark.h>

#include <random>
#include <vector>

#include "ninebit/raster/rasterizer.h"

namespace {

using namespace ninebit;

void flat_triangles(benchmark::State& state) {
  const float leg = static_cast<float>(state.range(0)) / 512.0F;  // of a target of 1024 pixels
  std::mt19937 random(1);
  std::uniform_real_distribution<float> place(-1.0F, 1.0F);
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<ColorBytes> colors;
  for (std::uint32_t i = 0; i < 20000; ++i) {
    const glm::vec3 corner(place(random), place(random), place(random));
    positions.insert(positions.end(), {corner, corner + glm::vec3(leg, 0, 0), corner + glm::vec3(0, leg, 0)});
    triangles.emplace_back(3 * i, 3 * i + 1, 3 * i + 2);
    colors.push_back({static_cast<std::uint8_t>(i), static_cast<std::uint8_t>(i >> 8), 0, 255});
  }
  PipelineState pipeline;
  pipeline.shade_model = ShadeModel::flat;
  pipeline.depth_test.enabled = true;
  auto surface = Surface::make(1024, 768);
  RenderTarget target = surface->target();
  VertexArrays arrays{.positions = positions, .indices = index_list(triangles)};
  arrays.primitive_colors = colors;
  for (auto _ : state) {
    surface->fill({});
    if (!rasterize(pipeline, glm::mat4(1.0F), arrays, {}, target)) state.SkipWithError("not drawn");
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * static_cast<std::int64_t>(triangles.size()));
}
BENCHMARK(flat_triangles)->Arg(1)->Arg(4)->Arg(32)->UseRealTime();

}  // namespace

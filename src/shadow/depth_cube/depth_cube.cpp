// The technique's entry point: renders one frame.
#include "ninebit/shadow/depth_cube.h"

#include <optional>
#include <utility>

#include "src/frame/pass_timer.h"
#include "src/shadow/depth_cube/depth_cube_renderer.h"

namespace ninebit {
namespace {

// The passes that mark shadow: 6 with 8 bits, 12 with 16 bits.
Status draw_comparisons(DepthCubeRenderer& renderer, PassTimer& timer, double& milliseconds) {
  const auto& comparisons = renderer.passes().comparisons;
  if (comparisons.empty()) {
    return timer.run("comparison", 0.5, milliseconds, [&] { return renderer.compare_floats(); });
  }
  const double share = 0.4 / static_cast<double>(6 * comparisons.size());
  for (std::size_t i = 0; i < comparisons.size(); ++i) {
    for (std::size_t face = 0; face < 6; ++face) {
      const double done = 0.5 + share * static_cast<double>(6 * i + face);
      Status drawn =
          timer.run(comparisons[i].name, done, milliseconds, [&] { return renderer.draw_comparison(i, face); });
      if (!drawn) return drawn;
    }
  }
  return {};
}

}  // namespace

Result<Rendering> render_depth_cube(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  std::optional<DepthCubeRenderer> renderer;
  PassTimer timer(progress);
  PassTimes times;
  double colors = 0.0;
  Status status =
      timer.make("ramps", 0.0, times.transform, renderer, [&] { return DepthCubeRenderer::make(scene, settings); });
  for (std::size_t face = 0; face < 6 && status; ++face) {
    status = timer.run("depth cube map", 0.1 + 0.05 * static_cast<double>(face), times.maps,
                       [&] { return renderer->draw_map(face); });
  }
  if (status) status = timer.run("depth", 0.4, times.camera, [&] { return renderer->draw_depth(); });
  if (status) status = draw_comparisons(*renderer, timer, times.compare);
  if (status && settings.light_facing) {
    status = timer.run("averted", 0.9, times.compare, [&] { return renderer->draw_averted(); });
  }
  // draw_lit_and_shadow takes the times of its passes itself.
  if (status) status = timer.run("colours", 0.9, colors, [&] { return renderer->draw_lit_and_shadow(); });
  if (status) status = renderer->add_evidence();
  if (!status) return status.error();
  renderer->finish();
  PassTimes& taken = renderer->rendering().times;
  times.lit = taken.lit;
  times.shadow = taken.shadow;
  taken = times;
  return std::move(renderer->rendering());
}

}  // namespace ninebit

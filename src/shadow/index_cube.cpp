// The technique: one frame.
#include "ninebit/shadow/index_cube.h"

#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include "src/shadow/index_cube_renderer.h"

namespace ninebit {

Result<Rendering> render_index_cube(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  using Clock = std::chrono::steady_clock;
  std::optional<IndexCubeRenderer> renderer;
  const auto make = [&]() -> Status {
    auto made = IndexCubeRenderer::make(scene, settings);
    if (!made) return made.error();
    renderer.emplace(std::move(*made));
    return {};
  };
  PassTimes times;
  const auto run = [&](std::string_view name, double done, double* milliseconds, const auto& work) -> Status {
    if (progress && !progress(name, done)) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    const auto start = Clock::now();
    Status status = work();
    if (milliseconds != nullptr) {
      *milliseconds = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    }
    return status;
  };
  Status status = run("indices", 0.0, &times.transform, make);
  if (status) status = run("index cube map", 0.1, &times.maps, [&] { return renderer->draw_maps(); });
  if (status) status = run("camera's passes", 0.5, nullptr, [&] { return renderer->draw_camera(times); });
  if (!status) return status.error();
  renderer->count();
  renderer->rendering().times = times;
  return std::move(renderer->rendering());
}

}  // namespace ninebit

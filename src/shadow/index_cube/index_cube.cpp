// The technique's entry point: renders one frame.
#include "ninebit/shadow/index_cube.h"

#include <optional>
#include <utility>

#include "src/frame/pass_timer.h"
#include "src/shadow/index_cube/index_cube_renderer.h"

namespace ninebit {

Result<Rendering> render_index_cube(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  std::optional<IndexCubeRenderer> renderer;
  PassTimer timer(progress);
  PassTimes times;
  double camera = 0.0;
  Status status =
      timer.make("indices", 0.0, times.transform, renderer, [&] { return IndexCubeRenderer::make(scene, settings); });
  if (status) status = timer.run("index cube map", 0.1, times.maps, [&] { return renderer->draw_maps(); });
  if (status) renderer->find_vanished();
  if (status) status = timer.run("camera's passes", 0.5, camera, [&] { return renderer->draw_camera(); });
  if (status) status = renderer->add_evidence();
  if (status) status = renderer->finish();
  if (!status) return status.error();
  renderer->rendering().times.transform = times.transform;
  renderer->rendering().times.maps = times.maps;
  return std::move(renderer->rendering());
}

}  // namespace ninebit

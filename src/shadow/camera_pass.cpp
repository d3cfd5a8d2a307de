#include "src/shadow/camera_pass.h"

#include <utility>

namespace ninebit {

Status CameraPasses::draw(std::string_view name, const PipelineState& state, const VertexArrays& arrays,
                          std::span<const TextureUnit> units, RenderTarget& target,
                          std::span<const std::uint32_t> scene_triangles) const {
  if (!settings.pixel) return rasterize(state, projection, arrays, units, target);
  FragmentProbe probe{.x = settings.pixel->x, .y = settings.pixel->y};
  target.probe = &probe;
  Status drawn = rasterize(state, projection, arrays, units, target);
  target.probe = nullptr;
  if (!scene_triangles.empty()) {
    for (ProbedFragment& fragment : probe.fragments) fragment.primitive = scene_triangles[fragment.primitive];
  }
  rendering.probed.push_back({std::string(name), state.program, std::move(probe.fragments)});
  return drawn;
}

}  // namespace ninebit

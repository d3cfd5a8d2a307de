// The light's view: position, normal, flux and depth in one pass.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "ninebit/shadow/reflective.h"
#include "src/frame/camera_frame.h"
#include "src/frame/surface_planes.h"
#include "src/frame/views.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

constexpr float kLargestHalf = 65504.0F;

}  // namespace

Status check_reflective_map(const Scene& scene, int map_size) {
  if (Status checked = check_map_size(map_size); !checked) return checked;
  if (map_size > kMaxReflectiveMapSize) {
    return Diagnostic{.message = fmt::format("map size {}: a reflective shadow map has at most {} texels a side",
                                             map_size, kMaxReflectiveMapSize)};
  }
  const Bounds bounds = bounds_of(scene);
  const glm::vec3 farthest = glm::max(glm::abs(bounds.low), glm::abs(bounds.high));
  const float largest = std::max({farthest.x, farthest.y, farthest.z});
  if (largest <= kLargestHalf) return {};
  return Diagnostic{.message = fmt::format("the scene reaches to {}; a reflective shadow map holds positions in half "
                                           "floats, up to {}",
                                           largest, kLargestHalf)};
}

PipelineState reflective_map_pass(const RenderSettings& settings) {
  return frame_passes(settings).depth;
}

Result<ReflectiveMap> draw_reflective_map(const Scene& scene, const RenderSettings& settings) {
  if (Status checked = check_reflective_map(scene, settings.map_size); !checked) return checked.error();
  const Light& light = scene.lights[0];
  ReflectiveMap map{.size = settings.map_size, .clip_from_world = light_projection(scene, light)};
  const auto texels = static_cast<std::size_t>(map.size) * static_cast<std::size_t>(map.size);
  std::array<std::vector<float>, 3> normal;
  for (std::size_t c = 0; c < 3; ++c) {
    map.position[c].resize(texels);
    map.normal[c].resize(texels);
    map.flux[c].resize(texels);
    normal[c].resize(texels);
  }
  map.depth.assign(texels, max_depth(DepthStencilFormat::d24s8));

  const SurfaceAttributes attributes = surface_attributes(scene, light.color * kFluxOfWhiteLight);
  RenderTarget target{.width = map.size, .height = map.size};
  target.depth = {map.depth.data(), map.size};
  capture_surface(map.position, SurfaceAttributes::kPosition, map.size, target);
  capture_surface(normal, SurfaceAttributes::kNormal, map.size, target);
  capture_surface(map.flux, SurfaceAttributes::kColor, map.size, target);
  VertexArrays arrays = attributes.arrays();
  arrays.positions = scene.positions;
  arrays.indices = index_list(scene.triangles);
  const Status drawn = rasterize(reflective_map_pass(settings), map.clip_from_world, arrays, {}, target);
  if (!drawn) return drawn.error();

  parallel_for(texels, [&](std::size_t i) {
    const glm::vec3 unit = unit_or_zero({normal[0][i], normal[1][i], normal[2][i]});
    for (std::size_t c = 0; c < 3; ++c) map.normal[c][i] = half_of(unit[static_cast<glm::length_t>(c)]);
  });
  return map;
}

std::vector<glm::dvec3> positions_from_depth(const ReflectiveMap& map) {
  const glm::dmat4 world_from_clip = glm::inverse(glm::dmat4(map.clip_from_world));
  const std::uint32_t farthest = max_depth(DepthStencilFormat::d24s8);
  std::vector<glm::dvec3> positions(map.depth.size(), glm::dvec3(0.0));
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (map.depth[i] == farthest) continue;
    const auto size = static_cast<std::size_t>(map.size);
    const glm::dvec2 pixel(i % size, i / size);  // column and row
    const glm::dvec3 window((pixel + 0.5) / static_cast<double>(map.size),
                            static_cast<double>(map.depth[i]) / farthest);
    const glm::dvec4 world = world_from_clip * glm::dvec4(window * 2.0 - 1.0, 1.0);
    positions[i] = glm::dvec3(world) / world.w;
  }
  return positions;
}

}  // namespace ninebit

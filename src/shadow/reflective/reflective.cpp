// The technique's entry point: renders one frame.
#include "ninebit/shadow/reflective.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "ninebit/shadow/shadow_map.h"
#include "src/frame/camera_frame.h"
#include "src/frame/drawn_passes.h"
#include "src/frame/packed_map.h"
#include "src/frame/surface_groups.h"
#include "src/frame/views.h"
#include "src/shadow/reflective/indirect_light.h"
#include "src/shadow/reflective/reflective_reference.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

namespace {

// The largest distance between two pixels that share light, divided by the scene's diagonal.
constexpr float kSimilarDistance = 1.0F / 16.0F;

Status check_settings(const ReflectiveSettings& s) {
  const auto outside = [](std::string message) { return Diagnostic{.message = std::move(message)}; };
  if (s.samples < 1 || s.samples > kMaxPixelLights) {
    return outside(fmt::format("{} samples; expected 1 to {}", s.samples, kMaxPixelLights));
  }
  if (!(s.kernel >= 1.0F && s.kernel <= static_cast<float>(kMaxSurfaceSize))) {
    return outside(fmt::format("kernel radius {}; expected 1 to {} texels", s.kernel, kMaxSurfaceSize));
  }
  if (s.gather_scale < 1 || s.gather_scale > kMaxGatherScale) {
    return outside(fmt::format("gather scale {}; expected 1 to {}", s.gather_scale, kMaxGatherScale));
  }
  return {};
}

std::uint8_t byte_of(float value) {
  return static_cast<std::uint8_t>(std::clamp(value, 0.0F, 1.0F) * 255.0F + 0.5F);
}

class ReflectiveRenderer {
 public:
  // Adds indirect light to a rendering of the direct light.
  ReflectiveRenderer(const Scene& scene, const RenderSettings& settings, Rendering direct, const Progress& progress)
      : scene_(scene), settings_(settings), rendering_(std::move(direct)), timer_(progress), progress_(progress) {}

  Status render();
  [[nodiscard]] Rendering& rendering() { return rendering_; }

 private:
  Status draw_map();
  Status draw_surface();
  Status gather();
  Status judge();
  void compose();
  void keep_layers();
  void keep_maps();

  [[nodiscard]] Continue between(std::string_view pass, double from, double to) const {
    return [this, pass, from, to](double done) { return !progress_ || progress_(pass, from + (to - from) * done); };
  }
  // Adds an upright picture made of one byte per pixel and colour.
  template <class Byte>
  void add_picture(const char* file, const Byte& byte_at);

  const Scene& scene_;
  const RenderSettings& settings_;
  Rendering rendering_;
  PassTimer timer_;
  Progress progress_;
  ReflectiveMap map_;
  PixelLights lights_;
  VisibleSurface surface_;
  std::vector<bool> drawn_;
  std::optional<IndirectLight> indirect_;
  std::array<PlaneSamples<std::uint8_t>, 3> direct_;
};

Status ReflectiveRenderer::draw_map() {
  auto map = draw_reflective_map(scene_, settings_);
  if (!map) return map.error();
  map_ = std::move(*map);
  note_pass(rendering_, "reflective map", reflective_map_pass(settings_));
  rendering_.map_bytes += map_.depth.size() * sizeof map_.depth[0];
  for (const auto* planes : {&map_.position, &map_.normal, &map_.flux}) {
    for (const auto& plane : *planes) rendering_.map_bytes += plane.size() * sizeof plane[0];
  }
  lights_ = pixel_lights(map_, scene_.lights[0], settings_.reflective.pattern);
  return {};
}

// Draws the visible surface again, and captures its position, normal and colour.
Status ReflectiveRenderer::draw_surface() {
  Surface& frame = rendering_.frame;
  surface_.width = frame.width();
  surface_.height = frame.height();
  RenderTarget target = frame.target();
  target.outputs.clear();
  int attribute = 0;
  for (auto* planes : {&surface_.position, &surface_.normal, &surface_.color}) {
    for (auto& plane : *planes) plane.assign(frame.depth().size(), 0.0F);
    capture_surface(*planes, attribute++, frame.width(), target);
  }
  const SurfaceAttributes attributes = surface_attributes(scene_, glm::vec3(1.0F));
  VertexArrays arrays = attributes.arrays();
  arrays.positions = scene_.positions;
  arrays.indices = index_list(scene_.triangles);
  const float aspect = static_cast<float>(frame.width()) / static_cast<float>(frame.height());
  const glm::mat4 projection = camera_projection(scene_, scene_.cameras[0], aspect);
  const PipelineState state = surface_pass(settings_);
  note_pass(rendering_, "surface", state);
  if (Status drawn = rasterize(state, projection, arrays, {}, target); !drawn) return drawn;
  drawn_.resize(frame.depth().size());
  for (std::size_t i = 0; i < drawn_.size(); ++i) drawn_[i] = frame.depth()[i] != max_depth(frame.format());
  return {};
}

Status ReflectiveRenderer::gather() {
  const ReflectiveSettings& settings = settings_.reflective;
  note_float_pass(rendering_, "gathering", false);
  indirect_.emplace(map_, lights_, surface_, make_pattern(settings), settings.kernel);
  return indirect_->compute(drawn_, settings.gather_scale, bounds_of(scene_).diagonal() * kSimilarDistance,
                            between("indirect light", 0.3, 0.85));
}

// Adds the indirect light to the direct light of the lit and shadow passes.
void ReflectiveRenderer::compose() {
  RenderTarget target = rendering_.frame.target();
  for (std::size_t c = 0; c < 3; ++c) {
    direct_[c] = rendering_.frame.color(static_cast<int>(c));
    std::uint8_t* const color = target.color[c].data;
    for (std::size_t i = 0; i < drawn_.size(); ++i) {
      if (!drawn_[i]) continue;
      const float light = surface_.color[c][i] * std::clamp(indirect_->irradiance()[c][i], 0.0F, 1.0F);
      color[i] = static_cast<std::uint8_t>(std::min(255, direct_[c][i] + byte_of(light)));
    }
  }
  add_picture("direct.png", [&](std::size_t c, std::size_t i) { return direct_[c][i]; });
  add_picture("indirect.png", [&](std::size_t c, std::size_t i) { return byte_of(indirect_->irradiance()[c][i]); });
  add_picture("difference.png", [&](std::size_t c, std::size_t i) {
    return static_cast<std::uint8_t>(rendering_.frame.color(static_cast<int>(c))[i] - direct_[c][i]);
  });
}

template <class Byte>
void ReflectiveRenderer::add_picture(const char* file, const Byte& byte_at) {
  const auto size = static_cast<std::size_t>(surface_.width) * static_cast<std::size_t>(surface_.height);
  Image8 image{surface_.width, surface_.height, 3, {}};
  image.pixels.resize(size * 3);
  for (std::size_t i = 0; i < size; ++i) {
    const std::size_t to = upright_index(i, surface_.width, surface_.height) * 3;
    for (std::size_t c = 0; c < 3; ++c) image.pixels[to + c] = byte_at(c, i);
  }
  rendering_.pictures.push_back({file, std::move(image)});
}

Status ReflectiveRenderer::judge() {
  std::vector<Fact>& facts = rendering_.facts;
  const auto error = indirect_error(lights_, surface_, drawn_, *indirect_, between("whole map", 0.85, 1.0));
  if (!error) return error.error();
  facts.push_back({"indirect_reference_pixels", error->pixels});
  facts.push_back({"indirect_reference_mean", error->reference_mean});
  facts.push_back({"indirect_mean_error", error->mean});
  facts.push_back({"indirect_max_error", error->max});
  const std::vector<glm::dvec3> rebuilt = positions_from_depth(map_);
  double farthest = 0.0;
  for (std::size_t i = 0; i < rebuilt.size(); ++i) {
    const glm::dvec3 stored(float_of(map_.position[0][i]), float_of(map_.position[1][i]),
                            float_of(map_.position[2][i]));
    farthest = std::max(farthest, glm::length(stored - rebuilt[i]));
  }
  facts.push_back({"position_max_difference", farthest});
  return {};
}

void ReflectiveRenderer::keep_layers() {
  const auto keep = [&](const char* part, const char* channels, auto& planes) {
    using Samples = std::decay_t<decltype(planes[0])>;
    for (std::size_t c = 0; c < 3; ++c) {
      auto& layer = add_layer<typename Samples::value_type>(rendering_.layers, part, std::string(1, channels[c]),
                                                            surface_.width, surface_.height);
      layer.assign(planes[c].begin(), planes[c].end());
    }
  };
  keep("surface_position", "XYZ", surface_.position);
  keep("surface_normal", "XYZ", surface_.normal);
  keep("surface_color", "RGB", surface_.color);
  keep("direct", "RGB", direct_);
  std::array<std::vector<float>, 3> clamped = indirect_->irradiance();
  for (auto& plane : clamped) {
    for (float& value : plane) value = std::clamp(value, 0.0F, 1.0F);
  }
  keep("indirect", "RGB", clamped);
}

void ReflectiveRenderer::keep_maps() {
  const auto keep = [&](const char* part, std::string channel, auto samples) {
    rendering_.maps.push_back(Layer{part, std::move(channel), map_.size, map_.size, std::move(samples)});
  };
  for (std::size_t c = 0; c < 3; ++c) keep("rsm_position", std::string(1, "XYZ"[c]), std::move(map_.position[c]));
  for (std::size_t c = 0; c < 3; ++c) keep("rsm_normal", std::string(1, "XYZ"[c]), std::move(map_.normal[c]));
  for (std::size_t c = 0; c < 3; ++c) keep("rsm_flux", std::string(1, "RGB"[c]), std::move(map_.flux[c]));
  keep("rsm_depth", "depth", std::move(map_.depth));
}

Status ReflectiveRenderer::render() {
  PassTimes& times = rendering_.times;
  double reference = 0.0;
  Status s = timer_.run("reflective shadow map", 0.2, times.maps, [&] { return draw_map(); });
  if (s) s = timer_.run("surface", 0.28, times.camera, [&] { return draw_surface(); });
  if (s) s = timer_.run("indirect light", 0.3, times.lit, [&] { return gather(); });
  if (!s) return s;
  compose();
  std::uint64_t there = 0;
  for (const std::uint32_t depth : map_.depth) {
    if (depth != max_depth(DepthStencilFormat::d24s8)) ++there;
  }
  rendering_.facts.push_back({"pixel_lights", there});
  rendering_.facts.push_back({"gathered_pixels", indirect_->gathered()});
  rendering_.facts.push_back({"interpolated_pixels", indirect_->interpolated()});
  if (settings_.evidence) s = timer_.run("whole map", 0.85, reference, [&] { return judge(); });
  if (!s) return s;
  if (settings_.layers) keep_layers();
  keep_maps();
  return {};
}

}  // namespace

Result<Rendering> render_reflective(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  if (Status checked = check_settings(settings.reflective); !checked) return checked.error();
  if (Status checked = check_reflective_map(scene, settings.map_size); !checked) return checked.error();
  Progress direct_progress;
  if (progress) {
    direct_progress = [&](std::string_view pass, double done) { return progress(pass, 0.2 * done); };
  }
  auto direct = render_shadow_map(scene, settings, direct_progress);
  if (!direct) return direct.error();
  ReflectiveRenderer renderer(scene, settings, std::move(*direct), progress);
  if (Status rendered = renderer.render(); !rendered) return rendered.error();
  return std::move(renderer.rendering());
}

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

#include "src/shadow/index_cube_renderer.h"

#include <fmt/format.h>
#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <bit>
#include <chrono>
#include <string>
#include <utility>

#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/sampler.h"
#include "src/shadow/camera_pass.h"
#include "src/shadow/views.h"

namespace ninebit {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

Diagnostic invalid(std::string message) {
  return Diagnostic{.message = std::move(message)};
}

Status check_settings(const Scene& scene, const RenderSettings& settings) {
  if (Status valid = validate(scene); !valid) return valid;
  if (scene.cameras.size() != 1 || scene.lights.size() != 1) {
    return invalid(fmt::format("the scene has {} cameras and {} lights; expected one of each", scene.cameras.size(),
                               scene.lights.size()));
  }
  const int n = settings.map_size;
  if (n < 1 || n > kMaxSurfaceSize || !std::has_single_bit(static_cast<unsigned>(n))) {
    return invalid(fmt::format("map size {} is not a power of two from 1 to {}", n, kMaxSurfaceSize));
  }
  return {};
}

std::uint64_t codes_used(const Scene& scene, const RenderSettings& settings) {
  return settings.index_scope == IndexScope::polygon ? scene.triangles.size() : scene.objects.size();
}

}  // namespace

Result<IndexCubeRenderer> IndexCubeRenderer::make(const Scene& scene, const RenderSettings& settings) {
  if (Status checked = check_settings(scene, settings); !checked) return checked.error();
  const Status enough =
      check_index_codes(settings.index_step, settings.index_scope, codes_used(scene, settings), scene.objects.size());
  if (!enough) return enough.error();
  auto passes = index_cube_passes(settings);
  if (!passes) return passes.error();
  auto frame = Surface::make(settings.width, settings.height, {.with_primitive = settings.layers});
  if (!frame) return frame.error();
  return IndexCubeRenderer(scene, settings, std::move(*passes), std::move(*frame));
}

IndexCubeRenderer::IndexCubeRenderer(const Scene& scene, const RenderSettings& settings, IndexCubePasses passes,
                                     Surface frame)
    : scene_(&scene),
      settings_(settings),
      passes_(std::move(passes)),
      rendering_{.frame = std::move(frame),
                 .codes = IndexCodes(settings.index_step),
                 .codes_used = codes_used(scene, settings)} {
  assign_indices();
  const PointLight& light = scene.lights[0];
  shading_ = shade_vertices(scene, light, settings.light_facing, settings.profile);
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  camera_projection_ = ninebit::camera_projection(scene, scene.cameras[0], aspect);
  const DepthRange range = depth_range(scene, light.position, kCubeCornerCosine);
  for (std::size_t i = 0; i < 6; ++i) face_projections_[i] = cube_face_projection(kCubeFaces[i], range);
  make_map();
}

// Indices are counted afresh for each scene, from 1: 0 is the cleared map.
void IndexCubeRenderer::assign_indices() {
  index_colors_.resize(scene_->triangles.size());
  for (std::size_t t = 0; t < index_colors_.size(); ++t) {
    const std::uint32_t number =
        settings_.index_scope == IndexScope::polygon ? static_cast<std::uint32_t>(t) : scene_->triangle_object[t];
    index_colors_[t] = rendering_.codes.color(number + 1);
  }
}

void IndexCubeRenderer::make_map() {
  const auto size = static_cast<std::size_t>(settings_.map_size);
  for (std::vector<std::uint32_t>& depth : map_depth_) depth.resize(size * size);
  rendering_.index_map.resize(6);
  std::vector<TextureImage> faces;
  for (IndexMapFace& face : rendering_.index_map) {
    face.size = settings_.map_size;
    std::array<Plane<const std::uint8_t>, 4> planes;
    for (std::size_t c = 0; c < 3; ++c) {
      face.color[c].resize(size * size);
      planes[c] = {face.color[c].data(), settings_.map_size};
    }
    faces.push_back({settings_.map_size, settings_.map_size, planes});
  }
  map_ = texture_view(InternalFormat::rgb8, faces);
}

// The cleared map is index 0. Vertices are taken relative to the light, as they are for the fetch of the comparison.
Status IndexCubeRenderer::draw_maps() {
  const glm::vec3 light = scene_->lights[0].position;
  from_light_.resize(scene_->positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, from_light_.size(), 16384), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) from_light_[i] = scene_->positions[i] - light;
  });
  VertexArrays arrays = all_triangles(from_light_);
  arrays.primitive_colors = index_colors_;
  const DrawPass pass{.state = &passes_.map, .arrays = arrays};
  std::array<Status, 6> drawn;
  tbb::parallel_for(std::size_t{0}, std::size_t{6}, [&](std::size_t i) {
    RenderTarget target{.width = settings_.map_size, .height = settings_.map_size};
    for (std::size_t c = 0; c < 3; ++c) {
      target.color[c] = {rendering_.index_map[i].color[c].data(), settings_.map_size};
    }
    target.depth = {map_depth_[i].data(), settings_.map_size};
    drawn[i] = prepare(passes_.map, face_projections_[i], arrays, target, prepared_[i]);
    if (!drawn[i]) return;
    drawn[i] = rasterize({&pass, 1}, prepared_[i], {.clear = ClearValues{}, .discard_depth = true}, target);
  });
  for (Status& status : drawn) {
    if (!status) return std::move(status);
  }
  return {};
}

Status IndexCubeRenderer::draw_camera_pass(CameraPass pass, RenderTarget& target) {
  pass.arrays.positions = scene_->positions;
  // Of a scene that has triangles, as validate demands.
  if (pass.arrays.indices.empty()) pass.arrays.indices = index_list(scene_->triangles);
  return CameraPasses{settings_, rendering_, camera_projection_}.draw(pass.name, pass.state, pass.arrays, pass.units,
                                                                      target, pass.scene_triangles);
}

// Of a scene that has triangles, as validate demands.
VertexArrays IndexCubeRenderer::all_triangles(std::span<const glm::vec3> positions) const {
  return {.positions = positions, .indices = index_list(scene_->triangles)};
}

Status IndexCubeRenderer::draw_camera(PassTimes& times) {
  if (!settings_.layers && !settings_.pixel && !settings_.light_facing) return draw_camera_together(times);
  const auto timed = [&](double& milliseconds, Status (IndexCubeRenderer::*draw)()) {
    const auto start = Clock::now();
    Status status = (this->*draw)();
    milliseconds = Milliseconds(Clock::now() - start).count();
    return status;
  };
  if (Status drawn = timed(times.camera, &IndexCubeRenderer::draw_depth); !drawn) return drawn;
  if (Status drawn = timed(times.compare, &IndexCubeRenderer::draw_comparison); !drawn) return drawn;
  if (Status drawn = timed(times.lit, &IndexCubeRenderer::draw_lit); !drawn) return drawn;
  return timed(times.shadow, &IndexCubeRenderer::draw_shadow);
}

Status IndexCubeRenderer::draw_camera_together(PassTimes& times) {
  const auto start = Clock::now();
  RenderTarget target = rendering_.frame.target();
  const VertexArrays geometry = all_triangles(scene_->positions);
  const std::array<TextureUnit, 1> units{TextureUnit{&map_, kNearestSampler}};
  std::array<std::chrono::nanoseconds, 4> busy{};
  std::array<DrawPass, 4> passes{DrawPass{.state = &passes_.depth}, DrawPass{.state = &passes_.comparison},
                                 DrawPass{.state = &passes_.lit}, DrawPass{.state = &passes_.shadow}};
  for (std::size_t i = 0; i < passes.size(); ++i) {
    passes[i].arrays = geometry;
    passes[i].time = &busy[i];
  }
  passes[1].units = units;
  passes[1].arrays.texture_coordinates[0] = from_light_;
  passes[1].arrays.primitive_colors = index_colors_;
  passes[2].arrays.vertex_colors = shading_.lit;
  passes[3].arrays.vertex_colors = shading_.shadowed;
  if (Status made = prepare(passes_.depth, camera_projection_, geometry, target, prepared_[0]); !made) return made;
  const ClearValues background{.color = kBackground};
  if (Status drawn = rasterize(passes, prepared_[0], {.clear = background}, target); !drawn) return drawn;
  const double whole = Milliseconds(Clock::now() - start).count();
  const double all = Milliseconds(busy[0] + busy[1] + busy[2] + busy[3]).count();
  const auto share = [&](std::size_t i) { return all > 0.0 ? whole * Milliseconds(busy[i]).count() / all : whole / 4; };
  times.camera = share(0);
  times.compare = share(1);
  times.lit = share(2);
  times.shadow = share(3);
  return {};
}

Status IndexCubeRenderer::draw_depth() {
  rendering_.probed.clear();
  rendering_.frame.fill({.color = kBackground});
  RenderTarget target = rendering_.frame.target();
  target.outputs.clear();
  return draw_camera_pass({.name = "depth", .state = passes_.depth, .arrays = {}}, target);
}

// What the index says of a surface that is turned away from the light is of no interest with light_facing: it is in
// shadow.
Status IndexCubeRenderer::draw_comparison() {
  RenderTarget target = rendering_.frame.target();
  target.outputs.clear();
  if (settings_.layers) add_layers(target);
  const std::array<TextureUnit, 1> units{TextureUnit{&map_, kNearestSampler}};
  CameraPass comparison{.name = "comparison", .state = passes_.comparison, .arrays = {}, .units = units};
  comparison.arrays.texture_coordinates[0] = from_light_;
  comparison.arrays.primitive_colors = index_colors_;
  if (!settings_.light_facing) return draw_camera_pass(comparison, target);

  TriangleSet compared, averted;
  split_by_facing(compared, averted);
  if (!compared.triangles.empty()) {
    comparison.arrays.indices = index_list(compared.triangles);
    comparison.arrays.primitive_colors = compared.index_colors;
    comparison.scene_triangles = compared.numbers;
    if (Status drawn = draw_camera_pass(comparison, target); !drawn) return drawn;
  }
  if (averted.triangles.empty()) return {};
  target.outputs.clear();
  CameraPass away{.name = "averted", .state = passes_.averted, .arrays = {}, .scene_triangles = averted.numbers};
  away.arrays.indices = index_list(averted.triangles);
  return draw_camera_pass(away, target);
}

Status IndexCubeRenderer::draw_lit() {
  RenderTarget target = rendering_.frame.target();
  CameraPass lit{.name = "lit", .state = passes_.lit, .arrays = {}};
  lit.arrays.vertex_colors = shading_.lit;
  return draw_camera_pass(lit, target);
}

Status IndexCubeRenderer::draw_shadow() {
  RenderTarget target = rendering_.frame.target();
  CameraPass shadow{.name = "shadow", .state = passes_.shadow, .arrays = {}};
  shadow.arrays.vertex_colors = shading_.shadowed;
  return draw_camera_pass(shadow, target);
}

bool IndexCubeRenderer::faces_light(const glm::uvec3& t) const {
  const auto& p = scene_->positions;
  const glm::vec3 normal_times_area = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
  return glm::dot(normal_times_area, scene_->lights[0].position - p[t.x]) > 0.0F;
}

void IndexCubeRenderer::split_by_facing(TriangleSet& compared, TriangleSet& averted) const {
  for (std::size_t t = 0; t < scene_->triangles.size(); ++t) {
    TriangleSet& set = faces_light(scene_->triangles[t]) ? compared : averted;
    set.triangles.push_back(scene_->triangles[t]);
    set.index_colors.push_back(index_colors_[t]);
    set.numbers.push_back(static_cast<std::uint32_t>(t));
  }
}

void IndexCubeRenderer::add_layers(RenderTarget& target) {
  ComparisonLayers& layers = rendering_.layers.emplace();
  const std::size_t pixels = rendering_.frame.stencil().size();
  const auto add = [&](OutputSource source, Register reg, int component, std::vector<s9>& plane) {
    plane.assign(pixels, 0);
    target.outputs.push_back({.source = source,
                              .reg = reg,
                              .component = component,
                              .time = OutputTime::at_depth_pass,
                              .plane = Plane<s9>{plane.data(), settings_.width}});
  };
  const auto capture = [&](Register reg, int component, std::vector<s9>& plane) {
    add(OutputSource::register_code, reg, component, plane);
  };
  for (int c = 0; c < 4; ++c) {
    const auto i = static_cast<std::size_t>(c);
    if (c < 3) capture(Register::primary, c, layers.primary[i]);
    if (c < 3) capture(Register::texture0, c, layers.texture0[i]);
    capture(Register::spare0, c, layers.spare0[i]);
    capture(Register::spare1, c, layers.spare1[i]);
  }
  add(OutputSource::output_code, Register::spare0, kAlpha, layers.output_alpha);
}

void IndexCubeRenderer::count() {
  const Surface& frame = rendering_.frame;
  rendering_.background = rendering_.lit = rendering_.shadowed = 0;
  for (std::size_t i = 0; i < frame.stencil().size(); ++i) {
    if (frame.depth()[i] == max_depth(frame.format())) {
      ++rendering_.background;
    } else if (frame.stencil()[i] == 0) {
      ++rendering_.lit;
    } else {
      ++rendering_.shadowed;
    }
  }
  if (rendering_.layers) name_polygons(*rendering_.layers);
}

// From the triangles that the lit and shadow passes drew.
void IndexCubeRenderer::name_polygons(ComparisonLayers& layers) const {
  const std::vector<std::uint32_t>& drawn = rendering_.frame.primitive();
  layers.polygon.assign(drawn.size(), 0);
  layers.object.assign(drawn.size(), 0);
  for (std::size_t i = 0; i < drawn.size(); ++i) {
    if (drawn[i] >= scene_->triangles.size()) continue;
    layers.polygon[i] = drawn[i] + 1;
    layers.object[i] = scene_->triangle_object[drawn[i]] + 1;
  }
}

}  // namespace ninebit

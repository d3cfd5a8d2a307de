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
#include "src/shadow/map_evidence.h"
#include "src/shadow/views.h"

namespace ninebit {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

std::uint64_t codes_used(const Scene& scene, const RenderSettings& settings) {
  return settings.index.scope == IndexScope::polygon ? scene.triangles.size() : scene.objects.size();
}

}  // namespace

Result<IndexCubeRenderer> IndexCubeRenderer::make(const Scene& scene, const RenderSettings& settings) {
  auto frame = CameraFrame::make(scene, settings, {.point = true});
  if (!frame) return frame.error();
  if (Status checked = check_map_size(settings.map_size); !checked) return checked.error();
  const Status enough =
      check_index_codes(settings.index.step, settings.index.scope, codes_used(scene, settings), scene.objects.size());
  if (!enough) return enough.error();
  auto passes = index_cube_passes(settings);
  if (!passes) return passes.error();
  return IndexCubeRenderer(std::move(*frame), std::move(*passes));
}

IndexCubeRenderer::IndexCubeRenderer(CameraFrame frame, IndexCubePasses passes)
    : frame_(std::move(frame)), passes_(std::move(passes)) {
  rendering().codes = IndexCodes(frame_.settings().index.step);
  rendering().codes_used = codes_used(frame_.scene(), frame_.settings());
  assign_indices();
  const DepthRange range = depth_range(frame_.scene(), frame_.light().position, kCubeCornerCosine);
  for (std::size_t i = 0; i < 6; ++i) face_projections_[i] = cube_face_projection(kCubeFaces[i], range);
  make_map();
}

// Indices are counted afresh for each scene, from 1: 0 is the cleared map.
void IndexCubeRenderer::assign_indices() {
  const Scene& scene = frame_.scene();
  const bool by_polygon = frame_.settings().index.scope == IndexScope::polygon;
  index_colors_.resize(scene.triangles.size());
  for (std::size_t t = 0; t < index_colors_.size(); ++t) {
    const std::uint32_t number = by_polygon ? static_cast<std::uint32_t>(t) : scene.triangle_object[t];
    index_colors_[t] = rendering().codes.color(number + 1);
  }
}

void IndexCubeRenderer::make_map() {
  const auto size = static_cast<std::size_t>(frame_.settings().map_size);
  for (std::vector<std::uint32_t>& depth : map_depth_) depth.resize(size * size);
  rendering().index_map.resize(6);
  std::vector<TextureImage> faces;
  for (IndexMapFace& face : rendering().index_map) {
    face.size = frame_.settings().map_size;
    std::array<Plane<const std::uint8_t>, 4> planes;
    for (std::size_t c = 0; c < 3; ++c) {
      face.color[c].resize(size * size);
      planes[c] = {face.color[c].data(), frame_.settings().map_size};
    }
    faces.push_back({frame_.settings().map_size, frame_.settings().map_size, planes});
  }
  map_ = texture_view(InternalFormat::rgb8, faces);
}

// The cleared map is index 0. Vertices are taken relative to the light, as they are for the fetch of the comparison.
Status IndexCubeRenderer::draw_maps() {
  const glm::vec3 light = frame_.scene().lights[0].position;
  from_light_.resize(frame_.scene().positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, from_light_.size(), 16384), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) from_light_[i] = frame_.scene().positions[i] - light;
  });
  VertexArrays arrays = all_triangles(from_light_);
  arrays.primitive_colors = index_colors_;
  const DrawPass pass{.state = &passes_.map, .arrays = arrays};
  std::array<Status, 6> drawn;
  tbb::parallel_for(std::size_t{0}, std::size_t{6}, [&](std::size_t i) {
    RenderTarget target{.width = frame_.settings().map_size, .height = frame_.settings().map_size};
    for (std::size_t c = 0; c < 3; ++c) {
      target.color[c] = {rendering().index_map[i].color[c].data(), frame_.settings().map_size};
    }
    target.depth = {map_depth_[i].data(), frame_.settings().map_size};
    drawn[i] = prepare(passes_.map, face_projections_[i], arrays, target, prepared_[i]);
    if (!drawn[i]) return;
    drawn[i] = rasterize({&pass, 1}, prepared_[i], {.clear = ClearValues{}, .discard_depth = true}, target);
  });
  for (Status& status : drawn) {
    if (!status) return std::move(status);
  }
  return {};
}

// Of a scene that has triangles, as validate demands.
VertexArrays IndexCubeRenderer::all_triangles(std::span<const glm::vec3> positions) const {
  return {.positions = positions, .indices = index_list(frame_.scene().triangles)};
}

Status IndexCubeRenderer::draw_camera() {
  const RenderSettings& settings = frame_.settings();
  if (!settings.layers && !settings.pixel && !settings.light_facing) return draw_camera_together();
  if (Status drawn = draw_shadows(); !drawn) return drawn;
  return frame_.draw_lit_and_shadow();
}

Status IndexCubeRenderer::draw_shadows() {
  PassTimes& times = rendering().times;
  times.camera = times.compare = 0.0;
  PassTimer timer({});
  if (Status drawn = timer.run("depth", 0.0, times.camera, [&] { return frame_.draw_depth(); }); !drawn) return drawn;
  return timer.run("comparison", 0.0, times.compare, [&] { return draw_comparison(); });
}

Status IndexCubeRenderer::draw_camera_together() {
  PassTimes& times = rendering().times;
  const auto start = Clock::now();
  RenderTarget target = rendering().frame.target();
  const VertexArrays geometry = all_triangles(frame_.scene().positions);
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
  passes[2].arrays.vertex_colors = frame_.shading().lit;
  passes[3].arrays.vertex_colors = frame_.shading().shadowed;
  if (Status made = prepare(passes_.depth, frame_.projection(), geometry, target, prepared_[0]); !made) return made;
  const ClearValues background{.color = CameraFrame::kBackground};
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

// What the index says of a surface that is turned away from the light is of no interest with light_facing: it is in
// shadow.
Status IndexCubeRenderer::draw_comparison() {
  RenderTarget target = frame_.capturing_target(1);
  const std::array<TextureUnit, 1> units{TextureUnit{&map_, kNearestSampler}};
  VertexArrays arrays;
  arrays.texture_coordinates[0] = from_light_;
  arrays.primitive_colors = index_colors_;
  if (!frame_.settings().light_facing) return frame_.draw("comparison", passes_.comparison, arrays, units, target);

  TriangleSet compared, averted;
  split_by_facing(compared, averted);
  if (!compared.triangles.empty()) {
    arrays.indices = index_list(compared.triangles);
    arrays.primitive_colors = compared.index_colors;
    const Status drawn = frame_.draw("comparison", passes_.comparison, arrays, units, target, compared.numbers);
    if (!drawn) return drawn;
  }
  if (averted.triangles.empty()) return {};
  target.outputs.clear();
  VertexArrays away;
  away.indices = index_list(averted.triangles);
  return frame_.draw("averted", passes_.averted, away, {}, target, averted.numbers);
}

Status IndexCubeRenderer::add_evidence() {
  const LightMap map{.pass = passes_.map,
                     .positions = from_light_,
                     .projections = face_projections_,
                     .size = frame_.settings().map_size};
  Status added = add_map_evidence(frame_, map);
  if (!added || !rendering().evidence) return added;
  for (const ColorBytes& c : index_colors_) {
    rendering().evidence->index_of_triangle.push_back(rendering().codes.number(c[kRed], c[kGreen], c[kBlue]));
  }
  return {};
}

bool IndexCubeRenderer::faces_light(const glm::uvec3& t) const {
  const auto& p = frame_.scene().positions;
  const glm::vec3 normal_times_area = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
  return glm::dot(normal_times_area, frame_.scene().lights[0].position - p[t.x]) > 0.0F;
}

void IndexCubeRenderer::split_by_facing(TriangleSet& compared, TriangleSet& averted) const {
  for (std::size_t t = 0; t < frame_.scene().triangles.size(); ++t) {
    TriangleSet& set = faces_light(frame_.scene().triangles[t]) ? compared : averted;
    set.triangles.push_back(frame_.scene().triangles[t]);
    set.index_colors.push_back(index_colors_[t]);
    set.numbers.push_back(static_cast<std::uint32_t>(t));
  }
}

}  // namespace ninebit

#include "src/shadow/index_cube/index_cube_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <string>
#include <utility>

#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/sampler.h"
#include "src/frame/drawn_passes.h"
#include "src/frame/map_evidence.h"
#include "src/frame/views.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

// A face with undrawn texels, for a map of this format.
IndexMapFace undrawn_face(IndexFormat format, int size) {
  IndexMapFace face;
  face.size = size;
  const std::array<bool, 4> stored = stored_components(map_format(format));
  const bool has_words = stored[kRed] && stored[kGreen] && stored[kBlue];
  if (has_words) face.step = 4;
  std::size_t planes = 0;
  for (std::size_t c = 0; c < 4; ++c) {
    if (!stored[c]) continue;
    face.first[c] = static_cast<std::ptrdiff_t>(has_words ? c : planes * face.texels());
    ++planes;
  }
  face.samples = undrawn_samples<std::uint8_t>((has_words ? 4 : planes) * face.texels());
  return face;
}

Status check_pick(const RenderSettings& settings) {
  if (!settings.pick) return {};
  const glm::ivec2 p = *settings.pick;
  if (p.x >= 0 && p.y >= 0 && p.x < settings.width && p.y < settings.height) return {};
  return Diagnostic{.message = fmt::format("pixel {}, {} is outside of the frame of {} x {}", p.x, p.y, settings.width,
                                           settings.height)};
}

}  // namespace

Result<IndexCubeRenderer> IndexCubeRenderer::make(const Scene& scene, const RenderSettings& settings) {
  // First, because a scene may have more polygons than there are indices.
  if (Status checked = check_index_settings(scene, settings.index); !checked) return checked.error();
  auto frame = CameraFrame::make(scene, settings, {.point = true});
  if (!frame) return frame.error();
  if (Status checked = check_map_size(settings.map_size); !checked) return checked.error();
  if (Status checked = check_pick(settings); !checked) return checked.error();
  auto indices = assign_indices(scene, settings.index, settings.profile);
  if (!indices) return indices.error();
  auto passes = index_cube_passes(settings);
  if (!passes) return passes.error();
  return IndexCubeRenderer(std::move(*frame), std::move(*passes), std::move(*indices));
}

IndexCubeRenderer::IndexCubeRenderer(CameraFrame frame, IndexCubePasses passes, IndexAssignment indices)
    : frame_(std::move(frame)), passes_(std::move(passes)), indices_(std::move(indices)) {
  rendering().codes = indices_.codes;
  rendering().codes_used = indices_.used;
  rendering().index_order = indices_.order;
  const DepthRange range = depth_range(frame_.scene(), frame_.light().position, kCubeCornerCosine);
  near_plane_ = range.near_plane;
  face_projections_ = cube_face_projections(range);
  make_map();
}

void IndexCubeRenderer::make_map() {
  const auto size = static_cast<std::size_t>(frame_.settings().map_size);
  for (PlaneSamples<std::uint32_t>& depth : map_depth_) depth = undrawn_samples<std::uint32_t>(size * size);
  std::vector<TextureImage> faces;
  for (std::size_t f = 0; f < 6; ++f) {
    rendering().index_map.push_back(undrawn_face(rendering().codes.format(), frame_.settings().map_size));
    faces.push_back(
        {frame_.settings().map_size, frame_.settings().map_size, std::array<Plane<const std::uint8_t>, 4>{}});
    auto& planes = std::get<0>(faces.back().planes);
    const std::array<Plane<std::uint8_t>, 4> drawn = face_planes(f);
    for (std::size_t c = 0; c < 4; ++c) planes[c] = {drawn[c].data, drawn[c].stride, drawn[c].step};
  }
  map_ = texture_view(map_format(rendering().codes.format()), faces);
}

// RGB faces are stored as four-byte words, and their alpha byte is drawn as well.
std::array<Plane<std::uint8_t>, 4> IndexCubeRenderer::face_planes(std::size_t f) {
  IndexMapFace& face = rendering().index_map[f];
  std::array<Plane<std::uint8_t>, 4> planes;
  for (std::size_t c = 0; c < 4; ++c) {
    const std::ptrdiff_t first = face.step == 4 ? static_cast<std::ptrdiff_t>(c) : face.first[c];
    if (first >= 0) planes[c] = {face.samples.data() + first, std::ptrdiff_t{face.step} * face.size, face.step};
  }
  return planes;
}

// The cleared map is index 0. Vertices are relative to the light, like the texture coordinates of the comparison.
Status IndexCubeRenderer::draw_maps() {
  const glm::vec3 light = frame_.scene().lights[0].position;
  from_light_.resize(frame_.scene().positions.size());
  parallel_for(from_light_.size(), kGrainOfCheapItems,
               [&](std::size_t i) { from_light_[i] = frame_.scene().positions[i] - light; });
  VertexArrays arrays = frame_.all_triangles(from_light_);
  arrays.primitive_colors = indices_.color;
  const DrawPass pass{.state = &passes_.map, .arrays = arrays};
  for (const std::string_view face : kCubeFaceNames) note_pass(rendering(), fmt::format("map {}", face), passes_.map);
  rendering().map_bytes = texture_bytes(map_);
  std::array<Status, 6> drawn;
  parallel_for(std::size_t{6}, [&](std::size_t i) {
    RenderTarget target{.width = frame_.settings().map_size, .height = frame_.settings().map_size};
    target.color = face_planes(i);
    target.depth = {map_depth_[i].data(), frame_.settings().map_size};
    drawn[i] = prepare(passes_.map, face_projections_[i], arrays, target, prepared_[i]);
    if (!drawn[i]) return;
    if (masks_map()) {
      drawn[i] = draw_masked_face(i, target);
      return;
    }
    drawn[i] = rasterize({&pass, 1}, prepared_[i], {.clear = ClearValues{}, .discard_depth = true}, target);
  });
  for (Status& status : drawn) {
    if (!status) return std::move(status);
  }
  return {};
}

// An index in alpha leaves no room for the texture's alpha.
bool IndexCubeRenderer::masks_map() const {
  const IndexFormat format = rendering().codes.format();
  return frame_.groups().masked() && (format == IndexFormat::rgb || format == IndexFormat::luminance);
}

Status IndexCubeRenderer::draw_masked_face(std::size_t face, RenderTarget& target) const {
  if (Status cleared = clear(passes_.map, {}, {}, target); !cleared) return cleared;
  const SurfaceGroups& groups = frame_.groups();
  const auto draw = [&](const TrianglePart& part, const PipelineState& state, std::span<const TextureUnit> units) {
    if (part.triangles.empty()) return Status{};
    std::vector<ColorBytes> colors;
    for (const std::uint32_t t : part.numbers) colors.push_back(indices_.color[t]);
    VertexArrays arrays{.positions = from_light_, .indices = index_list(part.triangles), .primitive_colors = colors};
    arrays.texture_coordinates[0] = groups.coordinates();
    return rasterize(state, face_projections_[face], arrays, units, target);
  };
  if (Status drawn = draw(groups.opaque_part(frame_.scene(), false), passes_.map, {}); !drawn) return drawn;
  for (std::size_t g = 0; g < groups.groups().size(); ++g) {
    const SurfaceGroup& group = groups.groups()[g];
    if (!group.least_alpha) continue;
    const std::array<TextureUnit, 1> units{TextureUnit{group.texture, group.sampler}};
    const PipelineState state = SurfaceGroups::masked_state(passes_.map, group);
    if (Status drawn = draw(groups.part(frame_.scene(), g, false), state, units); !drawn) return drawn;
  }
  return {};
}

Status IndexCubeRenderer::draw_camera() {
  const RenderSettings& settings = frame_.settings();
  const bool plain = !frame_.groups().textured() && !frame_.groups().masked();
  if (plain && !settings.layers && settings.pixels.empty() && !settings.light_facing) return draw_camera_together();
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
  const VertexArrays geometry = frame_.all_triangles(frame_.scene().positions);
  const std::array<TextureUnit, 1> units{TextureUnit{&map_, kNearestSampler}};
  std::array<std::chrono::nanoseconds, 4> busy{};
  std::array<DrawPass, 4> passes{DrawPass{.state = &passes_.depth}, DrawPass{.state = &passes_.comparison},
                                 DrawPass{.state = &passes_.lit}, DrawPass{.state = &passes_.shadow}};
  for (std::size_t i = 0; i < passes.size(); ++i) {
    passes[i].arrays = geometry;
    passes[i].time = &busy[i];
    note_pass(rendering(), std::array{"depth", "comparison", "lit", "shadow"}[i], *passes[i].state);
  }
  passes[1].units = units;
  passes[1].arrays.texture_coordinates[0] = from_light_;
  passes[1].arrays.primitive_colors = indices_.color;
  frame_.set_colors(passes[2].arrays, frame_.shading().lit);
  frame_.set_colors(passes[3].arrays, frame_.shading().shadowed);
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

// With light_facing, triangles that face away from the light are in shadow whatever their index: they are not compared.
Status IndexCubeRenderer::draw_comparison() {
  RenderTarget target = frame_.capturing_target(1);
  const std::array<TextureUnit, 1> units{TextureUnit{&map_, kNearestSampler}};
  VertexArrays arrays;
  arrays.texture_coordinates[0] = from_light_;
  arrays.primitive_colors = indices_.color;
  if (!frame_.settings().light_facing) return frame_.draw("comparison", passes_.comparison, arrays, units, target);

  const TriangleSet compared = light_facing_triangles();
  if (!compared.triangles.empty()) {
    arrays.indices = index_list(compared.triangles);
    arrays.primitive_colors = compared.index_colors;
    Status drawn = frame_.draw("comparison", passes_.comparison, arrays, units, target, compared.numbers);
    if (!drawn) return drawn;
  }
  return frame_.draw_averted(passes_.averted, [this](std::size_t t) { return faces_light(t); });
}

Status IndexCubeRenderer::add_evidence() {
  const LightMap map{.pass = passes_.map,
                     .positions = from_light_,
                     .projections = face_projections_,
                     .size = frame_.settings().map_size};
  Status added = add_map_evidence(frame_, map);
  if (!added || !rendering().evidence) return added;
  rendering().evidence->index_of_triangle = indices_.number;
  return {};
}

bool IndexCubeRenderer::faces_light(std::size_t triangle) const {
  const glm::uvec3& t = frame_.scene().triangles[triangle];
  const auto& p = frame_.scene().positions;
  const glm::vec3 normal_times_area = glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]);
  return glm::dot(normal_times_area, frame_.scene().lights[0].position - p[t.x]) > 0.0F;
}

IndexCubeRenderer::TriangleSet IndexCubeRenderer::light_facing_triangles() const {
  TriangleSet facing;
  for (std::size_t t = 0; t < frame_.scene().triangles.size(); ++t) {
    const bool is_compared = faces_light(t);
    if (!is_compared && !frame_.settings().layers) continue;
    const glm::uvec3& corners = frame_.scene().triangles[t];
    facing.triangles.push_back(is_compared ? corners : glm::uvec3(corners.x));
    facing.index_colors.push_back(indices_.color[t]);
    facing.numbers.push_back(static_cast<std::uint32_t>(t));
  }
  return facing;
}

void IndexCubeRenderer::find_vanished() {
  vanished_ = find_vanished_polygons(frame_.scene(), from_light_, prepared_, frame_.settings().map_size, near_plane_,
                                     frame_.settings().cull_face);
}

// Draws the vanished polygons again with depth test EQUAL: only their visible pixels pass.
Result<std::uint64_t> IndexCubeRenderer::count_vanished_pixels() {
  if (vanished_.triangles.empty()) return std::uint64_t{0};
  std::vector<glm::uvec3> triangles;
  triangles.reserve(vanished_.triangles.size());
  for (const std::uint32_t t : vanished_.triangles) triangles.push_back(frame_.scene().triangles[t]);
  const std::vector<ColorBytes> white(triangles.size(), ColorBytes{255, 255, 255, 255});
  std::vector<std::uint8_t> seen(rendering().frame.depth().size());
  PipelineState state = passes_.selection;
  state.scissor = {};
  RenderTarget target = rendering().frame.target();
  target.color = {Plane<std::uint8_t>{seen.data(), frame_.settings().width}};
  target.outputs.clear();
  const VertexArrays arrays{
      .positions = frame_.scene().positions, .indices = index_list(triangles), .primitive_colors = white};
  if (Status drawn = rasterize(state, frame_.projection(), arrays, {}, target); !drawn) return drawn.error();
  return static_cast<std::uint64_t>(std::count(seen.begin(), seen.end(), std::uint8_t{255}));
}

// Draws every polygon in the colour of its index, like a selection buffer, but only the picked pixel.
Status IndexCubeRenderer::pick(const glm::ivec2& pixel) {
  std::array<std::vector<std::uint8_t>, 4> planes;
  RenderTarget target = rendering().frame.target();
  target.outputs.clear();
  for (std::size_t c = 0; c < 4; ++c) {
    planes[c].resize(rendering().frame.depth().size());
    target.color[c] = {planes[c].data(), frame_.settings().width};
  }
  VertexArrays arrays = frame_.all_triangles(frame_.scene().positions);
  arrays.primitive_colors = indices_.color;
  Status drawn = rasterize(passes_.selection, frame_.projection(), arrays, {}, target);
  if (!drawn) return drawn;
  const auto at = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(frame_.settings().width) +
                  static_cast<std::size_t>(pixel.x);
  const ColorBytes color{planes[0][at], planes[1][at], planes[2][at], planes[3][at]};
  rendering().picked = owner_of(indices_.codes.number(color), frame_.scene(), frame_.settings().index.scope, indices_);
  return {};
}

Status IndexCubeRenderer::finish() {
  frame_.finish();
  const auto pixels = count_vanished_pixels();
  if (!pixels) return pixels.error();
  rendering().facts = {{"vanished_polygons", std::uint64_t{vanished_.triangles.size()}},
                       {"vanished_texels", vanished_.texels},
                       {"vanished_pixels", *pixels}};
  if (!frame_.settings().pick) return {};
  return pick(*frame_.settings().pick);
}

}  // namespace ninebit

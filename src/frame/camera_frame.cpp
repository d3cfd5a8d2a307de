#include "src/frame/camera_frame.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <utility>

#include "src/frame/drawn_passes.h"
#include "src/frame/views.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

Diagnostic invalid(std::string message) {
  return Diagnostic{.message = std::move(message)};
}

std::string names_of(const LightKinds& kinds) {
  std::string names;
  const auto add = [&](bool there, std::string_view name) {
    if (there) names += (names.empty() ? "" : " or ") + std::string(name);
  };
  add(kinds.point, "point");
  add(kinds.spot, "spot");
  add(kinds.directional, "directional");
  return names;
}

Status check_scene(const Scene& scene, const LightKinds& lights) {
  if (Status valid = validate(scene); !valid) return valid;
  if (scene.cameras.size() != 1 || scene.lights.size() != 1) {
    return invalid(fmt::format("the scene has {} cameras and {} lights; expected one of each", scene.cameras.size(),
                               scene.lights.size()));
  }
  if (lights.has(scene.lights[0].kind)) return {};
  LightKinds found{.point = false};
  (scene.lights[0].kind == LightKind::point  ? found.point
   : scene.lights[0].kind == LightKind::spot ? found.spot
                                             : found.directional) = true;
  return invalid(
      fmt::format("the scene's light is a {} light; expected a {} light", names_of(found), names_of(lights)));
}

constexpr DepthTest kWriteNearest{.enabled = true, .function = CompareFunction::less, .write = true};
// All camera passes transform and interpolate identically, so a polygon finds exactly the depth that it wrote.
constexpr DepthTest kSameSurface{.enabled = true, .function = CompareFunction::equal, .write = false};
constexpr std::array<bool, 4> kNoColor{false, false, false, false};

PipelineState base_state(const RenderSettings& settings) {
  PipelineState state;
  state.profile = settings.profile;
  state.cull_face = settings.cull_face;
  return state;
}

}  // namespace

Status check_map_size(int size) {
  if (size >= 1 && size <= kMaxSurfaceSize && std::has_single_bit(static_cast<unsigned>(size))) return {};
  return invalid(fmt::format("map size {} is not a power of two from 1 to {}", size, kMaxSurfaceSize));
}

FramePasses frame_passes(const RenderSettings& settings) {
  FramePasses passes{base_state(settings), base_state(settings), base_state(settings)};
  passes.depth.color_mask = kNoColor;
  passes.depth.depth_test = kWriteNearest;
  for (PipelineState* pass : {&passes.lit, &passes.shadow}) {
    pass->depth_test = kSameSurface;
    pass->stencil_test = {.enabled = true, .front = {.reference = 0}};
    if (settings.cartoon) pass->shade_model = ShadeModel::flat;
  }
  passes.lit.stencil_test.front.function = CompareFunction::equal;
  passes.shadow.stencil_test.front.function = CompareFunction::notequal;
  return passes;
}

PipelineState marking_pass(const RenderSettings& settings) {
  PipelineState state = base_state(settings);
  state.shade_model = ShadeModel::flat;
  state.color_mask = kNoColor;
  state.depth_test = kSameSurface;
  state.stencil_test = {.enabled = true, .front = {.reference = 1, .depth_pass = StencilOperation::replace}};
  return state;
}

PipelineState surface_pass(const RenderSettings& settings) {
  PipelineState state = marking_pass(settings);
  state.stencil_test = {};
  return state;
}

Result<CameraFrame> CameraFrame::make(const Scene& scene, const RenderSettings& settings, const LightKinds& lights) {
  if (Status checked = check_scene(scene, lights); !checked) return checked.error();
  if (stencil_bits(settings.depth_stencil) == 0) {
    std::string with_stencil;
    for (const DepthStencilLayout& layout : kDepthStencilLayouts) {
      if (layout.stencil_bits > 0) with_stencil += (with_stencil.empty() ? "" : ", ") + std::string(layout.name);
    }
    return invalid("the depth-stencil format " + std::string(layout_of(settings.depth_stencil).name) +
                   " has no stencil bits to hold shadows; expected one of " + with_stencil);
  }
  auto frame = Surface::make(settings.width, settings.height,
                             {.depth_stencil = settings.depth_stencil,
                              .with_primitive = settings.layers || settings.evidence,
                              .color = settings.color_format,
                              .undrawn = true});
  if (!frame) return frame.error();
  auto groups = SurfaceGroups::make(scene, settings);
  if (!groups) return groups.error();
  return CameraFrame(scene, settings, std::move(*frame), std::move(*groups));
}

CameraFrame::CameraFrame(const Scene& scene, const RenderSettings& settings, Surface frame, SurfaceGroups groups)
    : scene_(&scene),
      settings_(settings),
      passes_(frame_passes(settings)),
      rendering_{.frame = std::move(frame)},
      shading_(shade_vertices(scene, scene.lights[0], settings)),
      groups_(std::move(groups)),
      projection_() {
  set_projection(camera_projection(scene, scene.cameras[0],
                                   static_cast<float>(settings.width) / static_cast<float>(settings.height)));
  if (settings.evidence) rendering_.evidence.emplace();
}

void CameraFrame::set_projection(const glm::mat4& projection) {
  projection_ = scaled_to_w_buffer(projection, scene_->positions, settings_.depth_stencil);
}

Status CameraFrame::draw(std::string_view name, const PipelineState& state, VertexArrays arrays,
                         std::span<const TextureUnit> units, RenderTarget& target,
                         std::span<const std::uint32_t> scene_triangles) {
  if (arrays.vertex_count() == 0) arrays.positions = scene_->positions;
  // Not empty, which would mean all vertices: validate requires triangles.
  if (arrays.indices.empty()) arrays.indices = index_list(scene_->triangles);
  note_pass(rendering_, name, state);
  if (settings_.pixels.empty()) return rasterize(state, projection_, arrays, units, target);
  std::vector<FragmentProbe> probes;
  std::vector<std::uint8_t> stencils;
  for (const glm::ivec2& at : settings_.pixels) {
    probes.push_back({.x = at.x, .y = at.y});
    // rasterize reports a pixel outside.
    const bool is_inside = at.x >= 0 && at.y >= 0 && at.x < target.width && at.y < target.height;
    stencils.push_back(is_inside && target.stencil ? target.stencil.at(at.x, at.y) : std::uint8_t{0});
  }
  target.probes = &probes;
  Status drawn = rasterize(state, projection_, arrays, units, target);
  target.probes = nullptr;
  for (std::size_t i = 0; i < probes.size(); ++i) {
    std::vector<ProbedFragment>& fragments = probes[i].fragments;
    if (!scene_triangles.empty()) {
      for (ProbedFragment& fragment : fragments) fragment.primitive = scene_triangles[fragment.primitive];
    }
    rendering_.probed[i].push_back({std::string(name), state.program, std::move(fragments), stencils[i]});
  }
  return drawn;
}

Status CameraFrame::draw_averted(const PipelineState& state, const std::function<bool(std::size_t)>& faces_light) {
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint32_t> scene_triangles;
  for (std::size_t t = 0; t < scene_->triangles.size(); ++t) {
    if (faces_light(t)) continue;
    triangles.push_back(scene_->triangles[t]);
    scene_triangles.push_back(static_cast<std::uint32_t>(t));
  }
  if (triangles.empty()) return {};
  RenderTarget target = rendering_.frame.target();
  target.outputs.clear();
  VertexArrays arrays;
  arrays.indices = index_list(triangles);
  return draw("averted", state, arrays, {}, target, scene_triangles);
}

Status CameraFrame::draw_depth() {
  rendering_.probed.assign(settings_.pixels.size(), {});
  rendering_.layers.clear();
  rendering_.frame.fill({.color = kBackground});
  RenderTarget target = rendering_.frame.target();
  target.outputs.clear();
  if (settings_.layers) {
    owner_.assign(rendering_.frame.depth().size(), ~0U);
    target.outputs.push_back(
        {.source = OutputSource::primitive, .plane = Plane<std::uint32_t>{owner_.data(), target.width}});
  }
  if (!groups_.masked()) return draw("depth", passes_.depth, {}, {}, target);
  const TrianglePart opaque = groups_.opaque_part(*scene_, numbered());
  if (!opaque.triangles.empty()) {
    const VertexArrays arrays{.indices = index_list(opaque.triangles)};
    if (Status drawn = draw("depth", passes_.depth, arrays, {}, target); !drawn) return drawn;
  }
  if (Status drawn = draw_masked("depth", passes_.depth, target); !drawn) return drawn;
  keep_probed_groups(groups_.groups().size() + 1);
  return {};
}

void CameraFrame::keep_probed_groups(std::size_t draws) {
  const auto empty = [](const ProbedPass& pass) { return pass.fragments.empty(); };
  for (std::vector<ProbedPass>& probed : rendering_.probed) {
    const auto begin = probed.end() - static_cast<std::ptrdiff_t>(std::min(draws, probed.size()));
    if (begin == probed.end()) continue;
    // If no group has a fragment, the first one stays as the pass without fragments.
    const bool none = std::all_of(begin, probed.end(), empty);
    probed.erase(none ? begin + 1 : std::remove_if(begin, probed.end(), empty), probed.end());
  }
}

Status CameraFrame::draw_masked(std::string_view name, const PipelineState& plain, RenderTarget& target) {
  for (std::size_t g = 0; g < groups_.groups().size(); ++g) {
    const SurfaceGroup& group = groups_.groups()[g];
    if (!group.least_alpha) continue;
    const TrianglePart part = groups_.part(*scene_, g, numbered());
    VertexArrays arrays{.indices = index_list(part.triangles)};
    arrays.texture_coordinates[0] = groups_.coordinates();
    const std::array<TextureUnit, 1> units{TextureUnit{group.texture, group.sampler}};
    Status drawn = draw(name, SurfaceGroups::masked_state(plain, group), arrays, units, target);
    if (!drawn) return drawn;
  }
  return {};
}

Status CameraFrame::draw_colors(std::string_view name, const PipelineState& state, VertexArrays arrays,
                                const SurfaceUnit& unit) {
  RenderTarget target = unit.target != nullptr ? *unit.target : rendering_.frame.target();
  if (!groups_.textured()) return draw(name, state, arrays, unit.before, target);
  std::size_t draws = 0;
  std::vector<TextureUnit> units(unit.before.begin(), unit.before.end());
  const std::size_t number = units.size();
  units.emplace_back();
  arrays.texture_coordinates[number] = groups_.coordinates();
  for (std::size_t g = 0; g < groups_.groups().size(); ++g) {
    const SurfaceGroup& group = groups_.groups()[g];
    if (group.triangles == 0) continue;
    ++draws;
    const TrianglePart part = groups_.part(*scene_, g, numbered());
    arrays.indices = index_list(part.triangles);
    units[number] = {group.texture, group.sampler};
    const PipelineState drawn_with = unit.state_of ? unit.state_of(group) : SurfaceGroups::shaded_state(state, group);
    if (Status drawn = draw(name, drawn_with, arrays, units, target); !drawn) return drawn;
  }
  keep_probed_groups(draws);
  return {};
}

Status CameraFrame::draw_shaded(std::string_view name, const PipelineState& state,
                                const std::vector<ColorBytes>& colors, double& milliseconds) {
  milliseconds = 0.0;
  return PassTimer({}).run(name, 0.0, milliseconds, [&] {
    VertexArrays arrays;
    set_colors(arrays, colors);
    return draw_colors(name, state, arrays);
  });
}

Status CameraFrame::draw_lit_and_shadow() {
  if (Status drawn = draw_shaded("lit", passes_.lit, shading_.lit, rendering_.times.lit); !drawn) return drawn;
  return draw_shadow();
}

Status CameraFrame::draw_shadow() {
  return draw_shaded("shadow", passes_.shadow, shading_.shadowed, rendering_.times.shadow);
}

RenderTarget CameraFrame::capturing_target(int units, const std::string& prefix) {
  RenderTarget target = rendering_.frame.target();
  target.outputs.clear();
  if (!settings_.layers) return target;
  const auto add = [&](OutputSource source, Register reg, int component, const char* part) {
    const std::string channel(1, "RGBA"[component]);
    auto& plane = add_layer<s9>(rendering_.layers, prefix + part, channel, target.width, target.height);
    target.outputs.push_back({.source = source,
                              .reg = reg,
                              .component = component,
                              .time = OutputTime::at_depth_pass,
                              .plane = Plane<s9>{plane.data(), target.width},
                              .owner = owner()});
  };
  const auto capture = [&](Register reg, int components, const char* part) {
    for (int c = 0; c < components; ++c) add(OutputSource::register_code, reg, c, part);
  };
  capture(Register::primary, 4, "primary");
  if (units > 0) capture(Register::texture0, 4, "texture0");
  if (units > 1) capture(Register::texture1, 4, "texture1");
  capture(Register::spare0, 4, "spare0");
  capture(Register::spare1, 4, "spare1");
  add(OutputSource::output_code, Register::spare0, kAlpha, "output");
  return target;
}

void CameraFrame::finish() {
  const Surface& frame = rendering_.frame;
  const std::uint32_t *const depth = frame.depth().data(), farthest = max_depth(frame.format());
  const std::uint8_t* const shadow = frame.stencil().data();
  struct Count {
    std::uint64_t background = 0, shadowed = 0;
  };
  const auto count = [&](std::size_t begin, std::size_t end) {
    std::uint32_t background = 0, shadowed = 0;  // branch-free, so that it is vectorized
    for (std::size_t i = begin; i != end; ++i) {
      const bool is_background = depth[i] == farthest;
      background += is_background ? 1U : 0U;
      shadowed += !is_background && shadow[i] != 0 ? 1U : 0U;
    }
    return Count{background, shadowed};
  };
  const Count all = parallel_reduce(frame.stencil().size(), 65536, Count{}, count, [](const Count& a, const Count& b) {
    return Count{a.background + b.background, a.shadowed + b.shadowed};
  });
  rendering_.background = all.background;
  rendering_.shadowed = all.shadowed;
  rendering_.lit = frame.stencil().size() - all.background - all.shadowed;
  if (!settings_.layers) return;
  const auto add = [&](const char* name) -> std::vector<std::uint32_t>& {
    return add_layer<std::uint32_t>(rendering_.layers, name, name, frame.width(), frame.height());
  };
  auto& stencil = add_layer<std::uint8_t>(rendering_.layers, "stencil", "stencil", frame.width(), frame.height());
  stencil.assign(frame.stencil().begin(), frame.stencil().end());
  add("depth").assign(frame.depth().begin(), frame.depth().end());
  auto& polygon = add("polygon");
  auto& object = add("object");
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    if (owner_[i] >= scene_->triangles.size()) continue;
    polygon[i] = owner_[i] + 1;
    object[i] = scene_->triangle_object[owner_[i]] + 1;
  }
}

}  // namespace ninebit

// The technique: the states of its passes, and the rendering of one frame.
#include "ninebit/shadow/shadow_volume.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <utility>

#include "src/frame/camera_frame.h"
#include "src/frame/drawn_passes.h"
#include "src/frame/views.h"
#include "src/shadow/shadow_volume/volume_mesh.h"

namespace ninebit {
namespace {

constexpr LightKinds kVolumeLights{.point = true, .spot = true, .directional = true};

PipelineState silent_state(const RenderSettings& settings) {
  PipelineState state;
  state.profile = settings.profile;
  state.shade_model = ShadeModel::flat;
  state.color_mask = {false, false, false, false};
  return state;
}

}  // namespace

std::vector<VolumePass> volume_passes(const RenderSettings& settings) {
  const bool counts_failing = settings.shadow_volume.method == VolumeMethod::depth_fail;
  PipelineState state = silent_state(settings);
  state.depth_test = {.enabled = true, .function = CompareFunction::less, .write = false};
  const auto counting = [&](StencilOperation operation) {
    StencilFace face;
    (counts_failing ? face.depth_fail : face.depth_pass) = operation;
    return face;
  };
  const StencilFace up = counting(StencilOperation::incr_wrap), down = counting(StencilOperation::decr_wrap);
  const StencilFace &front = counts_failing ? down : up, &back = counts_failing ? up : down;
  state.stencil_test = {.enabled = true, .front = front, .back = back};
  if (settings.shadow_volume.two_sided) return {{"volumes", state}};
  PipelineState fronts = state, backs = state;
  fronts.cull_face = CullFace::back;
  fronts.stencil_test = {.enabled = true, .front = front};
  backs.cull_face = CullFace::front;
  backs.stencil_test = {.enabled = true, .front = back};
  return {{"volume fronts", fronts}, {"volume backs", backs}};
}

namespace {

class VolumeRenderer {
 public:
  explicit VolumeRenderer(CameraFrame& frame) : frame_(frame), settings_(frame.settings()) {}

  Status make_volumes();
  Status count_volumes();
  void add_facts();
  void add_picture();

 private:
  [[nodiscard]] std::uint64_t volume_triangles() const {
    return volumes_.outward.triangles.size() + volumes_.inward.triangles.size();
  }
  Status begin_stencil(RenderTarget& target);
  Status draw_pass(const VolumePass& pass, RenderTarget& target);
  Status mark_averted();
  Status clear_background(RenderTarget& target);

  CameraFrame& frame_;
  const RenderSettings& settings_;
  VolumeMesh mesh_;
  std::vector<std::int8_t> facing_;
  ShadowVolumes volumes_;
  LightPyramid pyramid_;  // empty unless the light is a spot
};

Status VolumeRenderer::make_volumes() {
  const Scene& scene = frame_.scene();
  const Light& light = frame_.light();
  mesh_ = volume_mesh(scene);
  facing_ = facing_of(mesh_, homogeneous_light(light));
  const auto casters = casters_of(scene, mesh_, facing_, settings_.cull_face);
  // Depth-pass counts in front of the visible surface: a front cap is there only if its caster is culled, a back cap
  // never.
  const bool counts_failing = settings_.shadow_volume.method == VolumeMethod::depth_fail;
  const VolumeCaps caps{.front = counts_failing || settings_.cull_face != CullFace::none, .back = counts_failing};
  volumes_ = extrude(mesh_, casters, homogeneous_light(light), caps);
  if (light.kind == LightKind::spot) pyramid_ = light_pyramid(light_projection(scene, light), light);
  return {};
}

// With a spot light the stencil begins with 1 (dark), which the light's pyramid subtracts. Depth-pass counts from the
// eye, so it begins with 0 if the eye is inside the pyramid.
Status VolumeRenderer::begin_stencil(RenderTarget& target) {
  if (pyramid_.triangles.empty()) return {};
  const glm::vec4 eye =
      light_projection(frame_.scene(), frame_.light()) * glm::vec4(frame_.scene().cameras[0].position, 1.0F);
  const bool is_inside = eye.w > 0.0F && std::max(std::abs(eye.x), std::abs(eye.y)) <= eye.w;
  const bool begins_lit = settings_.shadow_volume.method == VolumeMethod::depth_pass && is_inside;
  return clear({}, {.color = false, .depth = false}, {.stencil = begins_lit ? 0 : 1}, target);
}

Status VolumeRenderer::draw_pass(const VolumePass& pass, RenderTarget& target) {
  const auto draw = [&](const VolumeTriangles& set, FrontFace front_face) -> Status {
    if (set.triangles.empty()) return {};
    PipelineState state = pass.state;
    state.front_face = front_face;
    VertexArrays arrays;
    arrays.homogeneous_positions = volumes_.positions;
    arrays.indices = index_list(set.triangles);
    return frame_.draw(pass.name, state, arrays, {}, target, set.casters);
  };
  if (Status drawn = draw(volumes_.outward, FrontFace::counter_clockwise); !drawn) return drawn;
  if (Status drawn = draw(volumes_.inward, FrontFace::clockwise); !drawn) return drawn;
  if (pyramid_.triangles.empty()) return {};
  note_pass(frame_.rendering(), pass.name, pass.state);
  VertexArrays arrays;
  arrays.homogeneous_positions = pyramid_.positions;
  arrays.indices = index_list(pyramid_.triangles);
  return rasterize(pass.state, frame_.projection(), arrays, {}, target);
}

// Marks the lit parts of triangles that are edge-on or turn their back to the light.
Status VolumeRenderer::mark_averted() {
  PipelineState state = marking_pass(settings_);
  state.stencil_test.front = {.function = CompareFunction::equal, .reference = 0, .depth_pass = StencilOperation::incr};
  return frame_.draw_averted(state, [this](std::size_t triangle) { return facing_[triangle] > 0; });
}

// Volumes reach behind everything. A count that they leave in the background would look like a shadow.
Status VolumeRenderer::clear_background(RenderTarget& target) {
  PipelineState state = silent_state(settings_);
  state.depth_test = {.enabled = true, .function = CompareFunction::equal, .write = false};
  state.stencil_test = {.enabled = true, .front = {.depth_pass = StencilOperation::zero}};
  constexpr std::array<glm::vec3, 4> kFarPlane{{{-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
  note_pass(frame_.rendering(), "background", state);
  VertexArrays arrays;
  arrays.type = PrimitiveType::quads;
  arrays.positions = kFarPlane;
  return rasterize(state, glm::mat4(1.0F), arrays, {}, target);
}

Status VolumeRenderer::count_volumes() {
  RenderTarget target = frame_.rendering().frame.target();
  target.outputs.clear();
  Status status = begin_stencil(target);
  const std::vector<VolumePass> passes = volume_passes(settings_);
  for (std::size_t i = 0; i < passes.size() && status; ++i) {
    status = draw_pass(passes[i], target);
    if (!settings_.layers || i + 1 == passes.size()) continue;
    const PlaneSamples<std::uint8_t>& fronts = frame_.rendering().frame.stencil();
    add_layer<std::uint8_t>(frame_.rendering().layers, "stencil_fronts", "stencil", target.width, target.height)
        .assign(fronts.begin(), fronts.end());
  }
  if (status && settings_.light_facing) status = mark_averted();
  return status ? clear_background(target) : status;
}

void VolumeRenderer::add_facts() {
  constexpr std::uint64_t kNamed = 5;
  std::uint64_t closed = 0, open = 0;
  SurfaceFaults sum;
  std::string names;
  for (std::size_t i = 0; i < mesh_.faults.size(); ++i) {
    const SurfaceFaults& faults = mesh_.faults[i];
    ++(faults.none() ? closed : open);
    if (faults.none()) continue;
    sum.open_edges += faults.open_edges;
    sum.nonmanifold_edges += faults.nonmanifold_edges;
    if (open <= kNamed) names += (open > 1 ? ", " : "") + frame_.scene().objects[i].name;
  }
  if (open > kNamed) names += fmt::format(" and {} more", open - kNamed);
  std::vector<Fact>& facts = frame_.rendering().facts;
  facts.push_back({"closed_objects", closed});
  facts.push_back({"open_objects", open});
  if (open > 0) facts.push_back({"open_object_names", names});
  facts.push_back({"open_edges", sum.open_edges});
  facts.push_back({"nonmanifold_edges", sum.nonmanifold_edges});
  facts.push_back({"silhouette_edges", volumes_.silhouette_edges});
  facts.push_back({"volume_triangles", volume_triangles()});
}

void VolumeRenderer::add_picture() {
  const Surface& surface = frame_.rendering().frame;
  const PlaneSamples<std::uint8_t>& counts = surface.stencil();
  const int largest = std::max(1, static_cast<int>(*std::max_element(counts.begin(), counts.end())));
  Image8 image{surface.width(), surface.height(), 1, {}};
  image.pixels.reserve(counts.size());
  for (int y = surface.height() - 1; y >= 0; --y) {
    const auto row = counts.begin() + static_cast<std::ptrdiff_t>(y) * surface.width();
    std::transform(row, row + surface.width(), std::back_inserter(image.pixels),
                   [largest](std::uint8_t count) { return static_cast<std::uint8_t>(count * 255 / largest); });
  }
  frame_.rendering().pictures.push_back({"volume.png", std::move(image)});
}

}  // namespace

Result<Rendering> render_shadow_volume(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  const DepthStencilLayout& layout = layout_of(settings.depth_stencil);
  if (layout.is_w) {
    return Diagnostic{.message = "shadow volumes reach infinity, where w is not a distance: the W buffer " +
                                 std::string(layout.name) + " cannot hold them; expected d24s8, d15s1 or f24s8"};
  }
  auto made = CameraFrame::make(scene, settings, kVolumeLights);
  if (!made) return made.error();
  CameraFrame& frame = *made;
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  frame.set_projection(infinite_camera_projection(scene, scene.cameras[0], aspect));
  VolumeRenderer renderer(frame);
  PassTimes& times = frame.rendering().times;
  PassTimer timer(progress);
  double color = 0.0;  // draw_lit_and_shadow takes the times of its passes itself
  Status status = timer.run("silhouettes", 0.0, times.transform, [&] { return renderer.make_volumes(); });
  if (status) status = timer.run("depth", 0.2, times.camera, [&] { return frame.draw_depth(); });
  if (status) status = timer.run("volumes", 0.4, times.compare, [&] { return renderer.count_volumes(); });
  if (status) status = timer.run("colour", 0.8, color, [&] { return frame.draw_lit_and_shadow(); });
  if (!status) return status.error();
  renderer.add_facts();
  renderer.add_picture();
  frame.finish();
  return std::move(frame.rendering());
}

}  // namespace ninebit

#include "ninebit/effect/effect_renderer.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <utility>

#include "ninebit/raster/prepared_draw.h"
#include "ninebit/raster/rasterizer.h"
#include "src/effect/combiner_record.h"
#include "src/effect/effect_inputs.h"
#include "src/effect/effect_layers.h"
#include "src/effect/effect_targets.h"
#include "src/effect/effect_words.h"
#include "src/effect/tangents.h"
#include "src/effect/vertex_sources.h"
#include "src/frame/drawn_passes.h"
#include "src/frame/views.h"

namespace ninebit {
namespace {

// A pass with its vertices.
struct PreparedPass {
  PipelineState state{};
  std::size_t target = 0;                // among the targets
  std::vector<glm::mat4> projections{};  // one, or one for each face
  const Scene* scene = nullptr;          // the mesh or the rectangle
  std::span<const glm::vec3> positions{};
  std::array<UnitCoordinates, kEffectUnits> coordinates{};
  std::array<bool, kEffectUnits> has_coordinates{};
  std::array<int, kEffectUnits> textures{-1, -1, -1, -1};  // among the textures
  std::vector<ColorBytes> primary{}, secondary{};
  std::vector<float> fog{};
};

}  // namespace

struct EffectRenderer::Prepared {
  Effect effect;
  HardwareProfile profile;
  EffectOptions options;
  Scene mesh{};  // as it was read
  Scene scene{}, rectangle{};
  std::vector<glm::vec4> mesh_tangents{}, rectangle_tangents{};
  std::vector<glm::vec3> from_light{};  // the mesh's positions relative to the light; empty: no cube target
  EffectTargets targets{};
  std::vector<Texture> textures{};
  std::vector<PreparedPass> passes{};
  // Passes of the effect before with its own, while another one is loaded into the same scene and targets.
  std::vector<std::pair<EffectPass, PreparedPass>> reusable{};
  std::vector<std::string> warnings{};
  std::vector<double> times{};
  std::deque<Layer> layers{};
  std::vector<ProbedPass> probed{};
  CombinerRecord recorded{};
  PreparedDraw geometry{};  // of a pass; keeps its memory for the next one

  Status load(const EffectReaders& readers, const Effect* before);
  Status load_scene(const EffectReaders& readers, const Effect* before);
  Status prepare_pass(const EffectPass& pass, const EffectReaders& readers);
  void set_textures(const EffectPass& pass, PreparedPass& prepared) const;
  bool take_vertices(const EffectPass& pass, PreparedPass& prepared);
  Status set_view(const EffectPass& pass, PreparedPass& prepared);
  Status set_vertices(const EffectPass& pass, PreparedPass& prepared);
  Status add_warnings(const EffectPass& pass, const PreparedPass& prepared);
  [[nodiscard]] std::vector<TextureUnit> units_of(const PreparedPass& pass) const;
  Status set_primary(const EffectPass& pass, const VertexInputs& inputs, PreparedPass& prepared) const;
  Status draw_pass(std::size_t number);
  Status draw_face(std::size_t number, RenderTarget& target, const glm::mat4& projection, bool is_first);
};

namespace {

// Whether a stage reads its unit's coordinates even without a texture.
bool reads_coordinates(const PipelineState& state, std::size_t unit) {
  if (!state.texture_shader.enabled) return false;
  const TextureOperation operation = state.texture_shader.stage[unit].operation;
  return operation == TextureOperation::pass_through || operation == TextureOperation::cull_fragment ||
         has_dot_product(operation);
}

bool is_same_mesh(const Effect& a, const Effect& b) {
  return a.scene.mesh == b.scene.mesh && a.scene.up == b.scene.up && a.folder == b.folder;
}

// The picture's sides decide the default view.
bool is_same_scene(const Effect& a, const Effect& b) {
  return a.scene == b.scene && a.folder == b.folder && a.width == b.width && a.height == b.height;
}

bool has_same_targets(const Effect& a, const Effect& b) {
  return a.width == b.width && a.height == b.height && a.color_format == b.color_format &&
         a.depth_stencil == b.depth_stencil && a.targets == b.targets;
}

// Whether two passes of one scene have the same vertices, if their units read the same coordinates.
bool has_same_vertices(const EffectPass& a, const EffectPass& b) {
  const auto same_unit = [](const EffectUnit& x, const EffectUnit& y) { return x.coordinates == y.coordinates; };
  return a.geometry == b.geometry && a.view == b.view && a.target == b.target && a.primary == b.primary &&
         a.secondary == b.secondary && a.fog == b.fog &&
         std::equal(a.units.begin(), a.units.end(), b.units.begin(), same_unit);
}

Status named(const EffectPass& pass, Status status) {
  if (status) return status;
  return fault_in("pass " + effect_detail::in_quotes(pass.name), status.error());
}

}  // namespace

// `before`: the effect that was loaded, if there was one.
Status EffectRenderer::Prepared::load(const EffectReaders& readers, const Effect* before) {
  if (const auto faults = check_effect(effect); !faults.empty()) return Diagnostic{.message = faults[0].message};
  if (before == nullptr || !is_same_scene(*before, effect)) {
    reusable.clear();
    if (Status done = load_scene(readers, before); !done) return done;
  }
  if (before == nullptr || !has_same_targets(*before, effect)) {
    reusable.clear();
    targets = {};
    if (Status allocated = targets.allocate(effect); !allocated) return allocated;
  }
  for (const EffectTexture& texture : effect.textures) {
    const bool from_target =
        texture.origin == TextureOrigin::target_color || texture.origin == TextureOrigin::target_depth;
    auto read = from_target ? targets.texture(texture) : effect_texture(effect, texture, profile, readers);
    if (!read) return read.error();
    textures.push_back(std::move(*read));
  }
  passes.reserve(effect.passes.size());
  for (const EffectPass& pass : effect.passes) {
    if (Status done = prepare_pass(pass, readers); !done) return done;
  }
  reusable.clear();
  return {};
}

Status EffectRenderer::Prepared::load_scene(const EffectReaders& readers, const Effect* before) {
  const bool is_same = before != nullptr && is_same_mesh(*before, effect);
  if (!is_same) {
    auto read = effect_mesh(effect, readers);
    if (!read) return read.error();
    mesh = std::move(*read);
  }
  auto made = effect_scene(effect, mesh);
  if (!made) return made.error();
  // A floor is part of the scene.
  const auto has_floor = [](const Effect& e) { return e.scene.setup.floor != FloorChoice::none; };
  if (!is_same || has_floor(*before) || has_floor(effect)) mesh_tangents.clear();
  from_light.clear();
  scene = std::move(*made);
  rectangle = rectangle_scene(scene);
  rectangle_tangents = tangents_of(rectangle);
  return {};
}

Status EffectRenderer::Prepared::prepare_pass(const EffectPass& pass, const EffectReaders& readers) {
  PreparedPass prepared{.state = pass.state};
  prepared.state.profile = profile;
  prepared.state.fog = {.enabled = pass.fog.mode != FogMode::none, .color = pass.fog.color};
  if (pass.fog.mode == FogMode::registers) {
    prepared.state.fog.function = pass.fog.function;
    prepared.state.fog.bias = pass.fog.bias;
    prepared.state.fog.slope = pass.fog.slope;
  }
  for (std::size_t i = 0; i < kEffectUnits; ++i) {
    if (pass.units[i].coordinates.source != VertexSource::point_sprite) continue;
    prepared.state.point_sprite.enabled = prepared.state.point_sprite.coord_replace[i] = true;
  }
  prepared.target = targets.number_of(pass.target);
  if (!pass.program.empty()) {
    auto program = effect_program(effect, pass, profile, readers, warnings);
    if (!program) return program.error();
    prepared.state.program = std::move(program->combiners);
    if (!pass.state.texture_shader.enabled) prepared.state.texture_shader = program->texture_shader;
  }
  set_textures(pass, prepared);
  if (!take_vertices(pass, prepared)) {
    if (Status set = set_view(pass, prepared); !set) return named(pass, set);
    if (Status set = set_vertices(pass, prepared); !set) return named(pass, set);
  }
  if (Status warned = add_warnings(pass, prepared); !warned) return named(pass, warned);
  passes.push_back(std::move(prepared));
  return {};
}

Status EffectRenderer::Prepared::set_view(const EffectPass& pass, PreparedPass& prepared) {
  prepared.scene = pass.geometry == EffectGeometry::mesh ? &scene : &rectangle;
  prepared.positions = prepared.scene->positions;
  const Light& light = scene.lights[0];
  if (pass.geometry == EffectGeometry::rectangle) {
    prepared.projections = {glm::mat4(1.0F)};
  } else if (targets.is_cube(prepared.target)) {
    if (light.kind == LightKind::directional) {
      return Diagnostic{.message = "draws a cube map around a directional light; expected a point or spot light"};
    }
    if (from_light.empty()) {
      for (const glm::vec3& position : scene.positions) from_light.push_back(position - light.position);
    }
    prepared.positions = from_light;
    const auto faces = cube_face_projections(depth_range(scene, light.position, kCubeCornerCosine));
    prepared.projections.assign(faces.begin(), faces.end());
  } else if (pass.view == EffectView::light) {
    if (light.kind == LightKind::point) {
      return Diagnostic{.message = "draws the view of a point light; expected a spot or directional light"};
    }
    prepared.projections = {light_projection(scene, light)};
  } else {
    prepared.projections = {camera_projection(scene, scene.cameras[0], targets.aspect(prepared.target))};
  }
  for (glm::mat4& projection : prepared.projections) {
    const DepthStencilFormat format = targets.faces(prepared.target)[0].format();
    projection = scaled_to_w_buffer(projection, prepared.positions, format);
  }
  return {};
}

// Which textures the units read, and which of them have coordinates.
void EffectRenderer::Prepared::set_textures(const EffectPass& pass, PreparedPass& prepared) const {
  for (std::size_t i = 0; i < kEffectUnits; ++i) {
    const std::string& name = pass.units[i].texture;
    prepared.has_coordinates[i] = !name.empty() || reads_coordinates(prepared.state, i);
    if (name.empty()) continue;
    const auto found = std::find_if(effect.textures.begin(), effect.textures.end(),
                                    [&](const EffectTexture& t) { return t.name == name; });
    prepared.textures[i] = static_cast<int>(found - effect.textures.begin());
  }
}

// Moves the vertices of the same pass of the effect before; false: they are other ones.
bool EffectRenderer::Prepared::take_vertices(const EffectPass& pass, PreparedPass& prepared) {
  const std::size_t number = passes.size();
  if (number >= reusable.size() || !has_same_vertices(reusable[number].first, pass)) return false;
  PreparedPass& from = reusable[number].second;
  if (from.has_coordinates != prepared.has_coordinates) return false;
  prepared.projections = std::move(from.projections);
  prepared.scene = from.scene;
  prepared.positions = from.positions;
  prepared.coordinates = std::move(from.coordinates);
  prepared.primary = std::move(from.primary);
  prepared.secondary = std::move(from.secondary);
  prepared.fog = std::move(from.fog);
  return true;
}

Status EffectRenderer::Prepared::set_vertices(const EffectPass& pass, PreparedPass& prepared) {
  const bool is_mesh = pass.geometry == EffectGeometry::mesh;
  std::vector<VertexSource> sources{pass.primary.source, pass.secondary.source};
  for (std::size_t i = 0; i < kEffectUnits; ++i) {
    if (prepared.has_coordinates[i]) sources.push_back(pass.units[i].coordinates.source);
  }
  for (const VertexSource source : sources) {
    if (needs_uv(source) && prepared.scene->texture_coordinates.empty()) {
      return Diagnostic{.message =
                            "reads " + std::string(name_of(source)) + ", but the mesh has no texture coordinates"};
    }
    if (source == VertexSource::secondary_color && prepared.scene->secondary_colors.empty()) {
      return Diagnostic{.message = "reads secondary-color, but the mesh has no secondary colours"};
    }
    if (source == VertexSource::projected && scene.lights[0].kind == LightKind::point) {
      return Diagnostic{.message = "reads the view of a point light; expected a spot or directional light"};
    }
    if (is_mesh && needs_tangents(source) && mesh_tangents.empty()) mesh_tangents = tangents_of(scene);
  }
  if (pass.fog.mode == FogMode::mesh && prepared.scene->fog_factors.empty()) {
    return Diagnostic{.message = "reads the mesh's fog factors, but the mesh has none"};
  }
  VertexInputs inputs{.scene = prepared.scene, .tangents = is_mesh ? &mesh_tangents : &rectangle_tangents};
  inputs.clip_from_world = prepared.projections[0];
  if (scene.lights[0].kind != LightKind::point) inputs.light_clip_from_world = light_projection(scene, scene.lights[0]);
  for (std::size_t i = 0; i < kEffectUnits; ++i) {
    if (prepared.has_coordinates[i]) prepared.coordinates[i] = unit_coordinates(pass.units[i].coordinates, inputs);
  }
  prepared.secondary = vertex_colors(pass.secondary, inputs, profile);
  prepared.fog = fog_factors(pass.fog, inputs);
  return set_primary(pass, inputs, prepared);
}

Status EffectRenderer::Prepared::set_primary(const EffectPass& pass, const VertexInputs& inputs,
                                             PreparedPass& prepared) const {
  if (pass.primary.source != VertexSource::index) {
    prepared.primary = vertex_colors(pass.primary, inputs, profile);
    return {};
  }
  const std::size_t count = scene.triangles.size();
  const IndexCounts counts{.polygons = count, .objects = scene.objects.size()};
  const ColorSource& source = pass.primary;
  Status enough = check_index_codes(source.index_format, source.index_step, IndexScope::polygon, counts);
  if (!enough) return enough;
  const IndexCodes codes(source.index_step, source.index_format);
  for (std::size_t i = 0; i < count; ++i) prepared.primary.push_back(codes.color(static_cast<std::uint32_t>(i + 1)));
  return {};
}

// Up to the last unit that has a texture: a profile may have fewer units than an effect can name.
std::vector<TextureUnit> EffectRenderer::Prepared::units_of(const PreparedPass& pass) const {
  std::vector<TextureUnit> units;
  for (std::size_t i = 0; i < kEffectUnits; ++i) {
    if (pass.textures[i] < 0) continue;
    const auto texture = static_cast<std::size_t>(pass.textures[i]);
    units.resize(i + 1);
    units[i] = {&textures[texture], effect.textures[texture].sampler};
  }
  return units;
}

Status EffectRenderer::Prepared::add_warnings(const EffectPass& pass, const PreparedPass& prepared) {
  const auto found = check_draw(prepared.state, units_of(prepared));
  if (!found) return found.error();
  for (const std::string& warning : *found) {
    warnings.push_back("pass " + effect_detail::in_quotes(pass.name) + ": " + warning);
  }
  return {};
}

Result<EffectRenderer> EffectRenderer::make(const Effect& effect, const HardwareProfile& profile,
                                            const EffectReaders& readers, const EffectOptions& options) {
  auto prepared = std::make_unique<Prepared>(Prepared{.effect = effect, .profile = profile, .options = options});
  if (Status loaded = prepared->load(readers, nullptr); !loaded) return loaded.error();
  return EffectRenderer(std::move(prepared));
}

Status EffectRenderer::change(const Effect& effect, const EffectReaders& readers) {
  Prepared& p = *prepared_;
  const Effect before = std::exchange(p.effect, effect);
  for (std::size_t i = 0; i < p.passes.size(); ++i) p.reusable.emplace_back(before.passes[i], std::move(p.passes[i]));
  p.passes.clear();
  p.textures.clear();
  p.warnings.clear();
  p.recorded = {};
  return p.load(readers, &before);
}

void EffectRenderer::set_options(const EffectOptions& options) {
  prepared_->options = options;
}

EffectRenderer::EffectRenderer(std::unique_ptr<Prepared> prepared) : prepared_(std::move(prepared)) {}
EffectRenderer::~EffectRenderer() = default;
EffectRenderer::EffectRenderer(EffectRenderer&& other) noexcept = default;
EffectRenderer& EffectRenderer::operator=(EffectRenderer&& other) noexcept = default;

Status EffectRenderer::draw(const Progress& progress) {
  Prepared& p = *prepared_;
  p.times.assign(p.passes.size(), 0.0);
  p.layers.clear();
  p.probed.clear();
  p.targets.start();
  PassTimer timer(progress);
  for (std::size_t i = 0; i < p.passes.size(); ++i) {
    const double done = static_cast<double>(i) / static_cast<double>(p.passes.size());
    Status drawn = timer.run(p.effect.passes[i].name, done, p.times[i], [&] { return p.draw_pass(i); });
    if (!drawn) return drawn.error().fault == Fault::cancelled ? drawn : named(p.effect.passes[i], drawn);
  }
  for (std::size_t t = 0; t < p.targets.count(); ++t) p.targets.fill_start(t);
  if (p.options.layers) add_frame_layers(p.layers, p.targets.faces(0)[0]);
  return {};
}

Status EffectRenderer::Prepared::draw_pass(std::size_t number) {
  const PreparedPass& pass = passes[number];
  for (const int texture : pass.textures) {
    if (texture < 0) continue;
    const EffectTexture& read = effect.textures[static_cast<std::size_t>(texture)];
    if (targets.has(read.target)) targets.fill_start(targets.number_of(read.target));
  }
  const bool is_first = targets.take_start(pass.target);
  const std::span<Surface> faces = targets.faces(pass.target);
  for (std::size_t f = 0; f < faces.size(); ++f) {
    RenderTarget target = faces[f].target();
    target.outputs.clear();
    if (Status drawn = draw_face(number, target, pass.projections[f], is_first); !drawn) return drawn;
  }
  return {};
}

Status EffectRenderer::Prepared::draw_face(std::size_t number, RenderTarget& target, const glm::mat4& projection,
                                           bool is_first) {
  const EffectPass& said = effect.passes[number];
  const PreparedPass& pass = passes[number];
  const auto cleared = clear_before_pass(said.clear, profile, target, is_first);
  if (!cleared) return cleared.error();
  VertexArrays arrays{.positions = pass.positions, .indices = index_list(pass.scene->triangles)};
  if (said.primary.source == VertexSource::index) {
    arrays.primitive_colors = pass.primary;
  } else {
    arrays.vertex_colors = pass.primary;
  }
  arrays.secondary_colors = pass.secondary;
  arrays.fog_factors = pass.fog;
  for (std::size_t i = 0; i < kEffectUnits; ++i) {
    if (!pass.has_coordinates[i]) continue;
    arrays.texture_coordinates[i] = pass.coordinates[i].str;
    arrays.texture_q[i] = pass.coordinates[i].q;
  }
  const std::vector<TextureUnit> units = units_of(pass);
  if (options.recorded_pass == number && pass.state.program) {
    auto made = record_combiners({pass.state, projection, arrays, units, *cleared}, target);
    if (!made) return made.error();
    recorded = std::move(*made);
  }
  const bool on_picture = said.target == kPictureTarget;
  if (on_picture && options.layers) capture_registers(layers, said.name, target);
  std::vector<FragmentProbe> probes;
  if (on_picture && options.pixel) {
    probes.push_back({.x = options.pixel->x, .y = options.pixel->y});
    target.probes = &probes;
  }
  if (target.samples != SampleMode::center_1) return rasterize(pass.state, projection, arrays, units, target);
  if (Status ready = prepare(pass.state, projection, arrays, target, geometry); !ready) return ready;
  const DrawPass draw{.state = &pass.state, .arrays = arrays, .units = units};
  Status drawn = rasterize({&draw, 1}, geometry, {.clear = *cleared}, target);
  if (!probes.empty()) probed.push_back({said.name, pass.state.program, std::move(probes[0].fragments)});
  return drawn;
}

const Surface& EffectRenderer::picture() const {
  return prepared_->targets.faces(0)[0];
}

std::span<const Surface> EffectRenderer::target(std::string_view name) const {
  return prepared_->targets.has(name) ? prepared_->targets.faces(prepared_->targets.number_of(name))
                                      : std::span<const Surface>{};
}

const Scene& EffectRenderer::scene() const {
  return prepared_->scene;
}

const std::vector<std::string>& EffectRenderer::warnings() const {
  return prepared_->warnings;
}

const std::vector<double>& EffectRenderer::pass_times() const {
  return prepared_->times;
}

const std::deque<Layer>& EffectRenderer::layers() const {
  return prepared_->layers;
}

const std::vector<ProbedPass>& EffectRenderer::probed() const {
  return prepared_->probed;
}

const CombinerRecord& EffectRenderer::recorded() const {
  return prepared_->recorded;
}

}  // namespace ninebit

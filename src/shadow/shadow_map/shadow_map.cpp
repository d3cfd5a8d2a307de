#include "ninebit/shadow/shadow_map.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_nv.h"
#include "ninebit/raster/rasterizer.h"
#include "src/frame/camera_frame.h"
#include "src/frame/drawn_passes.h"
#include "src/frame/map_evidence.h"
#include "src/frame/packed_map.h"
#include "src/frame/shading.h"
#include "src/frame/views.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

namespace {

constexpr LightKinds kMapLights{.point = false, .spot = true, .directional = true};

// The picture of a larger map shows every second, fourth, … texel.
constexpr int kLargestPicture = 1024;

// The nearest depth is white, the farthest dark grey; undrawn texels are black.
Image8 map_picture(std::span<const std::uint32_t> codes, int size, std::uint32_t cleared) {
  std::uint32_t nearest = cleared, farthest = 0;
  for (const std::uint32_t code : codes) {
    if (code == cleared) continue;
    nearest = std::min(nearest, code);
    farthest = std::max(farthest, code);
  }
  const std::uint32_t range = farthest > nearest ? farthest - nearest : 1;
  const int side = std::min(size, kLargestPicture), stride = size / side;
  Image8 image{side, side, 1, {}};
  image.pixels.reserve(static_cast<std::size_t>(side) * static_cast<std::size_t>(side));
  for (int y = side; y-- > 0;) {
    for (int x = 0; x < side; ++x) {
      const std::uint32_t code = codes[static_cast<std::size_t>(y * stride) * static_cast<std::size_t>(size) +
                                       static_cast<std::size_t>(x * stride)];
      const std::uint64_t grey = code == cleared ? 0 : 255 - std::uint64_t{code - nearest} * 215 / range;
      image.pixels.push_back(static_cast<std::uint8_t>(grey));
    }
  }
  return image;
}

// A cube map with one texel per face, of which only +z lets light through.
Texture beam_texture() {
  std::vector<std::vector<TextureSamples>> faces;
  for (const CubeFace face : kCubeFaces) {
    const std::uint8_t through = face == CubeFace::positive_z ? 255 : 0;
    faces.push_back({{1, 1, std::vector<std::uint8_t>{through}}});
  }
  return make_texture(TextureTarget::cube_map, InternalFormat::alpha8, std::move(faces)).value();
}

class ShadowMapRenderer {
 public:
  static Result<ShadowMapRenderer> make(const Scene& scene, const RenderSettings& settings) {
    auto frame = CameraFrame::make(scene, settings, kMapLights);
    if (!frame) return frame.error();
    if (Status checked = check_map_size(settings.map_size); !checked) return checked.error();
    auto passes = shadow_map_passes(settings);
    if (!passes) return passes.error();
    return ShadowMapRenderer(std::move(*frame), std::move(*passes));
  }

  Status draw_map();
  Status draw_depth() { return frame_.draw_depth(); }
  Status draw_comparison();
  Status draw_lit_and_shadow() { return frame_.draw_lit_and_shadow(); }
  Status add_evidence();
  Rendering finish();
  [[nodiscard]] Rendering& rendering() { return frame_.rendering(); }

 private:
  ShadowMapRenderer(CameraFrame frame, ShadowMapPasses passes);

  [[nodiscard]] const RenderSettings& settings() const { return frame_.settings(); }
  [[nodiscard]] std::uint32_t cleared() const { return max_depth(map_format_); }
  Status draw_casters(RenderTarget& target);
  // Fills `interpolated_` from the coordinates.
  void interpolate_coordinates();
  // Adds output planes for the s, t, r and q of fragments; with settings.layers they are layers.
  void add_coordinate_planes(RenderTarget& target);
  Status compare_depth_texture();
  Status compare_packed();
  Status draw_averted();

  CameraFrame frame_;
  ShadowMapPasses passes_;
  LightBeam beam_;
  LightBeam::Coordinates coordinates_;
  std::vector<glm::vec4> interpolated_;  // coordinates as an attribute, for output planes
  DepthStencilFormat map_format_;
  std::vector<std::uint32_t>* depth_;  // of the map, in the rendering
  std::optional<PackedMap> packed_;
  std::array<std::vector<float>, 4> own_planes_;  // coordinates of fragments, unless they are layers
  std::array<std::vector<float>*, 4> planes_{};
};

ShadowMapRenderer::ShadowMapRenderer(CameraFrame frame, ShadowMapPasses passes)
    : frame_(std::move(frame)),
      passes_(std::move(passes)),
      beam_(frame_.scene(), frame_.light()),
      coordinates_(beam_.coordinates(frame_.scene().positions)),
      map_format_(settings().shadow_map.encoding == DepthEncoding::d16 ? DepthStencilFormat::d16
                                                                       : DepthStencilFormat::d24s8),
      depth_(&add_layer<std::uint32_t>(rendering().maps, "shadow_map", "depth", settings().map_size,
                                       settings().map_size)) {}

Status ShadowMapRenderer::draw_map() {
  std::fill(depth_->begin(), depth_->end(), cleared());
  RenderTarget target{.width = settings().map_size, .height = settings().map_size, .format = map_format_};
  target.depth = {depth_->data(), settings().map_size};
  if (Status drawn = draw_casters(target); !drawn) return drawn;
  if (const DepthPacking* packing = depth_packing(settings().shadow_map.encoding)) {
    packed_.emplace(*packing, settings().shadow_map.storage, settings().map_size, *depth_, cleared(), rendering().maps);
  }
  return {};
}

Status ShadowMapRenderer::draw_casters(RenderTarget& target) {
  const SurfaceGroups& groups = frame_.groups();
  VertexArrays arrays = frame_.all_triangles(frame_.scene().positions);
  note_pass(rendering(), "map", passes_.map);
  if (!groups.masked()) return rasterize(passes_.map, beam_.projection(), arrays, {}, target);
  const TrianglePart opaque = groups.opaque_part(frame_.scene(), false);
  if (!opaque.triangles.empty()) {
    arrays.indices = index_list(opaque.triangles);
    if (Status drawn = rasterize(passes_.map, beam_.projection(), arrays, {}, target); !drawn) return drawn;
  }
  arrays.texture_coordinates[0] = groups.coordinates();
  for (std::size_t g = 0; g < groups.groups().size(); ++g) {
    const SurfaceGroup& group = groups.groups()[g];
    if (!group.least_alpha) continue;
    const TrianglePart part = groups.part(frame_.scene(), g, false);
    arrays.indices = index_list(part.triangles);
    const std::array<TextureUnit, 1> units{TextureUnit{group.texture, group.sampler}};
    const PipelineState state = SurfaceGroups::masked_state(passes_.map, group);
    if (Status drawn = rasterize(state, beam_.projection(), arrays, units, target); !drawn) return drawn;
  }
  return {};
}

void ShadowMapRenderer::interpolate_coordinates() {
  interpolated_.resize(coordinates_.q.size());
  for (std::size_t i = 0; i < interpolated_.size(); ++i) {
    interpolated_[i] = glm::vec4(coordinates_.str[i], coordinates_.q[i]);
  }
}

void ShadowMapRenderer::add_coordinate_planes(RenderTarget& target) {
  constexpr std::array kNames{"s", "t", "r", "q"};
  interpolate_coordinates();
  for (std::size_t c = 0; c < 4; ++c) {
    if (settings().layers) {
      planes_[c] =
          &add_layer<float>(rendering().layers, "shadow_coordinate", kNames[c], settings().width, settings().height);
    } else {
      own_planes_[c].resize(rendering().frame.depth().size());
      planes_[c] = &own_planes_[c];
    }
    target.outputs.push_back({.source = OutputSource::attribute,
                              .component = static_cast<int>(c),
                              .time = OutputTime::at_depth_pass,
                              .plane = Plane<float>{planes_[c]->data(), settings().width}});
  }
}

Status ShadowMapRenderer::draw_comparison() {
  Status drawn = packed_ ? compare_packed() : compare_depth_texture();
  return drawn && settings().light_facing ? draw_averted() : drawn;
}

Status ShadowMapRenderer::compare_depth_texture() {
  const int size = settings().map_size;
  const TextureImage image{size, size, std::array<Plane<const std::uint32_t>, 4>{{{depth_->data(), size}, {}, {}, {}}}};
  const Texture map = texture_view(
      map_format_ == DepthStencilFormat::d16 ? InternalFormat::depth16 : InternalFormat::depth24, {&image, 1});
  rendering().map_bytes = texture_bytes(map);
  const Texture beam = beam_texture();
  Sampler comparing = kNearestSampler;
  comparing.comparison = DepthComparison::lequal;
  const std::array<TextureUnit, 2> units{TextureUnit{&map, comparing}, TextureUnit{&beam, kNearestSampler}};
  RenderTarget target = frame_.capturing_target(2);
  VertexArrays arrays;
  arrays.texture_coordinates = {coordinates_.str, coordinates_.direction};
  arrays.texture_q[0] = coordinates_.q;
  if (settings().layers) {
    add_coordinate_planes(target);
    arrays.attributes[0] = interpolated_;
  }
  return frame_.draw("comparison", passes_.comparison, arrays, units, target);
}

Status ShadowMapRenderer::compare_packed() {
  Rendering& r = rendering();
  RenderTarget target = r.frame.target();
  target.outputs.clear();
  add_coordinate_planes(target);
  VertexArrays arrays;
  arrays.attributes[0] = interpolated_;
  note_float_pass(r, "coordinates", true);
  r.map_bytes = packed_->bytes();
  if (Status drawn = frame_.draw("coordinates", passes_.coordinate, arrays, {}, target); !drawn) return drawn;
  std::vector<float>* read = nullptr;
  if (settings().layers) {
    read = &add_layer<float>(r.layers, "map_depth", "depth", settings().width, settings().height);
  }
  const auto row = static_cast<std::size_t>(settings().width);
  parallel_for(static_cast<std::size_t>(settings().height), [&](std::size_t y) {
    std::uint8_t* const stencil = target.stencil.row(static_cast<int>(y));
    const std::size_t first = y * row;
    for (std::size_t i = first; i < first + row; ++i) {
      if (r.frame.depth()[i] == max_depth(r.frame.format())) continue;
      const float q = (*planes_[3])[i];
      const float s = (*planes_[0])[i] / q, t = (*planes_[1])[i] / q, depth = (*planes_[2])[i] / q;
      const bool inside = q > 0.0F && s >= 0.0F && s <= 1.0F && t >= 0.0F && t <= 1.0F;
      const float stored = inside ? packed_->depth_at(s, t) : 0.0F;
      if (read != nullptr) (*read)[i] = stored;
      if (!inside || stored < depth) stencil[i - first] = 1;
    }
  });
  return {};
}

Status ShadowMapRenderer::draw_averted() {
  return frame_.draw_averted(passes_.averted, [this](std::size_t triangle) {
    const glm::uvec3& t = frame_.scene().triangles[triangle];
    const auto& p = frame_.scene().positions;
    return beam_.lights_front(p[t.x], p[t.y], p[t.z]);
  });
}

Status ShadowMapRenderer::add_evidence() {
  interpolate_coordinates();
  return add_map_evidence(frame_, {.pass = passes_.map,
                                   .positions = frame_.scene().positions,
                                   .projections = {&beam_.projection(), 1},
                                   .size = settings().map_size,
                                   .format = map_format_,
                                   .coordinates = interpolated_});
}

Rendering ShadowMapRenderer::finish() {
  frame_.finish();
  Rendering& r = rendering();
  const MapResolution resolution = beam_.resolution(settings().map_size, cleared());
  r.facts = {{"polygon_offset_factor", static_cast<double>(passes_.map.polygon_offset.factor)},
             {"polygon_offset_units", static_cast<double>(passes_.map.polygon_offset.units)},
             {"texel_size", resolution.texel_size},
             {"depth_step", resolution.depth_step}};
  if (packed_) {
    r.facts.push_back({"encoding_error", packed_->largest_error()});
  } else {
    const int units = texture_units_read(*passes_.comparison.program);
    r.facts.push_back({"texture_units", static_cast<std::uint64_t>(units)});
  }
  r.pictures.push_back({"shadow_map.png", map_picture(*depth_, settings().map_size, cleared())});
  return std::move(r);
}

}  // namespace

Result<Rendering> render_shadow_map(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  std::optional<ShadowMapRenderer> renderer;
  PassTimer timer(progress);
  PassTimes times;
  double colors = 0.0;  // draw_lit_and_shadow takes the times of its passes itself
  Status status = timer.make("light's view", 0.0, times.transform, renderer,
                             [&] { return ShadowMapRenderer::make(scene, settings); });
  if (status) status = timer.run("shadow map", 0.1, times.maps, [&] { return renderer->draw_map(); });
  if (status) status = timer.run("depth", 0.4, times.camera, [&] { return renderer->draw_depth(); });
  if (status) status = timer.run("comparison", 0.5, times.compare, [&] { return renderer->draw_comparison(); });
  if (status) status = timer.run("colours", 0.8, colors, [&] { return renderer->draw_lit_and_shadow(); });
  if (!status) return status.error();
  times.lit = renderer->rendering().times.lit;
  times.shadow = renderer->rendering().times.shadow;
  if (settings.evidence) {
    if (Status added = renderer->add_evidence(); !added) return added.error();
  }
  Rendering rendering = renderer->finish();
  rendering.times = times;
  return rendering;
}

Result<CombinerState> shadow_map_comparison_state(const HardwareProfile& profile) {
  using namespace gl;
  return combiner_state_after(profile, "shadow map's comparison", [] {
    glCombinerParameteriNV(GL_NUM_GENERAL_COMBINERS_NV, 1);

    // Stage 0, alpha: spare0 = texture0 · texture1, 1 if the fragment is lit and inside the beam.
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_A_NV, GL_TEXTURE0_ARB, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_B_NV, GL_TEXTURE1_ARB, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerInputNV(GL_COMBINER0_NV, GL_ALPHA, GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_ALPHA);
    glCombinerOutputNV(GL_COMBINER0_NV, GL_ALPHA, GL_SPARE0_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE,
                       GL_FALSE, GL_FALSE, GL_FALSE);
    discard_portion(GL_COMBINER0_NV, GL_RGB);

    // Final combiner: RGB 0, alpha = 1 - spare0.alpha: the alpha test lets the fragments in shadow through.
    glFinalCombinerInputNV(GL_VARIABLE_A_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_B_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_C_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_D_NV, GL_ZERO, GL_UNSIGNED_IDENTITY_NV, GL_RGB);
    glFinalCombinerInputNV(GL_VARIABLE_G_NV, GL_SPARE0_NV, GL_UNSIGNED_INVERT_NV, GL_ALPHA);
  });
}

Result<ShadowMapPasses> shadow_map_passes(const RenderSettings& settings) {
  const auto state = shadow_map_comparison_state(settings.profile);
  if (!state) return state.error();
  const auto program = compile(*state, settings.profile);
  if (!program) return program.error();
  const PipelineState depth = frame_passes(settings).depth, marking = marking_pass(settings);
  ShadowMapPasses passes{depth, marking, surface_pass(settings), marking};
  const OffsetArguments offset = settings.shadow_map.polygon_offset.value_or(kShadowMapOffset);
  passes.map.polygon_offset = {.fill = true, .factor = offset.factor, .units = offset.units};
  passes.comparison.program = *program;
  passes.comparison.alpha_test = {.enabled = true, .function = CompareFunction::greater, .reference = 0};
  return passes;
}

}  // namespace ninebit

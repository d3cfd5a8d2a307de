#include "src/shadow/depth_cube/depth_cube_renderer.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/sampler.h"
#include "src/frame/drawn_passes.h"
#include "src/frame/map_evidence.h"
#include "src/raster/texture/texture_wrap.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

// With 16 bits, the ramp's row is the high byte and its column, which repeats in every row, is the low byte. Both
// coordinates are the same number times a power of two, so they agree on where a row ends.
constexpr Sampler kWideRampSampler{.min_filter = MinFilter::nearest,
                                   .mag_filter = MagFilter::nearest,
                                   .wrap_s = Wrap::repeat,
                                   .wrap_t = Wrap::clamp_to_edge};
constexpr float kWideRampSide = 256.0F;

// A ramp whose texel i holds code(i): the low byte as luminance and, with 16 bits, the high byte as alpha.
template <class Code>
Texture ramp_texture(const DistanceCode& distance, const Code& code) {
  const std::size_t size = distance.ramp_size();
  const bool wide = distance.code_bits == 16;
  std::vector<std::uint8_t> samples(wide ? 2 * size : size);
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t value = code(static_cast<std::uint32_t>(i));
    samples[i] = static_cast<std::uint8_t>(value & 255U);
    if (wide) samples[size + i] = static_cast<std::uint8_t>(value >> 8U);
  }
  const int width = wide ? static_cast<int>(kWideRampSide) : static_cast<int>(size);
  const int height = wide ? static_cast<int>(size) / width : 1;
  auto made =
      make_texture(TextureTarget::texture_2d, wide ? InternalFormat::luminance8_alpha8 : InternalFormat::luminance8,
                   {{{width, height, std::move(samples)}}});
  return std::move(made).value();  // cannot fail: it depends on no input
}

}  // namespace

Result<DepthCubeRenderer> DepthCubeRenderer::make(const Scene& scene, const RenderSettings& settings) {
  auto frame = CameraFrame::make(scene, settings, {.point = true});
  if (!frame) return frame.error();
  if (Status checked = check_map_size(settings.map_size); !checked) return checked.error();
  const float bias = settings.depth_cube.bias.value_or(0.0F);
  if (!(std::isfinite(bias) && bias >= 0.0F)) {
    return Diagnostic{.message = fmt::format("bias {} is out of range; expected a finite distance of 0 or more", bias)};
  }
  auto passes = depth_cube_passes(settings);
  if (!passes) return passes.error();
  return DepthCubeRenderer(std::move(*frame), std::move(*passes));
}

DepthCubeRenderer::DepthCubeRenderer(CameraFrame frame, DepthCubePasses passes)
    : frame_(std::move(frame)),
      passes_(std::move(passes)),
      range_(depth_range(frame_.scene(), frame_.light().position, kCubeCornerCosine)),
      face_projections_(cube_face_projections(range_)) {
  const auto& positions = frame_.scene().positions;
  const glm::vec3 light = frame_.light().position;
  from_light_.resize(positions.size());
  parallel_for(positions.size(), kGrainOfCheapItems, [&](std::size_t i) { from_light_[i] = positions[i] - light; });
  if (needs_directions()) {
    from_light_four_.resize(positions.size());
    parallel_for(positions.size(), kGrainOfCheapItems,
                 [&](std::size_t i) { from_light_four_[i] = glm::vec4(from_light_[i], 0.0F); });
  }
  const auto texels = static_cast<std::size_t>(settings().map_size) * static_cast<std::size_t>(settings().map_size);
  map_depth_.resize(texels);
  if (uses_floats()) {
    bias_ = settings().depth_cube.bias.value_or(default_depth_cube_bias(frame_.scene(), settings()));
    for (Face& face : faces_) face.distance.assign(texels, std::numeric_limits<float>::infinity());
    return;
  }
  code_ = distance_code(frame_.scene(), settings());
  make_ramps();
  blank_.assign(texels, 255);
  for (Face& face : faces_) {
    face.luminance.resize(texels);
    if (code_.code_bits == 16) face.alpha.resize(texels);
  }
}

bool DepthCubeRenderer::needs_directions() const {
  return uses_floats() || settings().layers || !settings().pixels.empty();
}

void DepthCubeRenderer::make_ramps() {
  map_ramp_ = ramp_texture(code_, [this](std::uint32_t i) { return code_.map_code(i); });
  camera_ramp_ = ramp_texture(code_, [this](std::uint32_t i) { return code_.camera_code(i); });
}

// The result of a linear texture-coordinate generation along the face's axis: 0 and 1 at the ends of the ramp.
void DepthCubeRenderer::set_ramp_coordinates(std::size_t face) {
  const CubeFaceAxes& axes = cube_face_axes(kCubeFaces[face]);
  const glm::vec3 axis(axes.major[0], axes.major[1], axes.major[2]);
  const float scale = 1.0F / (code_.high - code_.low);
  const float columns = code_.code_bits == 16 ? kWideRampSide : 1.0F;
  ramp_coordinates_.resize(from_light_.size());
  parallel_for(from_light_.size(), kGrainOfCheapItems, [&](std::size_t i) {
    const float t = (glm::dot(axis, from_light_[i]) - code_.low) * scale;
    ramp_coordinates_[i] = glm::vec3(t * columns, t, 0.0F);
  });
}

// The cleared map is the farthest code, or infinity: nothing is behind it.
Status DepthCubeRenderer::draw_map(std::size_t face) {
  const int size = settings().map_size;
  RenderTarget target{.width = size, .height = size};
  target.depth = {map_depth_.data(), size};
  VertexArrays arrays = frame_.all_triangles(from_light_);
  std::vector<TextureUnit> units;
  Face& into = faces_[face];
  const CubeFaceAxes& axes = cube_face_axes(kCubeFaces[face]);
  if (uses_floats()) {
    arrays.attributes[0] = from_light_four_;
    const int axis = static_cast<int>(face) / 2;
    target.outputs.push_back(
        {.source = OutputSource::attribute, .component = axis, .plane = Plane<float>{into.distance.data(), size}});
  } else {
    set_ramp_coordinates(face);
    arrays.texture_coordinates[0] = ramp_coordinates_;
    units.push_back({&map_ramp_, code_.code_bits == 16 ? kWideRampSampler : kNearestSampler});
    target.color[kRed] = {into.luminance.data(), size};
    if (code_.code_bits == 16) target.color[kAlpha] = {into.alpha.data(), size};
  }
  note_pass(rendering(), fmt::format("map {}", kCubeFaceNames[face]), passes_.map);
  if (Status made = prepare(passes_.map, face_projections_[face], arrays, target, prepared_map_); !made) return made;
  const DrawPass pass{.state = &passes_.map, .arrays = arrays, .units = units};
  const DrawActions actions{.clear = ClearValues{.color = {255, 255, 255, 255}}, .discard_depth = true};
  if (Status drawn = rasterize({&pass, 1}, prepared_map_, actions, target); !drawn) return drawn;
  // Along a negative axis the coordinate is the negated distance.
  if (uses_floats() && axes.major[face / 2] < 0) {
    parallel_for(into.distance.size(), kGrainOfCheapItems,
                 [&](std::size_t i) { into.distance[i] = std::fabs(into.distance[i]); });
  }
  return {};
}

Status DepthCubeRenderer::draw_depth() {
  if (Status drawn = frame_.draw_depth(); !drawn) return drawn;
  const RenderTarget target = rendering().frame.target();
  const VertexArrays arrays = frame_.all_triangles(frame_.scene().positions);
  if (Status made = prepare(passes_.depth, frame_.projection(), arrays, target, prepared_camera_); !made) return made;
  return needs_directions() ? draw_directions() : Status{};
}

Status DepthCubeRenderer::add_evidence() {
  const LightMap map{
      .pass = passes_.map, .positions = from_light_, .projections = face_projections_, .size = settings().map_size};
  return add_map_evidence(frame_, map);
}

// Interpolated like the cube map's texture coordinates, so that they select the same texels.
Status DepthCubeRenderer::draw_directions() {
  RenderTarget target = rendering().frame.target();
  target.outputs.clear();
  for (std::size_t c = 0; c < 3; ++c) {
    directions_[c].assign(rendering().frame.depth().size(), 0.0F);
    target.outputs.push_back({.source = OutputSource::attribute,
                              .component = static_cast<int>(c),
                              .plane = Plane<float>{directions_[c].data(), target.width}});
  }
  const PipelineState state = surface_pass(settings());
  VertexArrays arrays = frame_.all_triangles(frame_.scene().positions);
  arrays.attributes[0] = from_light_four_;
  if (uses_floats()) {  // else the directions are for people
    note_float_pass(rendering(), "comparison", true);
    rendering().map_bytes = faces_.size() * faces_[0].distance.size() * sizeof(float);
    if (!settings().pixels.empty()) return frame_.draw("comparison", state, arrays, {}, target);
  }
  return rasterize(state, prepared_camera_, arrays, {}, target);
}

std::size_t DepthCubeRenderer::face_at(std::size_t pixel) const {
  return static_cast<std::size_t>(
      cube_coordinate(directions_[0][pixel], directions_[1][pixel], directions_[2][pixel]).face);
}

std::size_t DepthCubeRenderer::texel_at(std::size_t pixel) const {
  const CubeCoordinate at = cube_coordinate(directions_[0][pixel], directions_[1][pixel], directions_[2][pixel]);
  const int size = settings().map_size;
  const auto texel = [size](float coordinate) {
    return static_cast<std::size_t>(nearest_texel(coordinate, {size, size, Wrap::clamp_to_edge}));
  };
  return texel(at.t) * static_cast<std::size_t>(size) + texel(at.s);
}

// One face of the map; the other five are blank, which restricts the pass to this face's directions.
Texture DepthCubeRenderer::map_of_face(std::size_t face) const {
  const int size = settings().map_size;
  std::vector<TextureImage> images;
  for (std::size_t f = 0; f < 6; ++f) {
    std::array<Plane<const std::uint8_t>, 4> planes;
    planes[kRed] = {f == face ? faces_[f].luminance.data() : blank_.data(), size};
    planes[kAlpha] = {f == face && code_.code_bits == 16 ? faces_[f].alpha.data() : blank_.data(), size};
    images.push_back({size, size, planes});
  }
  return texture_view(code_.code_bits == 16 ? InternalFormat::luminance8_alpha8 : InternalFormat::luminance8, images);
}

Status DepthCubeRenderer::draw_comparison(std::size_t comparison, std::size_t face) {
  const DepthCubeComparison& pass = passes_.comparisons[comparison];
  const Texture map = map_of_face(face);
  const std::array<TextureUnit, 2> units{
      TextureUnit{&camera_ramp_, code_.code_bits == 16 ? kWideRampSampler : kNearestSampler},
      TextureUnit{&map, kNearestSampler}};
  set_ramp_coordinates(face);
  VertexArrays arrays = frame_.all_triangles(frame_.scene().positions);
  arrays.texture_coordinates[0] = ramp_coordinates_;
  arrays.texture_coordinates[1] = from_light_;
  rendering().map_bytes = texture_bytes(map);
  const std::string name = fmt::format("{} {}", pass.name, kCubeFaceNames[face]);
  const std::size_t layers_before = rendering().layers.size();
  RenderTarget target = frame_.capturing_target(2, passes_.comparisons.size() > 1 ? pass.name + " " : "");
  const std::size_t layers_drawn = rendering().layers.size() - layers_before;
  if (settings().pixels.empty()) {
    note_pass(rendering(), name, pass.state);
    if (Status drawn = rasterize(pass.state, prepared_camera_, arrays, units, target); !drawn) return drawn;
  } else {
    if (Status drawn = frame_.draw(name, pass.state, arrays, units, target); !drawn) return drawn;
    // A probe that looked up a blank face is dropped.
    for (std::size_t i = 0; i < settings().pixels.size(); ++i) {
      const glm::ivec2& pixel = settings().pixels[i];
      const auto at = static_cast<std::size_t>(pixel.y) * static_cast<std::size_t>(target.width) +
                      static_cast<std::size_t>(pixel.x);
      if (face_at(at) != face) rendering().probed[i].pop_back();
    }
  }
  if (face > 0) keep_layers_of_face(face, layers_before - layers_drawn, layers_drawn);
  return {};
}

// The last `count` layers hold the values of this face's pass, which looked up a blank face at most pixels. Copies the
// pixels in this face's direction into the `count` layers from `first` on, then removes the last ones.
void DepthCubeRenderer::keep_layers_of_face(std::size_t face, std::size_t first, std::size_t count) {
  std::deque<Layer>& layers = rendering().layers;
  for (std::size_t n = 0; n < count; ++n) {
    const auto& from = std::get<std::vector<s9>>(layers[first + count + n].samples);
    auto& to = std::get<std::vector<s9>>(layers[first + n].samples);
    parallel_for(to.size(), kGrainOfCheapItems, [&](std::size_t i) {
      if (face_at(i) == face) to[i] = from[i];
    });
  }
  layers.erase(layers.end() - static_cast<std::ptrdiff_t>(count), layers.end());
}

Status DepthCubeRenderer::compare_floats() {
  const RenderTarget target = rendering().frame.target();
  const std::uint32_t background = max_depth(target.format);
  const PlaneSamples<std::uint32_t>& depth = rendering().frame.depth();
  std::vector<float>*own_layer = nullptr, *map_layer = nullptr;
  if (settings().layers) {
    const auto add = [&](const char* part) {
      return &add_layer<float>(rendering().layers, part, "distance", target.width, target.height);
    };
    own_layer = add("own_distance");
    map_layer = add("map_distance");
  }
  parallel_for(depth.size(), kGrainOfCheapItems, [&](std::size_t i) {
    if (depth[i] == background) return;
    const float own =
        std::max({std::fabs(directions_[0][i]), std::fabs(directions_[1][i]), std::fabs(directions_[2][i])});
    const float map = faces_[face_at(i)].distance[texel_at(i)];
    if (own - bias_ > map) {
      const auto width = static_cast<std::size_t>(target.width);
      target.stencil.at(static_cast<int>(i % width), static_cast<int>(i / width)) = 1;
    }
    if (own_layer == nullptr) return;
    (*own_layer)[i] = own;
    (*map_layer)[i] = map;
  });
  return {};
}

Status DepthCubeRenderer::draw_averted() {
  return frame_.draw_averted(passes_.averted, [this](std::size_t triangle) {
    const glm::uvec3& t = frame_.scene().triangles[triangle];
    const glm::vec3 a = from_light_[t.x], b = from_light_[t.y], c = from_light_[t.z];
    return glm::dot(glm::cross(b - a, c - a), -a) > 0.0F;
  });
}

}  // namespace ninebit

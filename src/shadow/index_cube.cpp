#include "ninebit/shadow/index_cube.h"

#include <fmt/format.h>

#include <bit>
#include <chrono>
#include <string>
#include <utility>

#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/sampler.h"
#include "src/shadow/camera_pass.h"
#include "src/shadow/shading.h"
#include "src/shadow/views.h"

namespace ninebit {
namespace {

constexpr ColorBytes kBackground{38, 42, 51, 255};

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

// Measures one pass after the other.
class Stopwatch {
 public:
  double lap_ms() {
    const auto now = std::chrono::steady_clock::now();
    const double ms = std::chrono::duration<double, std::milli>(now - start_).count();
    start_ = now;
    return ms;
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

// A share of the scene's triangles with their index colours.
struct TriangleSet {
  std::vector<glm::uvec3> triangles;
  std::vector<ColorBytes> index_colors;
  std::vector<std::uint32_t> numbers;  // in the scene
};

// One run of the technique, pass by pass.
class IndexCubeRun {
 public:
  IndexCubeRun(const Scene& scene, const RenderSettings& settings, IndexCubePasses passes, Rendering& rendering)
      : scene_(scene),
        settings_(settings),
        out_(rendering),
        light_(scene.lights[0]),
        passes_(std::move(passes)),
        camera_{settings, rendering} {}

  void transform() {
    assign_indices();
    shading_ = shade_vertices(scene_, light_, settings_.light_facing, settings_.profile);
    from_light_.resize(scene_.positions.size());
    for (std::size_t i = 0; i < from_light_.size(); ++i) from_light_[i] = scene_.positions[i] - light_.position;
    const float aspect = static_cast<float>(settings_.width) / static_cast<float>(settings_.height);
    camera_.projection = camera_projection(scene_, scene_.cameras[0], aspect);
    light_range_ = depth_range(scene_, light_.position, kCubeCornerCosine);
  }

  // Pass 1: indices into the cube map. The cleared map is index 0. Vertices are taken relative to the light, as they
  // are for the fetch in pass 3.
  Status draw_map() {
    VertexArrays arrays = all_triangles();
    arrays.positions = from_light_;
    arrays.primitive_colors = index_colors_;
    std::vector<TextureImage> faces;
    for (const CubeFace face : kCubeFaces) {
      auto surface = Surface::make(settings_.map_size, settings_.map_size);
      if (!surface) return surface.error();
      RenderTarget target = surface->target();
      const glm::mat4 projection = cube_face_projection(face, light_range_);
      if (Status drawn = rasterize(passes_.map, projection, arrays, {}, target); !drawn) return drawn;
      IndexMapFace& kept = out_.index_map.emplace_back(IndexMapFace{settings_.map_size, {}});
      std::array<Plane<const std::uint8_t>, 4> planes;
      for (std::size_t c = 0; c < 3; ++c) {
        kept.color[c] = surface->take_color(static_cast<int>(c));
        planes[c] = {kept.color[c].data(), settings_.map_size};
      }
      faces.push_back({settings_.map_size, settings_.map_size, planes});
    }
    map_ = texture_view(InternalFormat::rgb8, faces);
    return {};
  }

  // Pass 2: the camera's depth.
  Status draw_depth() {
    out_.frame.fill({.color = kBackground});
    RenderTarget target = out_.frame.target();
    target.outputs.clear();
    return camera_.draw("depth", passes_.depth, all_triangles(), {}, target);
  }

  // Pass 3: shadows into the stencil buffer. What the index says of a surface that is turned away from the light is of
  // no interest with light_facing: it is in shadow.
  Status compare_indices() {
    RenderTarget target = out_.frame.target();
    target.outputs.clear();
    if (settings_.layers) add_layers(target);

    TriangleSet compared, averted;
    VertexArrays arrays = all_triangles();
    arrays.primitive_colors = index_colors_;
    arrays.texture_coordinates[0] = from_light_;
    if (settings_.light_facing) {
      split_by_facing(compared, averted);
      arrays.indices = index_list(compared.triangles);
      arrays.primitive_colors = compared.index_colors;
    }
    // (Without indices, all vertices would be drawn in their order.)
    if (!arrays.indices.empty()) {
      const std::array<TextureUnit, 1> units{TextureUnit{&map_, kNearestSampler}};
      const Status drawn = camera_.draw("comparison", passes_.comparison, arrays, units, target, compared.numbers);
      if (!drawn) return drawn;
    }
    if (averted.triangles.empty()) return {};
    target.outputs.clear();
    const VertexArrays away{.positions = scene_.positions, .indices = index_list(averted.triangles)};
    return camera_.draw("averted", passes_.averted, away, {}, target, averted.numbers);
  }

  // Pass 4: the lit pass where the stencil is 0, the shadow pass where it is 1.
  Status shade() {
    RenderTarget target = out_.frame.target();
    VertexArrays arrays = all_triangles();
    arrays.vertex_colors = shading_.lit;
    if (Status drawn = camera_.draw("lit", passes_.lit, arrays, {}, target); !drawn) return drawn;
    arrays.vertex_colors = shading_.shadowed;
    return camera_.draw("shadow", passes_.shadow, arrays, {}, target);
  }

  void count() {
    for (std::size_t i = 0; i < out_.frame.stencil().size(); ++i) {
      if (out_.frame.depth()[i] == max_depth(out_.frame.format())) {
        ++out_.background;
      } else if (out_.frame.stencil()[i] == 0) {
        ++out_.lit;
      } else {
        ++out_.shadowed;
      }
    }
    if (out_.layers) name_polygons(*out_.layers);
  }

 private:
  // Of a scene that has triangles, as validate demands.
  VertexArrays all_triangles() const {
    return {.positions = scene_.positions, .indices = index_list(scene_.triangles)};
  }

  // Indices are counted afresh for each rendering, from 1: 0 is the cleared map.
  void assign_indices() {
    index_colors_.resize(scene_.triangles.size());
    for (std::size_t t = 0; t < index_colors_.size(); ++t) {
      const std::uint32_t number =
          settings_.index_scope == IndexScope::polygon ? static_cast<std::uint32_t>(t) : scene_.triangle_object[t];
      index_colors_[t] = out_.codes.color(number + 1);
    }
  }

  glm::vec3 normal_times_area(const glm::uvec3& t) const {
    const glm::vec3& a = scene_.positions[t.x];
    return glm::cross(scene_.positions[t.y] - a, scene_.positions[t.z] - a);
  }

  bool faces_light(const glm::uvec3& t) const {
    return glm::dot(normal_times_area(t), light_.position - scene_.positions[t.x]) > 0.0F;
  }

  void split_by_facing(TriangleSet& compared, TriangleSet& averted) const {
    for (std::size_t t = 0; t < scene_.triangles.size(); ++t) {
      TriangleSet& set = faces_light(scene_.triangles[t]) ? compared : averted;
      set.triangles.push_back(scene_.triangles[t]);
      set.index_colors.push_back(index_colors_[t]);
      set.numbers.push_back(static_cast<std::uint32_t>(t));
    }
  }

  void add_layers(RenderTarget& target) {
    ComparisonLayers& layers = out_.layers.emplace();
    const std::size_t pixels = out_.frame.stencil().size();
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

  // From the triangles that the lit and shadow passes drew.
  void name_polygons(ComparisonLayers& layers) const {
    const std::vector<std::uint32_t>& drawn = out_.frame.primitive();
    layers.polygon.assign(drawn.size(), 0);
    layers.object.assign(drawn.size(), 0);
    for (std::size_t i = 0; i < drawn.size(); ++i) {
      if (drawn[i] >= scene_.triangles.size()) continue;
      layers.polygon[i] = drawn[i] + 1;
      layers.object[i] = scene_.triangle_object[drawn[i]] + 1;
    }
  }

  const Scene& scene_;
  const RenderSettings& settings_;
  Rendering& out_;
  const PointLight& light_;
  const IndexCubePasses passes_;
  std::vector<ColorBytes> index_colors_;
  std::vector<glm::vec3> from_light_;
  VertexShading shading_;
  CameraPasses camera_;
  DepthRange light_range_{};
  Texture map_;
};

}  // namespace

Result<Rendering> render_index_cube(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  if (Status checked = check_settings(scene, settings); !checked) return checked.error();
  const std::uint64_t objects = scene.objects.size();
  const std::uint64_t used = settings.index_scope == IndexScope::polygon ? scene.triangles.size() : objects;
  if (Status enough = check_index_codes(settings.index_step, settings.index_scope, used, objects); !enough) {
    return enough.error();
  }
  auto passes = index_cube_passes(settings);
  if (!passes) return passes.error();
  auto frame = Surface::make(settings.width, settings.height, {.with_primitive = settings.layers});
  if (!frame) return frame.error();

  Rendering rendering{.frame = std::move(*frame), .codes = IndexCodes(settings.index_step), .codes_used = used};
  IndexCubeRun run(scene, settings, std::move(*passes), rendering);
  Stopwatch watch;
  const auto go_on = [&](std::string_view pass, double done) { return !progress || progress(pass, done); };
  const Diagnostic cancelled{.message = "interrupted", .fault = Fault::cancelled};

  if (!go_on("indices", 0.0)) return cancelled;
  run.transform();
  rendering.times.transform = watch.lap_ms();

  if (!go_on("index cube map", 0.1)) return cancelled;
  if (Status done = run.draw_map(); !done) return done.error();
  rendering.times.maps = watch.lap_ms();

  if (!go_on("camera depth", 0.5)) return cancelled;
  if (Status done = run.draw_depth(); !done) return done.error();
  rendering.times.camera = watch.lap_ms();

  if (!go_on("index comparison", 0.6)) return cancelled;
  if (Status done = run.compare_indices(); !done) return done.error();
  rendering.times.compare = watch.lap_ms();

  if (!go_on("lit and shadow pass", 0.8)) return cancelled;
  if (Status done = run.shade(); !done) return done.error();
  rendering.times.shade = watch.lap_ms();
  run.count();
  return rendering;
}

}  // namespace ninebit

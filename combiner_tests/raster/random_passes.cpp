#include "combiner_tests/raster/random_passes.h"

#include <algorithm>
#include <sstream>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/raster/fragment_support.h"
#include "combiner_tests/raster/texture_support.h"

namespace ninebit::test {
namespace {

// Shared by all passes.
PipelineState random_view(Random& random, const PassScene& scene) {
  PipelineState state;
  state.cull_face = random.one_in(3) ? static_cast<CullFace>(random.below(3)) : CullFace::none;
  state.front_face = random.one_in(3) ? FrontFace::clockwise : FrontFace::counter_clockwise;
  if (random.one_in(4)) {
    state.polygon_offset = {.fill = true,
                            .factor = random.real_f(-4, 4),
                            .units = random.one_in(4) ? random.pick({3e8F, -3e8F}) : random.real_f(-300, 300)};
  }
  state.polygon_smooth = random.one_in(6);
  state.line_smooth = random.one_in(3);
  state.line_width = random.pick({1.0F, 1.0F, 2.0F, 2.5F, 4.125F});
  state.point_size = random.pick({0.0F, 1.0F, 2.5F, 8.0F, 31.0F});
  if (random.one_in(4)) {
    state.front_mode = static_cast<PolygonMode>(random.below(3));
    state.back_mode = static_cast<PolygonMode>(random.below(3));
    state.polygon_offset.line = random.one_in(4);
    state.polygon_offset.point = random.one_in(4);
  }
  if (random.one_in(4)) {
    state.depth_near = random.real_f(0, 1);
    state.depth_far = random.real_f(0, 1);
  }
  if (random.one_in(4)) {
    state.scissor = PixelRect{random.between(-9, scene.width / 2), random.between(-9, scene.height / 2),
                              random.between(1, scene.width), random.between(1, scene.height)};
  }
  if (random.one_in(8)) {
    const int x = random.below(scene.width), y = random.below(scene.height);
    state.viewport = PixelRect{x, y, random.between(1, scene.width - x), random.between(1, scene.height - y)};
  }
  return state;
}

// Corners in 1/16 pixel: of triangles from less than a pixel to more than their edge functions have room for in 32
// bits.
std::array<oracle::WindowVertex, 3> random_corners(Random& random, const PassScene& scene, bool only_small) {
  std::array<oracle::WindowVertex, 3> v;
  v[0].x_q4 = random.between(-80, 16 * scene.width + 80);
  v[0].y_q4 = random.between(-80, 16 * scene.height + 80);
  const int kind = random.below(only_small ? 2 : 6);
  if (kind == 4) {  // far around the target: areas beyond 2^31, of corners within 2^15
    for (oracle::WindowVertex& corner : v) {
      corner.x_q4 = random.pick({-1, 1}) * random.between(20000, 32000);
      corner.y_q4 = random.pick({-1, 1}) * random.between(20000, 32000);
    }
    return v;
  }
  if (kind == 5) {  // a sliver along pixel centres: nothing is steeper
    v[0] = {16 * random.below(scene.width) + 8, 16 * random.below(scene.height) + 8, 0};
    const int steps = random.between(1, 60), at = random.below(steps + 1);
    const std::int64_t dx = 16 * random.between(-2, 2), dy = 16 * random.between(-2, 2);
    v[1] = {v[0].x_q4 + steps * dx, v[0].y_q4 + steps * dy, 0};
    v[2] = {v[0].x_q4 + at * dx + random.between(-1, 1), v[0].y_q4 + at * dy + random.between(-1, 1), 0};
    return v;
  }
  const int any = random.pick({500, 1600, 16 * scene.width, 16 * 1800, 16 * 4000});
  const int spread = kind < 2 ? 14 + 80 * kind : any;
  for (std::size_t i = 1; i < 3; ++i) {
    v[i].x_q4 = v[0].x_q4 + random.between(-spread, spread);
    v[i].y_q4 = v[0].y_q4 + random.between(-spread, spread);
    if (kind == 2 && i == 1) v[i].x_q4 = v[0].x_q4 + random.between(-9, 9);
  }
  return v;
}

void add_flat_triangle(Random& random, PassScene& scene, bool only_small) {
  const bool level = random.one_in(4);
  std::int64_t depth = 0;
  std::array<oracle::WindowVertex, 3> corners = random_corners(random, scene, only_small);
  for (std::size_t i = 0; i < 3; ++i) {
    if (i == 0 || !level) {
      depth = random.one_in(3) ? random.pick({0, 1, 1 << 22, 1 << 23, (1 << 24) - 1}) : random.below(1 << 24);
    }
    corners[i].z24 = depth;
    scene.positions.push_back(clip_position(corners[i], scene.width, scene.height));
  }
}

// In perspective, now and then through the near plane.
void add_deep_triangle(Random& random, PassScene& scene, bool only_small) {
  const float depth = random.real_f(0.05, 12), reach = depth * 1.2F;
  const float size = only_small || random.one_in(3) ? depth * 0.03F : depth * random.real_f(0.1, 3);
  const glm::vec3 first(random.real_f(-reach, reach), random.real_f(-reach, reach), -depth);
  for (int corner = 0; corner < 3; ++corner) {
    scene.positions.push_back(first +
                              size * glm::vec3(random.real_f(-1, 1), random.real_f(-1, 1), random.real_f(-1, 1)));
  }
}

void add_geometry(Random& random, PassScene& scene) {
  const bool deep = random.one_in(2), only_small = random.one_in(3);
  if (deep) scene.matrix = perspective(0.8, 1.0, 0.2, 14);
  const int triangles = only_small ? random.between(100, 300) : random.between(1, 14);
  for (int i = 0; i < triangles; ++i) {
    deep ? add_deep_triangle(random, scene, only_small) : add_flat_triangle(random, scene, only_small);
  }
  if (random.one_in(4)) {
    scene.type = random.pick({PrimitiveType::triangle_strip, PrimitiveType::triangle_fan, PrimitiveType::quads,
                              PrimitiveType::quad_strip, PrimitiveType::polygon, PrimitiveType::points,
                              PrimitiveType::lines, PrimitiveType::line_strip, PrimitiveType::line_loop});
  }
  if (random.one_in(2)) return;
  // Every vertex in its order, and some of them again: equal depths meet.
  const int count = static_cast<int>(scene.positions.size());
  for (int i = 0; i < count; ++i) scene.indices.push_back(static_cast<std::uint32_t>(i));
  for (int i = random.below(count / 3 + 1); i > 0; --i) {
    const int first = random.below(count / 3) * 3;
    for (int k = 0; k < 3; ++k) scene.indices.push_back(static_cast<std::uint32_t>(first + k));
  }
}

void add_texture(Random& random, RandomPass& pass, std::size_t unit, std::size_t vertices) {
  const bool cube = random.one_in(4), mipmaps = random.one_in(16);
  const TextureTarget target = cube ? TextureTarget::cube_map : TextureTarget::texture_2d;
  const InternalFormat format = random.one_in(2)
                                    ? InternalFormat::rgba8
                                    : kInternalFormats[static_cast<std::size_t>(random.below(kInternalFormats.size()))];
  int width = 1 << random.below(5), height = cube ? width : 1 << random.below(5);
  if (cube && is_depth(format)) return;
  const bool linear = random.one_in(2), plain = !cube && !mipmaps && !linear;
  const bool has_border_texels = !cube && !mipmaps && random.one_in(6);
  if (has_border_texels) width = height = 16;
  const bool has_key = plain && format == InternalFormat::rgba8 && random.one_in(3);
  if (has_key && !has_border_texels) width = height = 2;
  pass.textures[unit] = random_texture(random, target, format, width, height, mipmaps);
  Sampler& s = pass.samplers[unit];
  s.border_texels = has_border_texels;
  s.border_color = {random.real_f(0, 1), random.real_f(0, 1), random.real_f(0, 1), random.real_f(0, 1)};
  if (has_key) {
    const auto& planes = std::get<0>(pass.textures[unit].faces[0][0].planes);
    const int x = random.below(width), y = random.below(height);
    const auto byte = [&](std::size_t k) { return std::uint32_t{planes[k].at(x, y)}; };
    s.color_key = {static_cast<ColorKeyOperation>(random.between(1, 3)),
                   byte(kAlpha) << 24 | byte(kRed) << 16 | byte(kGreen) << 8 | byte(kBlue)};
  }
  for (bool& is_around : s.cylinder_wrap) is_around = random.one_in(4);
  s.min_filter = mipmaps ? MinFilter::linear_mipmap_linear : linear ? MinFilter::linear : MinFilter::nearest;
  s.mag_filter = linear ? MagFilter::linear : MagFilter::nearest;
  s.wrap_s = kWraps[static_cast<std::size_t>(random.below(kWraps.size()))];
  s.wrap_t = kWraps[static_cast<std::size_t>(random.below(kWraps.size()))];
  if (is_depth(format) && random.one_in(2)) {
    s.comparison = static_cast<DepthComparison>(random.between(1, static_cast<int>(DepthComparison::always)));
  }
  for (std::size_t i = 0; i < vertices; ++i) {
    pass.coordinates[unit].emplace_back(random.real_f(-2, 2), random.real_f(-2, 2), random.real_f(-1, 2));
  }
  const bool in_front = random.one_in(2);
  if (random.one_in(2)) return;
  for (std::size_t i = 0; i < vertices; ++i) pass.q[unit].push_back(random.real_f(in_front ? 0.2 : -1, 3));
}

void add_program(Random& random, RandomPass& pass, std::size_t vertices) {
  PipelineState& state = pass.state;
  state.profile = random_profile(random);
  if (random.one_in(5)) state.profile = random.one_in(2) ? profiles::ideal : profiles::float_shader;
  if (random.one_in(3)) {
    constexpr std::array kRegisters{Register::primary, Register::spare0, Register::texture0, Register::spare1};
    state.program = pass_through(kRegisters[static_cast<std::size_t>(random.below(4))],
                                 kRegisters[static_cast<std::size_t>(random.below(4))], state.profile);
  } else {
    state.program = compile(random_state(random, state.profile), state.profile).value();
  }
  for (std::size_t unit = 0; unit < static_cast<std::size_t>(int{state.profile.texture_units}); ++unit) {
    if (!random.one_in(3)) add_texture(random, pass, unit, vertices);
  }
  state.point_sprite.enabled = state.profile.point_sprites && random.one_in(2);
  for (bool& replaces : state.point_sprite.coord_replace) replaces = random.one_in(2);
  if (!random.one_in(4)) return;
  state.fog = {true,
               {random.byte(), random.byte(), random.byte()},
               static_cast<FogFunction>(random.below(7)),
               random.real_f(0.5, 2),
               random.real_f(-1, 1)};
  if (random.one_in(4)) return;
  for (std::size_t i = 0; i < vertices; ++i) pass.fog_factors.push_back(random.real_f(-1, 2));
}

void add_colors(Random& random, const PassScene& scene, RandomPass& pass) {
  const auto color = [&] { return ColorBytes{random.byte(), edge_byte(random), random.byte(), edge_byte(random)}; };
  const std::size_t entries = scene.indices.empty() ? scene.positions.size() : scene.indices.size();
  const auto fill = [&](std::vector<ColorBytes>& colors, std::size_t count) {
    while (colors.size() < count) colors.push_back(color());
  };
  pass.state.shade_model = random.one_in(3) ? ShadeModel::flat : ShadeModel::smooth;
  if (random.one_in(3) && scene.type == PrimitiveType::triangles) {
    fill(pass.primitive_colors, entries / 3);
  } else if (!random.one_in(3)) {
    fill(pass.vertex_colors, scene.positions.size());
  }
  if (pass.state.program && random.one_in(16)) fill(pass.secondary_colors, scene.positions.size());
}

}  // namespace

std::vector<TextureUnit> RandomPass::units() const {
  std::vector<TextureUnit> units;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    if (textures[i].faces[0].empty()) continue;
    units.resize(i + 1);
    units[i] = {&textures[i], samplers[i]};
  }
  return units;
}

VertexArrays PassScene::arrays(const RandomPass& pass) const {
  VertexArrays a{.type = type, .positions = positions, .indices = indices};
  a.vertex_colors = pass.vertex_colors;
  a.primitive_colors = pass.primitive_colors;
  a.secondary_colors = pass.secondary_colors;
  a.fog_factors = pass.fog_factors;
  for (std::size_t i = 0; i < kMaxTextureUnits; ++i) {
    a.texture_coordinates[i] = pass.coordinates[i];
    a.texture_q[i] = pass.q[i];
  }
  return a;
}

void PassScene::begin(Canvas& canvas, bool with_outputs) const {
  canvas.load(start);
  RenderTarget& target = canvas.target;
  target.format = format;
  target.color_format = color_format;
  if (!with_outputs) target.outputs.clear();
  if (!has_stencil) target.stencil = {};
  for (std::size_t k = 0; k < 4; ++k) {
    if (!has_color[k]) target.color[k] = {};
  }
}

PassScene random_passes(Random& random, int passes) {
  PassScene scene;
  const auto size = [&] {
    return random.one_in(2) ? random.pick({1, 15, 63, 64, 65, 100, 128}) : random.between(2, 140);
  };
  scene.width = size();
  scene.height = size();
  scene.format = kFormats[random.one_in(2) ? 0 : random.below(3)];
  if (random.one_in(6)) scene.format = DepthStencilFormat::f24s8;
  scene.has_stencil = stencil_bits(scene.format) > 0 || random.one_in(2);
  const bool some_missing = random.one_in(4);
  for (bool& has : scene.has_color) has = !some_missing || random.one_in(2);
  scene.color_format = random_color_format(random, false);
  scene.start = random_picture(random, scene.width, scene.height, scene.format);
  set_color_format(scene.color_format, scene.start);
  add_geometry(random, scene);
  const PipelineState view = random_view(random, scene);
  const bool equal_masks = !random.one_in(4);
  std::array<bool, 4> mask{true, true, true, true};
  if (random.one_in(3)) {
    for (bool& component : mask) component = random.one_in(2);
  }
  for (int i = 0; i < passes; ++i) {
    RandomPass& pass = scene.passes.emplace_back();
    pass.state = view;
    if (!random.one_in(3)) {
      add_program(random, pass, scene.positions.size());
      pass.state.profile.subpixel_bits.value = view.profile.subpixel_bits.value;
      pass.state.profile.line_shape.value = view.profile.line_shape.value;
      pass.state.profile.point_shape.value = view.profile.point_shape.value;
      pass.state.profile.depth_narrowing.value = view.profile.depth_narrowing.value;
    }
    randomize_fragment_operations(random, pass.state);
    if (!facts_of(scene.color_format).blends()) pass.state.blend = {};
    if (random.one_in(6)) pass.state.polygon_stipple = random_stipple(random);
    // All that most draws write, and tests that many fragments pass.
    if (equal_masks) pass.state.color_mask = random.one_in(3) ? std::array<bool, 4>{} : mask;
    if (random.one_in(2)) pass.state.alpha_test.enabled = false;
    if (random.one_in(3)) pass.state.stencil_test.enabled = false;
    if (random.one_in(3)) {
      pass.state.depth_test = {true,
                               random.pick({CompareFunction::less, CompareFunction::lequal, CompareFunction::equal}),
                               random.one_in(2)};
    }
    add_colors(random, scene, pass);
    // The nearest fragment alone, of one colour a primitive, which has a short way of its own.
    if (random.one_in(5)) {
      pass.state.program.reset();
      pass.state.shade_model = ShadeModel::flat;
      pass.state.depth_test = {true, CompareFunction::less, true};
      pass.state.alpha_test.enabled = pass.state.stencil_test.enabled = false;
    }
  }
  if (random.one_in(2)) {
    scene.clear = ClearValues{.color = {random.byte(), random.byte(), random.byte(), random.byte()},
                              .depth = random.one_in(2) ? 1.0 : random.real(0, 1),
                              .stencil = random.below(256)};
  }
  return scene;
}

PassScene random_equal_passes(Random& random, int passes) {
  PassScene scene = random_passes(random, passes);
  scene.passes[0].state.depth_test = {true, CompareFunction::less, true};
  scene.passes[0].state.alpha_test.enabled = false;
  scene.passes[0].state.stencil_test = {.enabled = true, .front = {.depth_pass = StencilOperation::incr}};
  if (random.one_in(2)) {  // the nearest depth alone
    scene.passes[0].state.stencil_test.enabled = false;
    scene.passes[0].state.color_mask = {};
    for (RandomPass& pass : scene.passes) pass.state.polygon_offset.fill = false;
  }
  for (std::size_t i = 1; i < scene.passes.size(); ++i) {
    PipelineState& state = scene.passes[i].state;
    state.color_mask = scene.passes[1].state.color_mask;
    if (!state.program) state.shade_model = ShadeModel::smooth;
    scene.passes[i].secondary_colors.clear();
    state.depth_test = {true, CompareFunction::equal, false};
    state.stencil_test.enabled = !random.one_in(4);
    state.stencil_test.back.reset();
    StencilFace& face = state.stencil_test.front;
    face.fail = face.depth_fail = StencilOperation::keep;
    face.mask = random.one_in(4) ? 0xFFU : 1U;
    face.write_mask = random.one_in(2) ? 1U : 0xFFU;
    face.reference = random.below(3);
    face.function = random.one_in(3) ? CompareFunction::always : CompareFunction::equal;
    // (A pass whose stencil test depends on what it writes cannot repeat another's fragments.)
    const bool writes = face.function == CompareFunction::always ? !random.one_in(4) : random.one_in(6);
    face.depth_pass = writes
                          ? random.pick({StencilOperation::replace, StencilOperation::incr, StencilOperation::invert})
                          : StencilOperation::keep;
  }
  if (scene.clear) scene.clear = ClearValues{.color = scene.clear->color, .stencil = random.below(3)};
  if (!random.one_in(4)) return scene;
  // More fragments of equal depth than are kept.
  const auto corners = std::min<std::size_t>(scene.positions.size(), 30);
  const int copies = random.between(4, 9);
  scene.indices.clear();
  for (int i = 0; i < copies; ++i) {
    for (std::size_t k = 0; k < corners; ++k) scene.indices.push_back(static_cast<std::uint32_t>(k));
  }
  scene.type = PrimitiveType::triangles;
  for (RandomPass& pass : scene.passes) {
    while (!pass.primitive_colors.empty() && pass.primitive_colors.size() < scene.indices.size() / 3) {
      pass.primitive_colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
    }
    pass.primitive_colors.resize(std::min(pass.primitive_colors.size(), scene.indices.size() / 3));
  }
  return scene;
}

std::string describe(const PassScene& scene) {
  std::ostringstream out;
  out << scene.width << 'x' << scene.height << " format " << static_cast<int>(scene.format) << ", planes ";
  for (const bool has : scene.has_color) out << has;
  out << scene.has_stencil << ", type " << static_cast<int>(scene.type) << ", " << scene.positions.size()
      << " vertices, " << scene.indices.size() << " indices, clear " << scene.clear.has_value();
  for (const RandomPass& pass : scene.passes) {
    const PipelineState& s = pass.state;
    out << "\n  " << describe_operations(s) << ", profile " << s.profile.name << ", program " << s.program.has_value()
        << ", smooth " << (s.shade_model == ShadeModel::smooth) << ", offset " << s.polygon_offset.fill << ", scissor "
        << s.scissor.has_value() << ", colours " << pass.vertex_colors.size() << ' ' << pass.primitive_colors.size();
  }
  return out.str();
}

bool same_planes(const oracle::Picture& a, const oracle::Picture& b, bool with_depth) {
  return a.color == b.color && a.stencil == b.stencil && (!with_depth || a.depth == b.depth);
}

}  // namespace ninebit::test

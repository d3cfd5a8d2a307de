#include "combiner_tests/raster/random_scene.h"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "combiner_tests/raster/fragment_support.h"

namespace ninebit::test {
namespace {

oracle::NumberFormat numbers_of(const RandomScene& scene) {
  return oracle::number_format(scene.start.format);
}

// Primitives, modes and rectangles; the fragment operations come from fragment_support.h.
PipelineState random_state(Random& random, const RandomScene& scene) {
  PipelineState state;
  randomize_operations(random, scene, state);
  state.profile.subpixel_bits.value = random.one_in(4) ? random.below(5) : 4;
  if (random.one_in(8)) state.profile.polygon_offset_slope.value = OffsetSlope::root;
  if (random.one_in(4)) state.profile.polygon_offset_fraction.value = OffsetFraction::rounded;
  if (random.one_in(4)) state.profile.color_interpolation.value = ColorInterpolation::affine;
  if (random.one_in(4)) state.profile.surface_blend.value = SurfaceBlend::bytes;
  if (random.one_in(4)) state.profile.coverage_narrowing.value = Narrowing::toward_zero;
  if (random.one_in(4)) state.profile.depth_narrowing.value = Narrowing::nearest_halves_up;
  if (random.one_in(3)) state.profile.color_weights.value = ColorWeights::exact;
  state.shade_model = random.one_in(2) ? ShadeModel::flat : ShadeModel::smooth;
  state.cull_face = random.one_in(2) ? CullFace::none : static_cast<CullFace>(random.below(4));
  state.front_face = random.one_in(3) ? FrontFace::clockwise : FrontFace::counter_clockwise;
  if (random.one_in(3)) state.front_mode = static_cast<PolygonMode>(random.below(3));
  if (random.one_in(3)) state.back_mode = static_cast<PolygonMode>(random.below(3));
  if (random.one_in(3)) state.profile.line_shape.value = LineShape::diamonds;
  if (random.one_in(3)) state.profile.point_shape.value = PointShape::whole_pixels;
  const auto pixels = [&](std::initializer_list<int> wide, int least_eighths) {
    const int whole = random.one_in(2) ? random.between(1, 5) : random.pick(wide);
    return static_cast<float>(random.one_in(3) ? random.between(least_eighths, 60) : 8 * whole) / 8.0F;
  };
  state.point_size = pixels({1, 2, 7, 8, 33, 64}, 0);
  state.line_width = pixels({1, 2, 5, 8, 31, 64}, 1);
  if (random.one_in(3)) {
    PolygonOffset& o = state.polygon_offset;
    o = {random.one_in(2), random.one_in(2), random.one_in(2), 0, 0};
    o.factor = static_cast<float>(random.between(-64, 64)) / static_cast<float>(random.pick({1, 2, 16}));
    o.units = static_cast<float>(random.between(-4000, 4000)) / static_cast<float>(random.pick({1, 2, 16}));
    if (random.one_in(6)) o.factor = random.pick({0.0F, 1e30F, -1e30F});
    if (random.one_in(6)) o.units = random.pick({0.0F, 0.5F, -0.5F, 3e38F, -3e38F});
  }
  const auto rect = [&](bool inside) {
    PixelRect r{random.between(inside ? 0 : -9, scene.width - 1), random.between(inside ? 0 : -9, scene.height - 1), 1,
                1};
    r.width = random.between(1, inside ? scene.width - r.x : scene.width + 9);
    r.height = random.between(1, inside ? scene.height - r.y : scene.height + 9);
    return r;
  };
  state.polygon_smooth = random.one_in(6);
  state.line_smooth = random.one_in(4);
  if (random.one_in(5)) state.polygon_stipple = random_stipple(random);
  if (random.one_in(3)) state.viewport = rect(true);
  if (random.one_in(3)) state.scissor = rect(false);
  const oracle::NumberFormat numbers = numbers_of(scene);
  // The oracle's smooth colours are those without perspective.
  if (numbers.is_w) state.profile.color_interpolation.value = ColorInterpolation::affine;
  if (numbers.exponent_bits > 0 && random.one_in(2)) {
    state.float_depth_one = random.pick({1.0F, 512.0F, 0x1p25F, 1e30F, 0.01F});
  }
  if (random.one_in(2)) state.program = pass_through(Register::primary, Register::primary);
  return state;
}

// A position on the snapping grid: centres, corners and borders of pixels, places near an earlier vertex, or outside.
std::int64_t random_position(Random& random, int size, std::int64_t earlier, int subpixel_bits) {
  std::int64_t q4 = random.between(-8 * size - 40, 24 * size + 40);
  switch (random.below(8)) {
    case 0:
      q4 = 16 * random.between(-1, size) + 8;  // a centre
      break;
    case 1:
      q4 = 16 * random.between(0, size);  // a border
      break;
    case 2:
      q4 = earlier;  // an axis-parallel edge
      break;
    case 3:
      q4 = earlier + random.between(-12, 12);  // a sliver, a line within a pixel
      break;
    case 4:
      q4 = random.between(0, 16 * size);
      break;
    case 5:
      // A primitive much larger than the target.
      if (random.one_in(2)) q4 = random.one_in(2) ? -16 * 4000 : 16 * 4000;
      break;
    default:
      break;
  }
  const std::int64_t cell = std::int64_t{1} << (4 - subpixel_bits);
  return q4 / cell * cell;
}

// Window depth that is the same in fractions and in floats: 1/1024 of the clip range, depth ranges in eighths.
void add_depth(Random& random, DepthStencilFormat format, RandomDraw& draw) {
  const std::int64_t deepest = std::int64_t{max_depth(format)} << (24 - depth_bits(format));
  const bool has_range = draw.state.depth_near != 0 || draw.state.depth_far != 1;
  const bool few = random.one_in(2);
  for (oracle::WindowVertex& v : draw.vertices) {
    if (has_range) {
      const int z_1024 = few ? random.pick({-1024, 0, 512, 1024}) : random.between(-1024, 1024);
      const auto near_8 = static_cast<std::int64_t>(std::clamp(draw.state.depth_near, 0.0F, 1.0F) * 8);
      const auto far_8 = static_cast<std::int64_t>(std::clamp(draw.state.depth_far, 0.0F, 1.0F) * 8);
      const std::int64_t n = (near_8 * (1024 - z_1024) + far_8 * (1024 + z_1024)) * deepest;
      v.z24 = (2 * n + 16384) / 32768;
      draw.clip_z.push_back(static_cast<float>(z_1024) / 1024);
    } else {
      v.z24 = few ? static_cast<std::int64_t>(some_depth(random, format)) << (24 - depth_bits(format))
                  : random.between(0, static_cast<int>(deepest));
      draw.clip_z.push_back(static_cast<float>(static_cast<double>(v.z24) * 2 / static_cast<double>(deepest) - 1));
    }
  }
}

// The number of window depth 1, or the largest w.
double number_of_one(const PipelineState& state, DepthStencilFormat format) {
  const oracle::NumberFormat numbers = oracle::number_format(format);
  if (state.float_depth_one && !numbers.is_w) return static_cast<double>(*state.float_depth_one);
  return oracle::largest_number(depth_bits(format), numbers.exponent_bits);
}

// Numbers whose codes do not depend on how sums of doubles are rounded: those of the few that are not 0 or 1 have bits
// beyond those of any code.
void add_numbers(Random& random, DepthStencilFormat format, RandomDraw& draw) {
  const bool few = random.one_in(2);
  const float size = random.pick({1.0F, 30.0F, 600.0F, 70000.0F});
  const double near = static_cast<double>(std::clamp(draw.state.depth_near, 0.0F, 1.0F));
  const double far = static_cast<double>(std::clamp(draw.state.depth_far, 0.0F, 1.0F));
  for (oracle::WindowVertex& v : draw.vertices) {
    const float z = few ? random.pick({-1.0F, -0.3712345F, 0.2193721F, 1.0F}) : random.real_f(-1, 1);
    draw.clip_z.push_back(z);
    if (oracle::number_format(format).is_w) {
      const float w = (few ? random.pick({0.5123457F, 0.7712345F, 0.9876543F}) : random.real_f(0.5, 1)) * size;
      draw.clip_w.push_back(w);
      v.number = 1 / static_cast<double>(1.0F / w);
    } else {
      const double window = static_cast<double>(z) * (far - near) / 2 + (far + near) / 2;
      v.number = static_cast<double>(static_cast<float>(window)) * number_of_one(draw.state, format);
    }
  }
}

void add_geometry(Random& random, const RandomScene& scene, RandomDraw& draw) {
  const int bits = draw.state.profile.subpixel_bits;
  draw.type = random.one_in(3) ? PrimitiveType::triangles : static_cast<PrimitiveType>(random.below(10));
  const int vertices = random.between(1, 14);
  oracle::WindowVertex earlier{16 * (scene.width / 2) + 8, 16 * (scene.height / 2) + 8, 0};
  for (int i = 0; i < vertices; ++i) {
    oracle::WindowVertex v;
    v.x_q4 = random_position(random, scene.width, earlier.x_q4, bits);
    v.y_q4 = random_position(random, scene.height, earlier.y_q4, bits);
    draw.vertices.push_back(v);
    if (random.one_in(3)) earlier = draw.vertices[static_cast<std::size_t>(random.below(i + 1))];
  }
  if (random.one_in(4)) {
    draw.state.depth_near = static_cast<float>(random.between(-1, 9)) / 8;
    draw.state.depth_far = static_cast<float>(random.between(-1, 9)) / 8;
  }
  (numbers_of(scene).has_numbers() ? add_numbers : add_depth)(random, scene.start.format, draw);
  if (random.one_in(5)) return;
  const auto index = [&] { return static_cast<std::uint32_t>(random.below(vertices)); };
  const int count = random.one_in(5) ? random.between(30, 90) : random.between(1, 24);
  for (int i = 0; i < count; ++i) draw.indices.push_back(index());
  if (draw.type != PrimitiveType::triangles) return;
  for (std::size_t i = 3; i + 2 < draw.indices.size(); i += 3) {  // neighbours across the first edge, most often
    if (random.one_in(3)) continue;
    draw.indices[i] = draw.indices[i - 2];
    draw.indices[i + 1] = draw.indices[i - 3];
  }
}

std::size_t primitives_of(const RandomDraw& draw) {
  const std::size_t n = draw.indices.empty() ? draw.vertices.size() : draw.indices.size();
  const auto strip = [n](std::size_t first) { return n > first ? n - first : 0; };
  switch (draw.type) {
    case PrimitiveType::points:
      return n;
    case PrimitiveType::lines:
      return n / 2;
    case PrimitiveType::line_strip:
      return strip(1);
    case PrimitiveType::line_loop:
      return n < 2 ? 0 : n;
    case PrimitiveType::triangles:
      return n / 3;
    case PrimitiveType::triangle_strip:
    case PrimitiveType::triangle_fan:
      return strip(2);
    case PrimitiveType::quads:
      return n / 4;
    case PrimitiveType::quad_strip:
      return strip(2) / 2;
    case PrimitiveType::polygon:
      return n < 3 ? 0 : 1;
  }
  return 0;
}

void add_colors(Random& random, RandomDraw& draw) {
  const auto color = [&] { return ColorBytes{random.byte(), edge_byte(random), random.byte(), edge_byte(random)}; };
  switch (random.below(4)) {
    case 0:
      break;  // opaque white
    case 1:
      for (std::size_t i = 0; i < primitives_of(draw); ++i) draw.primitive_colors.push_back(color());
      break;
    case 2:
      draw.vertex_colors.assign(draw.vertices.size(), color());
      break;
    default: {
      const std::uint8_t alpha = edge_byte(random);  // equal, so that the alpha test stays exact
      for (std::size_t i = 0; i < draw.vertices.size(); ++i) {
        draw.vertex_colors.push_back(color());
        if (draw.state.shade_model == ShadeModel::smooth) draw.vertex_colors.back()[3] = alpha;
      }
      draw.exact_color = draw.state.shade_model == ShadeModel::flat;
    }
  }
}

void add_clear(Random& random, DepthStencilFormat format, RandomDraw& draw) {
  draw.clear = {.clears_color = random.one_in(2),
                .clears_depth = random.one_in(2),
                .clears_stencil = random.one_in(2),
                .color = {random.byte(), edge_byte(random), random.byte(), edge_byte(random)},
                .depth = some_depth(random, format),
                .stencil = edge_byte(random)};
  const auto largest = static_cast<double>(max_depth(format));
  draw.clear_depth = draw.clear->depth / largest;
  const oracle::NumberFormat numbers = oracle::number_format(format);
  if (!numbers.has_numbers()) return;
  draw.clear_depth = random.one_in(3) ? random.pick({0.0, 1.0}) : random.real(0, 1);
  const double number = draw.clear_depth * number_of_one(draw.state, format);
  draw.clear->depth = oracle::number_code(depth_bits(format), numbers.exponent_bits, number, false);
}

}  // namespace

void randomize_operations(Random& random, const RandomScene& scene, PipelineState& state) {
  randomize_fragment_operations(random, state);
  if (!facts_of(scene.start.color_format).blends()) state.blend = {};
  if (numbers_of(scene).has_numbers() && stencil_bits(scene.start.format) == 0) state.stencil_test.enabled = false;
}

RandomScene random_scene(Random& random, bool with_numbers) {
  RandomScene scene;
  const auto size = [&] {
    return random.one_in(4) ? random.pick({1, 2, 15, 16, 63, 64, 65, 70})
                            : random.between(1, random.pick({20, 40, 70}));
  };
  scene.width = size();
  scene.height = size();
  scene.captures = random.one_in(3);
  const auto format = static_cast<DepthStencilFormat>(random.below(with_numbers ? 9 : 3));
  scene.start = random_picture(random, scene.width, scene.height, format);
  scene.start.has_alpha = !random.one_in(4);
  const int draws = random.between(1, 3);
  for (int i = 0; i < draws; ++i) {
    RandomDraw draw;
    draw.state = random_state(random, scene);
    add_geometry(random, scene, draw);
    add_colors(random, draw);
    if (random.one_in(4)) add_clear(random, scene.start.format, draw);
    scene.draws.push_back(draw);
  }
  // Equal geometry again, for the EQUAL and LEQUAL tests of depth: only the fragment operations are others.
  if (random.one_in(3)) {
    RandomDraw again = scene.draws[0];
    randomize_operations(random, scene, again.state);
    again.clear.reset();
    scene.draws.push_back(again);
  }
  // Smooth colours may differ by one, which blending would not leave at that.
  const bool exact = std::all_of(scene.draws.begin(), scene.draws.end(), [](const auto& d) { return d.exact_color; });
  for (RandomDraw& draw : scene.draws) draw.state.blend.enabled = draw.state.blend.enabled && exact;
  // Nor would formats of fewer bits.
  const bool blends =
      std::any_of(scene.draws.begin(), scene.draws.end(), [](const auto& d) { return d.state.blend.enabled; });
  if (exact) set_color_format(random_color_format(random, blends), scene.start);
  return scene;
}

oracle::DrawCall for_oracle(const RandomDraw& draw) {
  // The library's types by their GL numbers.
  constexpr oracle::Primitive kTypes[] = {oracle::Primitive::points,       oracle::Primitive::lines,
                                          oracle::Primitive::line_strip,   oracle::Primitive::line_loop,
                                          oracle::Primitive::triangles,    oracle::Primitive::triangle_strip,
                                          oracle::Primitive::triangle_fan, oracle::Primitive::quads,
                                          oracle::Primitive::quad_strip,   oracle::Primitive::polygon};
  oracle::DrawCall call;
  call.type = kTypes[static_cast<std::size_t>(draw.type)];
  call.primitive_colors = draw.primitive_colors;
  const auto add = [&](std::size_t v) {
    call.vertices.push_back({draw.vertices[v]});
    if (!draw.vertex_colors.empty()) call.vertices.back().color = draw.vertex_colors[v];
  };
  for (const std::uint32_t index : draw.indices) add(index);
  for (std::size_t v = 0; v < draw.vertices.size() && draw.indices.empty(); ++v) add(v);
  return call;
}

LibraryDraw for_library(const RandomDraw& draw, int width, int height) {
  LibraryDraw out;
  const PixelRect viewport = draw.state.viewport.value_or(PixelRect{0, 0, width, height});
  for (std::size_t i = 0; i < draw.vertices.size(); ++i) {
    out.positions.push_back(clip_position(draw.vertices[i], viewport, draw.state.profile.subpixel_bits));
    out.positions.back().z = draw.clip_z[i];
    if (!draw.clip_w.empty()) out.homogeneous_positions.push_back(glm::vec4(out.positions.back(), 1) * draw.clip_w[i]);
  }
  out.arrays.type = draw.type;
  if (draw.clip_w.empty()) out.arrays.positions = out.positions;
  out.arrays.homogeneous_positions = out.homogeneous_positions;
  out.arrays.indices = draw.indices;
  out.arrays.vertex_colors = draw.vertex_colors;
  out.arrays.primitive_colors = draw.primitive_colors;
  return out;
}

std::string describe(const RandomScene& scene) {
  std::ostringstream out;
  out << scene.width << 'x' << scene.height << " format " << static_cast<int>(scene.start.format) << " alpha "
      << scene.start.has_alpha << " colours " << facts_of(scene.start.color_format).name
      << (scene.captures ? ", captures" : "") << '\n';
  const auto rect = [&](const char* name, const std::optional<PixelRect>& r) {
    if (r) out << ", " << name << ' ' << r->x << ' ' << r->y << ' ' << r->width << ' ' << r->height;
  };
  const auto color = [&](const char* name, const ColorBytes& c) {
    out << "  " << name << ' ' << int{c[0]} << ' ' << int{c[1]} << ' ' << int{c[2]} << ' ' << int{c[3]} << '\n';
  };
  for (const RandomDraw& d : scene.draws) {
    const PipelineState& s = d.state;
    out << "draw: type " << static_cast<int>(d.type) << ", subpixel bits " << s.profile.subpixel_bits << ", shade "
        << static_cast<int>(s.shade_model) << ", cull " << static_cast<int>(s.cull_face) << ", front face "
        << static_cast<int>(s.front_face) << ", modes " << static_cast<int>(s.front_mode) << ' '
        << static_cast<int>(s.back_mode) << ", point size " << s.point_size << ", line width " << s.line_width
        << ", smooth " << s.polygon_smooth << s.line_smooth << ", stipple " << s.polygon_stipple.has_value()
        << ", blend reads " << static_cast<int>(s.profile.surface_blend.value) << ", shapes "
        << static_cast<int>(s.profile.point_shape.value) << ' ' << static_cast<int>(s.profile.line_shape.value)
        << ", offset " << s.polygon_offset.fill << s.polygon_offset.line << s.polygon_offset.point << ' '
        << s.polygon_offset.factor << ' ' << s.polygon_offset.units << " slope "
        << static_cast<int>(s.profile.polygon_offset_slope.value) << " fraction "
        << static_cast<int>(s.profile.polygon_offset_fraction.value) << ", depth range " << s.depth_near << ' '
        << s.depth_far << ", program " << s.program.has_value() << ", clear " << d.clear.has_value();
    rect("viewport", s.viewport);
    rect("scissor", s.scissor);
    out << "\n  " << describe_operations(s) << '\n';
    for (const auto& v : d.vertices)
      out << "  vertex " << v.x_q4 << ' ' << v.y_q4 << ' ' << v.z24 << ' ' << v.number << '\n';
    if (!d.indices.empty()) out << "  indices";
    for (const std::uint32_t i : d.indices) out << ' ' << i;
    out << '\n';
    for (const auto& c : d.vertex_colors) color("vertex colour", c);
    for (const auto& c : d.primitive_colors) color("primitive colour", c);
  }
  return out.str();
}

}  // namespace ninebit::test

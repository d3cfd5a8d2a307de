#include "combiner_tests/raster/random_scene.h"

#include <algorithm>
#include <sstream>

namespace ninebit::test {
namespace {

constexpr std::uint8_t kAlphas[] = {0, 1, 127, 128, 254, 255};
constexpr std::uint32_t kDepths[] = {0, 1, 0x7FFFFF, 0x800000, 0xFFFFFE, 0xFFFFFF};

template <class T, std::size_t N>
T any_of(Random& random, const T (&values)[N]) {
  return values[random.below(static_cast<int>(N))];
}

template <class Enum>
Enum any_enum(Random& random) {
  return static_cast<Enum>(random.below(8));  // the compare functions and the stencil operations are eight each
}

std::uint8_t edge_byte(Random& random) {
  return random.one_in(3) ? random.byte() : any_of(random, kAlphas);
}

PipelineState random_state(Random& random) {
  PipelineState state;
  state.profile.subpixel_bits.value = random.one_in(4) ? random.below(5) : 4;
  state.alpha_test = {random.one_in(2), any_enum<CompareFunction>(random), edge_byte(random)};
  StencilTest& stencil = state.stencil_test;
  stencil.enabled = !random.one_in(3);
  stencil.function = random.one_in(3) ? CompareFunction::always : any_enum<CompareFunction>(random);
  stencil.reference = edge_byte(random);
  stencil.mask = random.one_in(2) ? 0xFF : random.byte();
  stencil.write_mask = random.one_in(2) ? 0xFF : edge_byte(random);
  stencil.fail = any_enum<StencilOperation>(random);
  stencil.depth_fail = any_enum<StencilOperation>(random);
  stencil.depth_pass = any_enum<StencilOperation>(random);
  // The rasterizer may take short cuts where nothing is written.
  if (random.one_in(3)) stencil.fail = stencil.depth_fail = StencilOperation::keep;
  if (random.one_in(4)) stencil.depth_pass = StencilOperation::keep;
  state.depth_test = {!random.one_in(3), any_enum<CompareFunction>(random), !random.one_in(3)};
  for (bool& mask : state.color_mask) mask = !random.one_in(6);
  if (random.one_in(8)) state.color_mask = {};
  state.shade_model = random.one_in(2) ? ShadeModel::flat : ShadeModel::smooth;
  state.cull_face = random.one_in(2) ? CullFace::none : random.one_in(2) ? CullFace::front : CullFace::back;
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
      q4 = earlier + random.between(-3, 3);  // a sliver
      break;
    case 4:
      q4 = random.between(0, 16 * size);
      break;
    case 5:
      q4 = random.one_in(2) ? -16 * 4000 : 16 * 4000;  // a triangle much larger than the target
      break;
    default:
      break;
  }
  const std::int64_t cell = std::int64_t{1} << (4 - subpixel_bits);
  return q4 / cell * cell;
}

void add_geometry(Random& random, const RandomScene& scene, RandomDraw& draw) {
  const int bits = draw.state.profile.subpixel_bits;
  const int vertices = random.between(3, 14);
  const bool few_depths = random.one_in(2);
  oracle::WindowVertex earlier{16 * (scene.width / 2) + 8, 16 * (scene.height / 2) + 8, 0};
  for (int i = 0; i < vertices; ++i) {
    oracle::WindowVertex v;
    v.x_q4 = random_position(random, scene.width, earlier.x_q4, bits);
    v.y_q4 = random_position(random, scene.height, earlier.y_q4, bits);
    v.z24 =
        few_depths ? std::int64_t{any_of(random, kDepths)} : static_cast<std::int64_t>(random.next() & kMaxDepthZ24);
    draw.vertices.push_back(v);
    if (random.one_in(3)) earlier = draw.vertices[static_cast<std::size_t>(random.below(i + 1))];
  }
  const int triangles = random.one_in(5) ? random.between(20, 60) : random.between(1, 10);
  for (int i = 0; i < triangles; ++i) {
    const auto index = [&] { return static_cast<std::uint32_t>(random.below(vertices)); };
    draw.triangles.emplace_back(index(), index(), index());
    // A neighbour across the first edge, most often.
    if (!random.one_in(4)) draw.triangles.emplace_back(draw.triangles.back().y, draw.triangles.back().x, index());
  }
}

void add_colors(Random& random, RandomDraw& draw) {
  const auto color = [&] {
    return ColorBytes{random.byte(), edge_byte(random), random.byte(), any_of(random, kAlphas)};
  };
  switch (random.below(4)) {
    case 0:
      break;  // opaque white
    case 1:
      for (std::size_t i = 0; i < draw.triangles.size(); ++i) draw.triangle_colors.push_back(color());
      // Smooth shading would have nothing to interpolate.
      break;
    case 2:
      draw.vertex_colors.assign(draw.vertices.size(), color());
      break;
    default: {
      const std::uint8_t alpha = any_of(random, kAlphas);  // equal, so that the alpha test stays exact
      for (std::size_t i = 0; i < draw.vertices.size(); ++i) {
        draw.vertex_colors.push_back(color());
        draw.vertex_colors.back()[3] = alpha;
      }
      draw.exact_color = draw.state.shade_model == ShadeModel::flat;
    }
  }
}

oracle::Picture random_start(Random& random, int width, int height) {
  oracle::Picture p;
  p.width = width;
  p.height = height;
  const bool noise = random.one_in(2);
  const std::uint32_t depth = any_of(random, kDepths);
  const std::uint8_t stencil = edge_byte(random);
  for (int i = 0; i < width * height; ++i) {
    p.color.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
    p.depth_z24.push_back(noise ? static_cast<std::uint32_t>(random.next() & kMaxDepthZ24) : depth);
    p.stencil.push_back(noise ? edge_byte(random) : stencil);
    p.primitive.push_back(0xFFFFFFFF);
    p.captured.push_back(-1);
  }
  return p;
}

}  // namespace

RandomScene random_scene(Random& random) {
  RandomScene scene;
  const auto size = [&] {
    return random.one_in(3) ? random.pick({1, 2, 15, 16, 63, 64, 65, 70}) : random.between(1, 70);
  };
  scene.width = size();
  scene.height = size();
  scene.captures = random.one_in(3);
  scene.start = random_start(random, scene.width, scene.height);
  const int draws = random.between(1, 3);
  for (int i = 0; i < draws; ++i) {
    RandomDraw draw;
    draw.state = random_state(random);
    add_geometry(random, scene, draw);
    add_colors(random, draw);
    scene.draws.push_back(draw);
  }
  // Equal geometry again, for the EQUAL and LEQUAL tests of depth.
  if (random.one_in(3)) {
    RandomDraw again = scene.draws[0];
    const int bits = again.state.profile.subpixel_bits;
    again.state = random_state(random);
    again.state.profile.subpixel_bits.value = bits;
    again.exact_color = again.state.shade_model == ShadeModel::flat || scene.draws[0].exact_color;
    // What was exact under flat shading may have had several colours.
    if (!again.vertex_colors.empty() && again.state.shade_model == ShadeModel::smooth) {
      again.exact_color = std::all_of(again.vertex_colors.begin(), again.vertex_colors.end(),
                                      [&](const ColorBytes& c) { return c == again.vertex_colors[0]; });
    }
    scene.draws.push_back(again);
  }
  return scene;
}

std::vector<oracle::DrawnTriangle> for_oracle(const RandomDraw& draw) {
  std::vector<oracle::DrawnTriangle> out;
  for (std::size_t i = 0; i < draw.triangles.size(); ++i) {
    const glm::uvec3 v = draw.triangles[i];
    oracle::DrawnTriangle t;
    t.number = static_cast<std::uint32_t>(i);
    for (int k = 0; k < 3; ++k) {
      const auto corner = static_cast<std::size_t>(k);
      t.corners[corner] = draw.vertices[v[k]];
      t.colors[corner] = {255, 255, 255, 255};
      if (!draw.triangle_colors.empty()) t.colors[corner] = draw.triangle_colors[i];
      if (!draw.vertex_colors.empty()) t.colors[corner] = draw.vertex_colors[v[k]];
    }
    out.push_back(t);
  }
  return out;
}

Mesh for_library(const RandomDraw& draw, int width, int height) {
  Mesh mesh;
  for (const oracle::WindowVertex& v : draw.vertices) {
    mesh.add(clip_position(v, width, height, draw.state.profile.subpixel_bits));
  }
  mesh.triangles = draw.triangles;
  mesh.vertex_colors = draw.vertex_colors;
  mesh.triangle_colors = draw.triangle_colors;
  return mesh;
}

std::string describe(const RandomScene& scene) {
  std::ostringstream out;
  out << scene.width << 'x' << scene.height << (scene.captures ? ", captures" : "") << '\n';
  for (const RandomDraw& d : scene.draws) {
    const auto& a = d.state.alpha_test;
    const auto& s = d.state.stencil_test;
    const auto& z = d.state.depth_test;
    out << "draw: subpixel bits " << d.state.profile.subpixel_bits.value << ", alpha " << a.enabled << ' '
        << static_cast<int>(a.function) << ' ' << int{a.reference} << ", stencil " << s.enabled << ' '
        << static_cast<int>(s.function) << ' ' << int{s.reference} << " masks " << int{s.mask} << ' '
        << int{s.write_mask} << " operations " << static_cast<int>(s.fail) << ' ' << static_cast<int>(s.depth_fail)
        << ' ' << static_cast<int>(s.depth_pass) << ", depth " << z.enabled << ' ' << static_cast<int>(z.function)
        << " write " << z.write << ", colour mask " << d.state.color_mask[0] << d.state.color_mask[1]
        << d.state.color_mask[2] << d.state.color_mask[3] << ", shade " << static_cast<int>(d.state.shade_model)
        << ", cull " << static_cast<int>(d.state.cull_face) << ", program " << d.state.program.has_value() << '\n';
    for (const auto& v : d.vertices) out << "  vertex " << v.x_q4 << ' ' << v.y_q4 << ' ' << v.z24 << '\n';
    for (const auto& t : d.triangles) out << "  triangle " << t.x << ' ' << t.y << ' ' << t.z << '\n';
    for (const auto& c : d.vertex_colors)
      out << "  vertex colour " << int{c[0]} << ' ' << int{c[1]} << ' ' << int{c[2]} << ' ' << int{c[3]} << '\n';
    for (const auto& c : d.triangle_colors)
      out << "  triangle colour " << int{c[0]} << ' ' << int{c[1]} << ' ' << int{c[2]} << ' ' << int{c[3]} << '\n';
  }
  return out.str();
}

}  // namespace ninebit::test

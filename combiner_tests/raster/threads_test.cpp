// The same planes for any number of threads, of draws that are prepared or not: every type of primitive, polygon modes,
// vertices at infinity, textures with mip-maps, perspective and clipping, operations that depend on the order of
// fragments, over many tiles and more primitives than one block holds.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/raster/texture_support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/raster/prepared_draw.h"

namespace ninebit::test {
namespace {

constexpr int kWindowWidth = 300, kWindowHeight = 200;

struct Drawn {
  std::array<PlaneSamples<std::uint8_t>, 4> color;
  PlaneSamples<std::uint32_t> depth, primitive;
  PlaneSamples<std::uint8_t> stencil;
  std::vector<float> attribute;
  friend bool operator==(const Drawn&, const Drawn&) = default;
};

// Operations that depend on the order of all fragments of a pixel.
void order_all(PipelineState& state) {
  state.stencil_test.front = {.function = CompareFunction::notequal,
                              .mask = 7,
                              .fail = StencilOperation::incr_wrap,
                              .depth_fail = StencilOperation::decr_wrap,
                              .depth_pass = StencilOperation::invert};
  state.stencil_test.back = StencilFace{.depth_fail = StencilOperation::incr};
  state.blend.destination = BlendFactor::one_minus_src_alpha;
  state.alpha_test = {true, CompareFunction::greater, 60};
  state.depth_test.function = CompareFunction::notequal;
}

// By draws that are prepared first, or not.
Drawn draw_all(int threads, bool prepares) {
  Drawn drawn;
  with_threads(threads, [&] {
    Random noise(3);
    const Texture texture = random_texture(noise, TextureTarget::texture_2d, InternalFormat::rgba8, 64, 64, true);
    const std::array<TextureUnit, 1> units{TextureUnit{&texture, {.min_filter = MinFilter::linear_mipmap_linear}}};
    Surface surface = Surface::make(kWindowWidth, kWindowHeight, {.with_primitive = true}).value();
    RenderTarget target = surface.target();
    drawn.attribute.assign(kWindowWidth * kWindowHeight, -1.0F);
    target.outputs.push_back({.source = OutputSource::attribute,
                              .attribute = 0,
                              .component = 1,
                              .plane = Plane<float>{drawn.attribute.data(), kWindowWidth}});
    for (int i = 0; i < 20; ++i) {
      Random random(71, static_cast<std::uint64_t>(i));
      const PrimitiveType type = static_cast<PrimitiveType>(i % 10);
      std::vector<glm::vec3> positions, coordinates;
      std::vector<ColorBytes> colors;
      PlaneSamples<std::uint32_t> indices;
      std::vector<glm::vec4> attributes, homogeneous;
      const int vertices = type == PrimitiveType::polygon ? 60 : 9000;
      for (int v = 0; v < vertices; ++v) {
        positions.emplace_back(random.real_f(-3, 3), random.real_f(-3, 3), random.real_f(-6, 0.1));
        if (v % 4 != 0) positions.back() = positions[positions.size() - 2] + positions.back() * 0.03F;
        indices.push_back(static_cast<std::uint32_t>(random.one_in(5) ? random.below(v + 1) : v));
        homogeneous.emplace_back(positions.back(), random.one_in(3) ? 0 : 1);
        coordinates.emplace_back(random.real_f(-2, 2), random.real_f(-2, 2), 0.0F);
        colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
        attributes.emplace_back(0.0F, random.real_f(0, 1), 0.0F, 1.0F);
      }
      PipelineState state;
      state.front_mode = static_cast<PolygonMode>(i / 2 % 3);
      state.back_mode = static_cast<PolygonMode>(i / 3 % 3);
      state.line_width = static_cast<float>(random.between(1, 24)) / 8.0F;
      state.point_size = static_cast<float>(random.between(0, 32)) / 8.0F;
      state.polygon_offset = {true, true, true, 1.5F, -3.0F};
      state.depth_test = {true, CompareFunction::lequal, true};
      state.stencil_test = {.enabled = true, .front = {.depth_pass = StencilOperation::incr_wrap}};
      state.blend = {.enabled = true, .source = BlendFactor::src_alpha, .destination = BlendFactor::one};
      if (i % 2 == 0) state.program = pass_through(Register::texture0, Register::primary);
      if (i % 4 >= 2) order_all(state);
      VertexArrays arrays{.type = type, .vertex_colors = colors};
      if (i % 5 == 4) {
        arrays.homogeneous_positions = homogeneous;
      } else {
        arrays.positions = positions;
      }
      if (i % 3 != 0) arrays.indices = indices;
      arrays.texture_coordinates[0] = coordinates;
      arrays.attributes[0] = attributes;
      const glm::mat4 matrix = perspective(0.8, static_cast<double>(kWindowWidth) / kWindowHeight, 0.1, 10);
      PreparedDraw prepared;
      Status status =
          prepares ? prepare(state, matrix, arrays, target, prepared) : rasterize(state, matrix, arrays, units, target);
      if (prepares && status) status = rasterize(state, prepared, arrays, units, target);
      EXPECT_TRUE(status.ok()) << status.error().message;
    }
    for (int k = 0; k < 4; ++k) drawn.color[static_cast<std::size_t>(k)] = surface.color(k);
    drawn.depth = surface.depth();
    drawn.primitive = surface.primitive();
    drawn.stencil = surface.stencil();
  });
  return drawn;
}

TEST(Threads, EveryPrimitiveGivesTheSamePlanes) {
  if (kCoverage) GTEST_SKIP() << "too long without optimization, and other tests reach the same lines";
  const Drawn one = draw_all(1, false);
  EXPECT_GE(std::count_if(one.stencil.begin(), one.stencil.end(), [](std::uint8_t s) { return s > 2; }), 20000);
  for (const auto& [threads, prepares] : {std::pair{7, true}, {7, false}, {2, true}}) {
    EXPECT_TRUE(draw_all(threads, prepares) == one) << threads << prepares;
    if (kSlowBuild && !prepares) break;
  }
}

}  // namespace
}  // namespace ninebit::test

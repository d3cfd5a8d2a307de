// The same planes for any number of threads: every type of primitive, polygon modes, textures with mip-maps,
// perspective and clipping, over many tiles and more primitives than one block holds.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "combiner_tests/raster/support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

constexpr int kWindowWidth = 300, kWindowHeight = 200;

Texture noise_texture() {
  Random random(3);
  std::vector<std::uint8_t> samples(64 * 64 * 4);
  for (std::uint8_t& s : samples) s = random.byte();
  const Texture base =
      make_texture(TextureTarget::texture_2d, InternalFormat::rgba8, {{{64, 64, std::move(samples)}}}).value();
  return with_mipmaps(base).value();
}

struct Drawn {
  std::array<PlaneSamples<std::uint8_t>, 4> color;
  PlaneSamples<std::uint32_t> depth, primitive;
  PlaneSamples<std::uint8_t> stencil;
  std::vector<float> attribute;
  friend bool operator==(const Drawn&, const Drawn&) = default;
};

Drawn draw_all(int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  Drawn drawn;
  arena.execute([&] {
    const Texture texture = noise_texture();
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
      std::vector<glm::vec4> attributes;
      const int vertices = type == PrimitiveType::polygon ? 60 : 9000;
      for (int v = 0; v < vertices; ++v) {
        positions.emplace_back(random.real_f(-3, 3), random.real_f(-3, 3), random.real_f(-6, 0.1));
        if (v % 4 != 0) positions.back() = positions[positions.size() - 2] + positions.back() * 0.03F;
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
      VertexArrays arrays{.type = type, .positions = positions, .vertex_colors = colors};
      arrays.texture_coordinates[0] = coordinates;
      arrays.attributes[0] = attributes;
      const glm::mat4 matrix = perspective(0.8, static_cast<double>(kWindowWidth) / kWindowHeight, 0.1, 10);
      const Status status = rasterize(state, matrix, arrays, units, target);
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
  const Drawn one = draw_all(1);
  EXPECT_GE(std::count_if(one.stencil.begin(), one.stencil.end(), [](std::uint8_t s) { return s > 2; }), 20000);
  for (const int threads : {7, 2}) {
    EXPECT_TRUE(draw_all(threads) == one) << threads;
    if (kSlowBuild) break;
  }
}

}  // namespace
}  // namespace ninebit::test

// Programs and captures in the rasterizer, stencil across draws, any number of threads.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

// Two triangles over the whole target, in front at depth z.
Mesh quad(float z, const ColorBytes& color) {
  Mesh mesh;
  for (const glm::vec2 p : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
    mesh.add({p, z});
    mesh.vertex_colors.push_back(color);
    mesh.texture_coordinates.emplace_back(p.x * 0.9F, p.y * 0.9F, 1.0F);  // looks at +Z
  }
  mesh.add_triangle(0, 1, 2);
  mesh.add_triangle(2, 3, 0);
  return mesh;
}

ColorBytes color_at(const Surface& surface, std::size_t at) {
  return {surface.color(0)[at], surface.color(1)[at], surface.color(2)[at], surface.color(3)[at]};
}

TEST(Programs, PassTheirInputsThrough) {
  std::array<std::vector<std::uint8_t>, 3> samples;
  for (std::size_t k = 0; k < 3; ++k) samples[k].assign(6, static_cast<std::uint8_t>(40 * k + 7));
  CubeMap map;
  map.size = 1;
  for (std::size_t f = 0; f < 6; ++f) {
    for (std::size_t k = 0; k < 3; ++k) map.faces[f][k] = {samples[k].data() + f, 1};
  }
  const std::array<const CubeMap*, 2> unit0{&map, nullptr};
  const Mesh mesh = quad(0, {11, 22, 33, 44});
  const std::array<std::tuple<Register, Register, ColorBytes>, 7> cases{
      {{Register::primary, Register::primary, {11, 22, 33, 44}},
       {Register::texture0, Register::texture0, {7, 47, 87, 255}},
       {Register::texture0, Register::primary, {7, 47, 87, 44}},
       {Register::texture1, Register::texture1, {0, 0, 0, 255}},  // off
       {Register::secondary, Register::secondary, {0, 0, 0, 255}},
       {Register::fog, Register::primary, {0, 0, 0, 44}},  // the final combiner reads no fog alpha here
       {Register::spare0, Register::spare0, {0, 0, 0, 255}}}};
  for (const auto& [rgb, alpha, expected] : cases) {
    PipelineState state;
    state.program = pass_through(rgb, alpha);
    Surface surface = Surface::make(70, 67).value();
    RenderTarget target = surface.target();
    const Status status = rasterize(state, kIdentity, mesh.arrays(), unit0, target);
    ASSERT_TRUE(status.ok()) << status.error().message;
    for (std::size_t at = 0; at < 70 * 67; ++at) {
      ASSERT_EQ(color_at(surface, at), expected) << name_of(rgb) << ' ' << name_of(alpha);
    }
  }
  // All units off.
  PipelineState state;
  state.program = pass_through(Register::texture0, Register::texture0);
  Surface surface = Surface::make(9, 9).value();
  RenderTarget target = surface.target();
  ASSERT_TRUE(rasterize(state, kIdentity, mesh.arrays(), {}, target).ok());
  EXPECT_EQ(color_at(surface, 40), (ColorBytes{0, 0, 0, 255}));
}

// Without a program the colour is the primary colour itself, also for a profile whose registers are narrower, and
// whatever else makes the draw go through the batch.
TEST(Programs, NoneLeavesThePrimaryColorWhole) {
  const Mesh mesh = quad(0, {11, 22, 33, 45});
  for (const bool captures : {false, true}) {
    for (const ShadeModel shade : {ShadeModel::flat, ShadeModel::smooth}) {
      PipelineState state;
      state.profile = profiles::geforce256_8bit;
      state.shade_model = shade;
      Canvas canvas(20, 20, captures);
      ASSERT_TRUE(rasterize(state, kIdentity, mesh.arrays(), {}, canvas.target).ok());
      for (const auto& color : canvas.picture().color) ASSERT_EQ(color, (ColorBytes{11, 22, 33, 45}));
    }
  }
}

// A captured register is written for each fragment that would pass the depth test, and for no other.
TEST(Captures, AskTheDepthTestAlone) {
  const int size = 40;
  for (const bool alpha_fails : {false, true}) {
    for (const bool stencil_fails : {false, true}) {
      for (const bool with_program : {false, true}) {
        Surface surface = Surface::make(size, size).value();
        surface.clear({.color = {9, 9, 9, 9}, .depth_z24 = 0x800000});
        RenderTarget target = surface.target();
        // The left half is nearer than the quad.
        for (int y = 0; y < size; ++y) std::fill_n(target.depth_z24.row(y), size / 2, 0U);
        std::vector<s9> red(static_cast<std::size_t>(size * size), -7), alpha = red, spare = red;
        target.captures = {{Register::primary, kRed, {red.data(), size}},
                           {std::nullopt, kAlpha, {alpha.data(), size}},
                           {Register::spare0, kAlpha, {spare.data(), size}},
                           {Register::primary, kRed, {}}};
        PipelineState state;
        state.depth_test.enabled = true;
        state.alpha_test = {true, alpha_fails ? CompareFunction::never : CompareFunction::always, 0};
        state.stencil_test.enabled = true;
        state.stencil_test.function = stencil_fails ? CompareFunction::never : CompareFunction::always;
        if (with_program) state.program = pass_through(Register::primary, Register::primary);
        ASSERT_TRUE(rasterize(state, kIdentity, quad(-0.5F, {11, 22, 33, 44}).arrays(), {}, target).ok());
        for (int y = 0; y < size; ++y) {
          for (int x = 0; x < size; ++x) {
            const auto at = static_cast<std::size_t>(y * size + x);
            const bool depth = x >= size / 2, drawn = depth && !alpha_fails && !stencil_fails;
            ASSERT_EQ(red[at], depth ? 11 : -7);
            ASSERT_EQ(alpha[at], depth ? 44 : -7);
            ASSERT_EQ(spare[at], depth ? 255 : -7);
            ASSERT_EQ(surface.color(0)[at], drawn ? 11 : 9);
          }
        }
      }
    }
  }
}

// Write 1 where a polygon is drawn, then draw only there.
TEST(Stencil, WriteOneThenDrawOnlyThere) {
  const int size = 90;
  Surface surface = Surface::make(size, size).value();
  RenderTarget target = surface.target();
  const oracle::WindowTriangle corners{{{216, 288, 0}, {1296, 504, 0}, {792, 1368, 0}}};
  Mesh polygon;
  for (const auto& v : corners) polygon.add(clip_position(v, size, size));
  polygon.add_triangle(0, 1, 2);
  PipelineState mark;
  mark.color_mask = {};
  mark.stencil_test.enabled = true;
  mark.stencil_test.reference = 1;
  mark.stencil_test.depth_pass = StencilOperation::replace;
  ASSERT_TRUE(rasterize(mark, kIdentity, polygon.arrays(), {}, target).ok());
  EXPECT_EQ(*std::max_element(surface.color(0).begin(), surface.color(0).end()), 0);

  PipelineState there;
  there.stencil_test.enabled = true;
  there.stencil_test.function = CompareFunction::equal;
  there.stencil_test.reference = 1;
  ASSERT_TRUE(rasterize(there, kIdentity, quad(0.5F, {200, 100, 50, 25}).arrays(), {}, target).ok());
  int inside = 0;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const auto at = static_cast<std::size_t>(y * size + x);
      const bool in = oracle::covers(corners, x, y);
      inside += in ? 1 : 0;
      ASSERT_EQ(surface.stencil()[at], in ? 1 : 0) << x << ' ' << y;
      ASSERT_EQ(color_at(surface, at), in ? (ColorBytes{200, 100, 50, 25}) : (ColorBytes{0, 0, 0, 0}));
    }
  }
  EXPECT_GE(inside, 1000);
}

// 50,000 triangles, many on each pixel, in several states: the last one stays, whoever draws it.
struct Drawn {
  oracle::Picture picture;
  explicit Drawn(int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
    tbb::task_arena arena(threads);
    arena.execute([&] {
      Random random(61);
      Mesh mesh;
      for (std::uint32_t i = 0; i < 50000; ++i) {
        const glm::vec3 middle(random.real_f(-3, 3), random.real_f(-3, 3), random.real_f(-5, -0.05));
        const double spread = random.one_in(50) ? 2.0 : 0.15;
        for (int k = 0; k < 3; ++k) {
          mesh.add(middle + glm::vec3(random.real_f(-spread, spread), random.real_f(-spread, spread),
                                      random.real_f(-spread, spread)));
          mesh.vertex_colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
        }
        mesh.add_triangle(3 * i, 3 * i + 1, 3 * i + 2);
      }
      const int width = 333, height = 257;
      Canvas canvas(width, height, true);
      const glm::mat4 matrix = perspective(0.9, static_cast<double>(width) / height, 0.1, 10);
      PipelineState state;
      state.stencil_test.enabled = true;
      state.stencil_test.fail = StencilOperation::incr_wrap;
      state.stencil_test.function = CompareFunction::notequal;
      state.stencil_test.mask = 7;
      state.stencil_test.depth_pass = StencilOperation::invert;
      state.stencil_test.depth_fail = StencilOperation::decr_wrap;
      state.alpha_test = {true, CompareFunction::greater, 60};
      state.depth_test = {true, CompareFunction::notequal, true};
      state.program = pass_through(Register::primary, Register::primary);
      EXPECT_TRUE(rasterize(state, matrix, mesh.arrays(), {}, canvas.target).ok());
      picture = canvas.picture();
    });
  }
};

TEST(Threads, AnyNumberGivesTheSamePlanes) {
  const Drawn one(1);
  std::size_t drawn = 0;
  for (const std::uint32_t primitive : one.picture.primitive) drawn += primitive < 50000 ? 1 : 0;
  EXPECT_GE(drawn, one.picture.primitive.size() * 3 / 4);
  for (const int threads : {2, 7}) {
    const Drawn many(threads);
    EXPECT_TRUE(many.picture.color == one.picture.color) << threads;
    EXPECT_TRUE(many.picture.depth_z24 == one.picture.depth_z24) << threads;
    EXPECT_TRUE(many.picture.stencil == one.picture.stencil) << threads;
    EXPECT_TRUE(many.picture.primitive == one.picture.primitive) << threads;
    EXPECT_TRUE(many.picture.captured == one.picture.captured) << threads;
  }
}

}  // namespace
}  // namespace ninebit::test

// Programs, output planes, sides and the scissor in whole draws.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

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
  std::array<std::uint8_t, 3> texel{7, 47, 87};
  TextureImage image{1, 1, std::array<Plane<const std::uint8_t>, 4>{}};
  for (std::size_t k = 0; k < 3; ++k) std::get<0>(image.planes)[k] = {&texel[k], 1};
  const Texture map = texture_view(InternalFormat::rgb8, std::vector<TextureImage>(6, image));
  const std::array<TextureUnit, 2> unit0{{{&map, kNearestSampler}, {}}};
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
    const Surface surface = drawn_surface(70, 67, state, mesh.arrays(), unit0);
    for (std::size_t at = 0; at < 70 * 67; ++at) {
      ASSERT_EQ(color_at(surface, at), expected) << name_of(rgb) << ' ' << name_of(alpha);
    }
  }
  // All units off.
  PipelineState state;
  state.program = pass_through(Register::texture0, Register::texture0);
  EXPECT_EQ(color_at(drawn_surface(9, 9, state, mesh.arrays()), 40), (ColorBytes{0, 0, 0, 255}));
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

// A plane at depth pass is written by each fragment that would pass the depth test; the others by those that are drawn,
// whatever the masks say.
TEST(Outputs, AskTheTestsOfTheirTime) {
  constexpr int kSize = 40, kCount = kSize * kSize;
  for (int i = 0; i < 16; ++i) {
    const bool alpha_fails = i % 2 != 0, stencil_fails = i / 2 % 2 != 0, with_program = i / 4 % 2 != 0, masked = i >= 8;
    Surface surface = Surface::make(kSize, kSize, {.with_primitive = true}).value();
    surface.fill({.color = {9, 9, 9, 9}, .depth = 0.5});
    RenderTarget target = surface.target();
    // The left half is nearer than the quad.
    for (int y = 0; y < kSize; ++y) std::fill_n(target.depth.row(y), kSize / 2, 0U);
    std::vector<s9> red(kCount, -7), alpha = red, spare = red, drawn_red = red;
    std::vector<std::uint8_t> green(kCount, 3);
    std::vector<std::uint32_t> depth(kCount, 3), number(kCount, 3);
    const auto plane = [&]<class T>(std::vector<T>& samples) { return OutputSamples(Plane<T>{samples.data(), kSize}); };
    constexpr OutputTime kDepthPass = OutputTime::at_depth_pass;
    using Source = OutputSource;
    for (const OutputPlane& output : std::initializer_list<OutputPlane>{
             {.source = Source::register_code, .reg = Register::primary, .time = kDepthPass, .plane = plane(red)},
             {.source = Source::output_code, .component = kAlpha, .time = kDepthPass, .plane = plane(alpha)},
             {.source = Source::register_code, .component = kAlpha, .time = kDepthPass, .plane = plane(spare)},
             {.source = Source::register_code, .reg = Register::primary, .plane = plane(drawn_red)},
             {.source = Source::output_code, .component = kGreen, .plane = plane(green)},
             {.source = Source::depth, .time = kDepthPass, .plane = plane(depth)},
             {.source = Source::primitive, .time = kDepthPass, .plane = plane(number)},
             {.source = Source::attribute, .plane = Plane<float>{}}}) {
      target.outputs.push_back(output);
    }
    PipelineState state;
    state.depth_test.enabled = true;
    state.alpha_test = {true, alpha_fails ? CompareFunction::never : CompareFunction::always, 0};
    state.stencil_test.enabled = true;
    state.stencil_test.front.function = stencil_fails ? CompareFunction::never : CompareFunction::always;
    if (masked) state.color_mask = {};
    if (with_program) state.program = pass_through(Register::primary, Register::primary);
    const Status status = rasterize(state, kIdentity, quad(-0.5F, {11, 22, 33, 44}).arrays(), {}, target);
    ASSERT_TRUE(status.ok()) << status.error().message;
    for (int at = 0; at < kCount; ++at) {
      const auto n = static_cast<std::size_t>(at);
      const bool passes = at % kSize >= kSize / 2, drawn = passes && !alpha_fails && !stencil_fails;
      ASSERT_EQ(red[n], passes ? 11 : -7);
      ASSERT_EQ(alpha[n], passes ? 44 : -7);
      ASSERT_EQ(spare[n], passes ? 255 : -7);
      ASSERT_EQ(drawn_red[n], drawn ? 11 : -7);
      ASSERT_EQ(green[n], drawn ? 22 : 3);
      ASSERT_EQ(depth[n], passes ? 0x400000U : 3U);
      ASSERT_EQ(number[n] < 2, passes) << number[n];
      ASSERT_EQ(surface.primitive()[n], drawn ? number[n] : 0xFFFFFFFF);
      ASSERT_EQ(surface.color(0)[n], drawn && !masked ? 11 : 9);
    }
  }
}

// Attributes, in perspective: a plane of floats near the exact value, one of halves its rounding.
TEST(Outputs, HoldAttributes) {
  constexpr int kSize = 256, kCount = kSize * kSize;
  const glm::mat4 matrix = perspective(1.0, 1.0, 0.5, 20);
  const std::vector<glm::vec3> positions{{-3, -3, -2}, {9, -3, -8}, {9, 9, -8}, {-3, 9, -2}};
  std::vector<glm::vec4> values;
  for (const glm::vec3& p : positions) values.emplace_back(p, 1000 * p.z);
  VertexArrays arrays{.type = PrimitiveType::quads, .positions = positions};
  arrays.attributes[2] = values;
  std::vector<float> x(kCount), z = x;
  std::vector<Half> half_z(kCount);
  Surface surface = Surface::make(kSize, kSize).value();
  RenderTarget target = surface.target();
  const auto output = [&](int component, OutputSamples samples) {
    target.outputs.push_back(
        {.source = OutputSource::attribute, .attribute = 2, .component = component, .plane = samples});
  };
  output(0, Plane<float>{x.data(), kSize});
  output(3, Plane<float>{z.data(), kSize});
  output(3, Plane<Half>{half_z.data(), kSize});
  const Status status = rasterize({}, matrix, arrays, {}, target);
  ASSERT_TRUE(status.ok()) << status.error().message;
  int drawn = 0;
  for (int at = 0; at < kCount; ++at) {
    const auto n = static_cast<std::size_t>(at);
    if (surface.color(0)[n] == 0) continue;
    ++drawn;
    // The quad lies in the plane z = -x/2 - 7/2, and a pixel looks along (px, py, -1).
    const double px = (at % kSize + 0.5) / (kSize / 2.0) - 1, depth = 3.5 / (1 - px / 2);
    ASSERT_NEAR(x[n], px * depth, 0.02) << at;
    ASSERT_NEAR(z[n], -1000 * depth, 20) << at;
    ASSERT_EQ(half_z[n], half_of(z[n])) << at;
  }
  EXPECT_GE(drawn, kCount / 4);
}

// Nothing leaves the scissor, whatever the time of a plane.
TEST(Scissor, BoundsEveryPlane) {
  constexpr int kWidth = 100, kHeight = 70;
  constexpr int kLargest = std::numeric_limits<int>::max();
  for (const PixelRect& rect :
       {PixelRect{10, 20, 71, 33}, PixelRect{-5, -5, 20, 1000}, PixelRect{60, 60, kLargest, kLargest},
        PixelRect{0, 0, 0, 50}, PixelRect{-kLargest, 0, kLargest, 50}, PixelRect{100, 0, 5, 5}}) {
    for (const bool at_depth_pass : {false, true}) {
      Surface surface = Surface::make(kWidth, kHeight, {.with_primitive = true}).value();
      RenderTarget target = surface.target();
      if (at_depth_pass) target.outputs[0].time = OutputTime::at_depth_pass;
      PipelineState state;
      state.scissor = rect;
      state.depth_test = {true, CompareFunction::always, true};
      state.stencil_test.enabled = true;
      state.stencil_test.front.depth_pass = StencilOperation::invert;
      ASSERT_TRUE(rasterize(state, kIdentity, quad(0, {1, 2, 3, 4}).arrays(), {}, target).ok());
      for (int at = 0; at < kWidth * kHeight; ++at) {
        const auto n = static_cast<std::size_t>(at);
        const std::int64_t x = at % kWidth - std::int64_t{rect.x}, y = at / kWidth - std::int64_t{rect.y};
        const bool in = x >= 0 && y >= 0 && x < rect.width && y < rect.height;
        ASSERT_EQ(color_at(surface, n), in ? (ColorBytes{1, 2, 3, 4}) : ColorBytes{}) << at;
        ASSERT_EQ(surface.depth()[n], in ? 0x800000U : 0xFFFFFFU);
        ASSERT_EQ(surface.stencil()[n], in ? 255 : 0);
        ASSERT_EQ(surface.primitive()[n] < 2, in);
      }
    }
  }
}

// Back-facing polygons take the back side's operations, in any polygon mode; the other facing the front's.
TEST(Stencil, FacingChoosesTheSide) {
  for (const FrontFace front : {FrontFace::counter_clockwise, FrontFace::clockwise}) {
    for (const PolygonMode mode : {PolygonMode::fill, PolygonMode::line, PolygonMode::point}) {
      PipelineState state;
      state.front_face = front;
      state.front_mode = state.back_mode = mode;
      state.stencil_test.enabled = true;
      state.stencil_test.front = {.reference = 1, .depth_pass = StencilOperation::replace};
      state.stencil_test.back = StencilFace{.reference = 2, .depth_pass = StencilOperation::replace};
      Mesh mesh = quad(0, {1, 1, 1, 1});
      for (glm::vec3& position : mesh.positions) position *= 0.5F;
      const Surface surface = drawn_surface(20, 20, state, mesh.arrays());
      const int expected = front == FrontFace::counter_clockwise ? 1 : 2;
      int drawn = 0;
      for (const std::uint8_t value : surface.stencil()) {
        ASSERT_TRUE(value == 0 || value == expected) << int{value};
        drawn += value != 0 ? 1 : 0;
      }
      EXPECT_GE(drawn, 4);
    }
  }
}

// Two lights onto one floor: what the second draw adds, it adds to what the first one left.
TEST(Blending, AddsDrawToDraw) {
  for (const bool with_program : {false, true}) {
    Surface surface = Surface::make(70, 70).value();
    RenderTarget target = surface.target();
    PipelineState state;
    state.depth_test = {true, CompareFunction::lequal, true};
    state.blend = {.enabled = true, .source = BlendFactor::src_alpha, .destination = BlendFactor::one};
    if (with_program) state.program = pass_through(Register::primary, Register::primary);
    ASSERT_TRUE(rasterize(state, kIdentity, quad(0, {100, 200, 10, 128}).arrays(), {}, target).ok());
    ASSERT_TRUE(rasterize(state, kIdentity, quad(0, {100, 255, 0, 255}).arrays(), {}, target).ok());
    // 100 · 128 / 255 = 50.2, 100.4, 5.02; 64.3 for alpha
    for (std::size_t at = 0; at < 70 * 70; ++at) ASSERT_EQ(color_at(surface, at), (ColorBytes{150, 255, 5, 255}));
  }
}

}  // namespace
}  // namespace ninebit::test

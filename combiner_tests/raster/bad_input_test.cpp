// Senseless input is reported or draws nothing; nothing is undefined. Also meant to run under sanitizers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "combiner_tests/raster/support.h"
#include "combiner_tests/support/special_floats.h"

namespace ninebit::test {
namespace {

constexpr float kMax = std::numeric_limits<float>::max();

Status draw(const PipelineState& state, const VertexArrays& arrays, std::span<const TextureUnit> units = {}) {
  Surface surface = Surface::make(8, 8).value();
  RenderTarget target = surface.target();
  const Status status = rasterize(state, kIdentity, arrays, units, target);
  if (!status) {
    EXPECT_FALSE(status.error().message.empty());
    EXPECT_EQ(std::count(surface.color(0).begin(), surface.color(0).end(), 0), 64);  // nothing was drawn
  }
  return status;
}

TEST(BadInput, SizesOutsideTheRangeAreReported) {
  for (const int size :
       {-1, 0, kMaxSurfaceSize + 1, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
    EXPECT_FALSE(Surface::make(size, 8).ok()) << size;
    EXPECT_FALSE(Surface::make(8, size).ok()) << size;
    Surface surface = Surface::make(8, 8).value();
    RenderTarget target = surface.target();
    target.width = size;
    EXPECT_FALSE(rasterize({}, kIdentity, level_triangle(0.0F).arrays(), {}, target).ok()) << size;
    target.width = 8;
    target.height = size;
    EXPECT_FALSE(rasterize({}, kIdentity, level_triangle(0.0F).arrays(), {}, target).ok()) << size;
  }
  EXPECT_TRUE(Surface::make(1, kMaxSurfaceSize).ok());
  EXPECT_TRUE(Surface::make(kMaxSurfaceSize, 1).ok());
}

TEST(BadInput, ArraysThatDoNotFitAreReported) {
  const Mesh good = level_triangle(0.0F);
  ASSERT_TRUE(draw({}, good.arrays()).ok());
  EXPECT_TRUE(draw({}, VertexArrays{}).ok());  // nothing to draw

  for (const std::uint32_t index : {3U, 4U, 0x7FFFFFFFU, 0xFFFFFFFFU}) {
    for (int k = 0; k < 3; ++k) {
      Mesh mesh = good;
      mesh.triangles[0][k] = index;
      EXPECT_FALSE(draw({}, mesh.arrays()).ok()) << index;
    }
  }
  Mesh none = good;
  none.positions.clear();
  EXPECT_FALSE(draw({}, none.arrays()).ok());
  for (const std::size_t count : {1U, 2U, 4U}) {
    Mesh mesh = good;
    mesh.vertex_colors.resize(count);
    EXPECT_FALSE(draw({}, mesh.arrays()).ok()) << count;
    mesh = good;
    mesh.triangle_colors.resize(count + 1);
    EXPECT_FALSE(draw({}, mesh.arrays()).ok()) << count;
    const std::vector<float> fog(count);
    const std::vector<ColorBytes> secondary(count);
    const std::vector<glm::vec4> attribute(count);
    VertexArrays arrays = good.arrays();
    arrays.fog_factors = fog;
    EXPECT_FALSE(draw({}, arrays).ok()) << count;
    arrays = good.arrays();
    arrays.secondary_colors = secondary;
    EXPECT_FALSE(draw({}, arrays).ok()) << count;
    arrays = good.arrays();
    arrays.attributes[3] = attribute;
    EXPECT_FALSE(draw({}, arrays).ok()) << count;
  }
  Mesh both = good;
  both.vertex_colors.resize(3);
  both.triangle_colors.resize(1);
  EXPECT_FALSE(draw({}, both.arrays()).ok());
}

TEST(BadInput, NumbersOutOfTheirRangesAreReported) {
  const Mesh mesh = level_triangle(0.0F);
  const auto fails = [&](auto change) {
    PipelineState state;
    change(state);
    return !draw(state, mesh.arrays()).ok();
  };
  for (const float size : {-1.0F, -0.125F, 0.0625F, 1.1F, 64.125F, 1e30F, -1e30F, kNan, kInfinity, -kInfinity}) {
    EXPECT_TRUE(fails([&](PipelineState& s) { s.point_size = size; })) << size;
    EXPECT_TRUE(fails([&](PipelineState& s) { s.line_width = size; })) << size;
  }
  EXPECT_TRUE(fails([](PipelineState& s) { s.line_width = 0; }));
  EXPECT_FALSE(fails([](PipelineState& s) { s.point_size = 0; }));
  EXPECT_FALSE(fails([](PipelineState& s) { s.point_size = s.line_width = 0.125F; }));
  EXPECT_FALSE(fails([](PipelineState& s) { s.point_size = s.line_width = 64; }));
  for (const float odd : {kNan, kInfinity, -kInfinity}) {
    EXPECT_TRUE(fails([&](PipelineState& s) { s.polygon_offset.factor = odd; })) << odd;
    EXPECT_TRUE(fails([&](PipelineState& s) { s.polygon_offset.units = odd; })) << odd;
    const bool is_number = !std::isnan(odd);  // infinity is clamped
    EXPECT_EQ(fails([&](PipelineState& s) { s.depth_near = odd; }), !is_number) << odd;
    EXPECT_EQ(fails([&](PipelineState& s) { s.depth_far = odd; }), !is_number) << odd;
  }
  constexpr int kLargest = std::numeric_limits<int>::max(), kLowest = std::numeric_limits<int>::min();
  for (const PixelRect& r : {PixelRect{-1, 0, 4, 4}, PixelRect{0, -1, 4, 4}, PixelRect{5, 0, 4, 4},
                             PixelRect{0, 5, 4, 4}, PixelRect{0, 0, -1, 4}, PixelRect{0, 0, 4, -1},
                             PixelRect{kLargest, 0, kLargest, 4}, PixelRect{kLowest, kLowest, kLargest, kLargest}}) {
    EXPECT_TRUE(fails([&](PipelineState& s) { s.viewport = r; })) << r.x << ' ' << r.y << ' ' << r.width;
  }
  EXPECT_FALSE(fails([](PipelineState& s) { s.viewport = PixelRect{8, 8, 0, 0}; }));
  EXPECT_FALSE(fails([](PipelineState& s) { s.viewport = PixelRect{0, 0, 8, 8}; }));
  // A scissor may lie anywhere.
  EXPECT_FALSE(fails([](PipelineState& s) { s.scissor = PixelRect{kLowest, kLowest, kLargest, kLargest}; }));
  EXPECT_FALSE(fails([](PipelineState& s) { s.scissor = PixelRect{kLargest, kLargest, kLargest, kLargest}; }));
  EXPECT_TRUE(fails([](PipelineState& s) { s.scissor = PixelRect{0, 0, -1, 8}; }));
}

TEST(BadInput, TexturesThatDoNotFitAreReported) {
  const std::vector<std::uint8_t> sample{77};
  const std::array<Plane<const std::uint8_t>, 4> planes{{{sample.data(), 1}, {sample.data(), 1}, {sample.data(), 1}}};
  const std::vector<TextureImage> faces(6, TextureImage{1, 1, planes});
  const Texture map = texture_view(InternalFormat::rgb8, faces);
  std::array<TextureUnit, 5> units{};
  units[0] = {&map, kNearestSampler};
  const std::span<const TextureUnit> all(units);
  Mesh mesh = level_triangle(0.0F);
  PipelineState state;
  state.program = pass_through(Register::texture0, Register::texture0);
  EXPECT_FALSE(draw(state, mesh.arrays(), all.first(1)).ok());  // no texture coordinates
  mesh.texture_coordinates.resize(2);
  EXPECT_FALSE(draw(state, mesh.arrays(), all.first(1)).ok());
  mesh.texture_coordinates.resize(3);
  EXPECT_TRUE(draw(state, mesh.arrays(), all.first(1)).ok());
  EXPECT_TRUE(draw(state, mesh.arrays(), all.first(2)).ok());
  EXPECT_FALSE(draw(state, mesh.arrays(), all.first(3)).ok());  // geforce2 has two units
  state.profile = profiles::nv2a;
  EXPECT_FALSE(draw(state, mesh.arrays(), all.first(1)).ok());  // a program compiled for another datapath
  state.program = pass_through(Register::texture0, Register::texture0, profiles::nv2a);
  EXPECT_TRUE(draw(state, mesh.arrays(), all.first(4)).ok());
  EXPECT_FALSE(draw(state, mesh.arrays(), all).ok());
  state.profile.texture_units.value = 9;
  EXPECT_FALSE(draw(state, mesh.arrays(), all).ok());

  Texture broken = map;
  const std::array<TextureUnit, 1> one{TextureUnit{&broken, kNearestSampler}};
  for (const int size : {0, -1}) {
    broken.faces[0][0].width = broken.faces[0][0].height = size;
    EXPECT_FALSE(draw(state, mesh.arrays(), one).ok());
  }
  // An incomplete texture counts as off: nothing is asked of its coordinates.
  broken = map;
  broken.faces[4].clear();
  mesh.texture_coordinates.clear();
  EXPECT_TRUE(draw(state, mesh.arrays(), one).ok());

  // Texture coordinates that are no direction fetch some texel.
  for (const float odd : {kNan, kInfinity, -kInfinity, 0.0F, kMax}) {
    mesh.texture_coordinates.assign(3, glm::vec3(odd, odd, odd));
    EXPECT_TRUE(draw(state, mesh.arrays(), all.first(1)).ok());
  }
}

TEST(BadInput, MissingPlanesAreReportedOrLeftOut) {
  const Mesh mesh = level_triangle(0.0F);
  RenderTarget empty;
  empty.width = empty.height = 8;
  EXPECT_TRUE(rasterize({}, kIdentity, mesh.arrays(), {}, empty).ok());
  PipelineState depth, stencil;
  depth.depth_test.enabled = true;
  stencil.stencil_test.enabled = true;
  EXPECT_FALSE(rasterize(depth, kIdentity, mesh.arrays(), {}, empty).ok());
  EXPECT_FALSE(rasterize(stencil, kIdentity, mesh.arrays(), {}, empty).ok());
  // (What may be wrong with output planes, see outputs_test.cpp.)
  PipelineState bits;
  for (const int subpixel_bits : {-1, 5}) {
    bits.profile.subpixel_bits.value = subpixel_bits;
    EXPECT_FALSE(draw(bits, mesh.arrays()).ok());
  }
}

TEST(BadInput, PositionsThatAreNotFiniteDrawNothing) {
  for (const float odd : {kNan, kInfinity, -kInfinity}) {
    for (int vertex = 0; vertex < 3; ++vertex) {
      for (int axis = 0; axis < 3; ++axis) {
        Mesh mesh = level_triangle(0.0F);
        mesh.positions[static_cast<std::size_t>(vertex)][axis] = odd;
        const auto count = coverage(mesh, kIdentity, 8, 8);
        EXPECT_EQ(std::count(count.begin(), count.end(), 0), 64) << odd << ' ' << vertex << ' ' << axis;
      }
    }
    glm::mat4 matrix(odd);
    const auto count = coverage(level_triangle(0.0F), matrix, 8, 8);
    EXPECT_EQ(std::count(count.begin(), count.end(), 0), 64);
  }
  // Finite in the object, infinite in one clip coordinate alone.
  for (int axis = 0; axis < 3; ++axis) {
    Mesh mesh = level_triangle(0.0F);
    mesh.positions[1][axis] = kMax;
    glm::mat4 matrix(1.0F);
    matrix[axis][axis] = 4.0F;
    const auto count = coverage(mesh, matrix, 8, 8);
    EXPECT_EQ(std::count(count.begin(), count.end(), 0), 64) << axis;
  }
}

TEST(BadInput, NothingBehindTheEyeAndNothingWithoutAreaIsDrawn) {
  glm::mat4 behind(1.0F);
  for (const float w : {0.0F, -0.0F, -1.0F, -1e-30F, -kMax}) {
    behind[3][3] = w;
    const auto count = coverage(level_triangle(0.0F), behind, 8, 8);
    EXPECT_EQ(std::count(count.begin(), count.end(), 0), 64) << w;
  }
  Random random(71);
  for (int i = 0; i < 500; ++i) {
    Mesh mesh;
    const auto place = [&] { return oracle::WindowVertex{random.between(-100, 228), random.between(-100, 228), 5}; };
    const oracle::WindowVertex a = place(), b = place();
    mesh.add(clip_position(a, 8, 8));
    mesh.add(clip_position(b, 8, 8));
    mesh.add(clip_position({2 * b.x_q4 - a.x_q4, 2 * b.y_q4 - a.y_q4, 5}, 8, 8));  // on the line
    mesh.add_triangle(0, 1, 2);
    mesh.add_triangle(0, 1, 1);
    mesh.add_triangle(0, 0, 0);
    const auto count = coverage(mesh, kIdentity, 8, 8);
    ASSERT_EQ(std::count(count.begin(), count.end(), 0), 64);
  }
}

// Anything that a float can be, in vertices and matrix, through every path: it must end and stay within the planes.
TEST(BadInput, AnyFloatsAtAllAreSafe) {
  Random random(72);
  const auto odd = [&] {
    switch (random.below(6)) {
      case 0:
        return random.pick({0.0F, -0.0F, 1.0F, -1.0F, kMax, -kMax, 1e-38F, 1e-45F, 16384.0F, -8192.0F});
      case 1:
        return static_cast<float>(std::exp2(random.real(-149, 127))) * (random.one_in(2) ? 1.0F : -1.0F);
      case 2:
        return static_cast<float>(std::exp2(random.real(90, 127))) * (random.one_in(2) ? 1.0F : -1.0F);
      default:
        return random.real_f(-2, 2);
    }
  };
  std::int64_t drawn = 0;
  for (int i = 0; i < (kSlowBuild ? 4000 : 40000); ++i) {
    Mesh mesh;
    for (int k = 0; k < 6; ++k) {
      mesh.add({odd(), odd(), odd()});
      mesh.vertex_colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
    }
    for (std::uint32_t k = 0; k < 4; ++k) mesh.add_triangle(k, k + 1, k + 2);
    glm::mat4 matrix(1.0F);
    if (random.one_in(2)) {
      for (int column = 0; column < 4; ++column) {
        for (int row = 0; row < 4; ++row) matrix[column][row] = odd();
      }
    } else if (random.one_in(2)) {
      matrix = perspective(0.5, 1.0, random.pick({1e-30, 1e-6, 0.1}), 1e6);
    }
    PipelineState state;
    state.front_mode = static_cast<PolygonMode>(random.below(3));
    state.back_mode = static_cast<PolygonMode>(random.below(3));
    state.line_width = random.pick({0.125F, 1.0F, 2.0F, 64.0F});
    state.point_size = random.pick({0.0F, 1.0F, 2.0F, 64.0F});
    if (random.one_in(2)) state.profile.line_shape.value = LineShape::diamonds;
    if (random.one_in(2)) state.profile.point_shape.value = PointShape::whole_pixels;
    state.polygon_offset = {true, true, true, random.pick({0.0F, 1.0F, -kMax, kMax}), random.pick({0.0F, kMax, -3.0F})};
    state.profile.color_interpolation.value =
        random.one_in(2) ? ColorInterpolation::affine : ColorInterpolation::perspective;
    VertexArrays arrays = mesh.arrays();
    if (random.one_in(2)) arrays.type = static_cast<PrimitiveType>(random.below(10));
    Canvas canvas(random.pick({1, 5, 70}), random.pick({1, 5, 70}), random.one_in(2));
    ASSERT_TRUE(rasterize(state, matrix, arrays, {}, canvas.target).ok());
    ASSERT_TRUE(canvas.padding_is_whole());
    const oracle::Picture picture = canvas.picture();
    drawn += std::count_if(picture.primitive.begin(), picture.primitive.end(), [](std::uint32_t p) { return p < 12; });
  }
  EXPECT_GE(drawn, 10000);
}

}  // namespace
}  // namespace ninebit::test

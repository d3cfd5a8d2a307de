// What is senseless is reported or draws nothing; nothing is undefined. Also meant to run under sanitizers.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "combiner_tests/raster/support.h"

namespace ninebit::test {
namespace {

constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kMax = std::numeric_limits<float>::max();

Mesh covering_triangle() {
  Mesh mesh;
  for (const glm::vec2 p : {glm::vec2(-3, -3), glm::vec2(5, -3), glm::vec2(-3, 5)}) mesh.add({p, 0.0F});
  mesh.add_triangle(0, 1, 2);
  return mesh;
}

Status draw(const PipelineState& state, const TriangleArrays& arrays, std::span<const CubeMap* const> textures = {}) {
  Surface surface = Surface::make(8, 8).value();
  RenderTarget target = surface.target();
  const Status status = rasterize(state, kIdentity, arrays, textures, target);
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
    EXPECT_FALSE(rasterize({}, kIdentity, covering_triangle().arrays(), {}, target).ok()) << size;
    target.width = 8;
    target.height = size;
    EXPECT_FALSE(rasterize({}, kIdentity, covering_triangle().arrays(), {}, target).ok()) << size;
  }
  EXPECT_TRUE(Surface::make(1, kMaxSurfaceSize).ok());
  EXPECT_TRUE(Surface::make(kMaxSurfaceSize, 1).ok());
}

TEST(BadInput, ArraysThatDoNotFitAreReported) {
  const Mesh good = covering_triangle();
  ASSERT_TRUE(draw({}, good.arrays()).ok());
  EXPECT_TRUE(draw({}, TriangleArrays{}).ok());  // nothing to draw

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
  }
  Mesh both = good;
  both.vertex_colors.resize(3);
  both.triangle_colors.resize(1);
  EXPECT_FALSE(draw({}, both.arrays()).ok());
}

TEST(BadInput, TexturesThatDoNotFitAreReported) {
  const std::vector<std::uint8_t> sample{77};
  CubeMap map;
  map.size = 1;
  for (auto& face : map.faces) face.fill({sample.data(), 1});
  const std::array<const CubeMap*, 5> units{&map, nullptr, nullptr, nullptr, nullptr};
  const std::span<const CubeMap* const> all(units);
  Mesh mesh = covering_triangle();
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

  CubeMap broken = map;
  const std::array<const CubeMap*, 1> one{&broken};
  for (const int size : {0, -1}) {
    broken.size = size;
    EXPECT_FALSE(draw(state, mesh.arrays(), one).ok());
  }
  broken = map;
  broken.faces[4][2] = {};
  EXPECT_FALSE(draw(state, mesh.arrays(), one).ok());

  // Texture coordinates that are no direction fetch some texel.
  for (const float odd : {kNan, kInfinity, -kInfinity, 0.0F, kMax}) {
    mesh.texture_coordinates.assign(3, glm::vec3(odd, odd, odd));
    EXPECT_TRUE(draw(state, mesh.arrays(), all.first(1)).ok());
  }
}

TEST(BadInput, MissingPlanesAreReportedOrLeftOut) {
  const Mesh mesh = covering_triangle();
  RenderTarget empty;
  empty.width = empty.height = 8;
  EXPECT_TRUE(rasterize({}, kIdentity, mesh.arrays(), {}, empty).ok());
  PipelineState depth, stencil;
  depth.depth_test.enabled = true;
  stencil.stencil_test.enabled = true;
  EXPECT_FALSE(rasterize(depth, kIdentity, mesh.arrays(), {}, empty).ok());
  EXPECT_FALSE(rasterize(stencil, kIdentity, mesh.arrays(), {}, empty).ok());
  std::vector<s9> plane(64);
  for (const Register reg :
       {Register::zero, Register::constant0, Register::e_times_f, Register::spare0_plus_secondary}) {
    empty.captures = {{reg, kRed, {plane.data(), 8}}};
    EXPECT_FALSE(rasterize({}, kIdentity, mesh.arrays(), {}, empty).ok());
  }
  for (const int component : {-1, 4}) {
    empty.captures = {{Register::primary, component, {plane.data(), 8}}};
    EXPECT_FALSE(rasterize({}, kIdentity, mesh.arrays(), {}, empty).ok());
  }
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
        Mesh mesh = covering_triangle();
        mesh.positions[static_cast<std::size_t>(vertex)][axis] = odd;
        const auto count = coverage(mesh, kIdentity, 8, 8);
        EXPECT_EQ(std::count(count.begin(), count.end(), 0), 64) << odd << ' ' << vertex << ' ' << axis;
      }
    }
    glm::mat4 matrix(odd);
    const auto count = coverage(covering_triangle(), matrix, 8, 8);
    EXPECT_EQ(std::count(count.begin(), count.end(), 0), 64);
  }
  // Finite in the object, infinite in one clip coordinate alone.
  for (int axis = 0; axis < 3; ++axis) {
    Mesh mesh = covering_triangle();
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
    const auto count = coverage(covering_triangle(), behind, 8, 8);
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
    Canvas canvas(random.pick({1, 5, 70}), random.pick({1, 5, 70}), random.one_in(2));
    ASSERT_TRUE(rasterize({}, matrix, mesh.arrays(), {}, canvas.target).ok());
    ASSERT_TRUE(canvas.padding_is_whole());
    const oracle::Picture picture = canvas.picture();
    drawn += std::count_if(picture.primitive.begin(), picture.primitive.end(), [](std::uint32_t p) { return p < 4; });
  }
  EXPECT_GE(drawn, 10000);
}

}  // namespace
}  // namespace ninebit::test

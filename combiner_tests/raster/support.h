// What the rasterizer tests share: clip coordinates that snap to a wanted position, planes with
// padding.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "combiner_tests/oracle/raster_oracle.h"
#include "combiner_tests/support/random.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/program.h"
#include "ninebit/raster/rasterizer.h"

namespace ninebit::test {

// A position with w = 1 that the identity matrix puts into the middle of the snapping cell of this window position
// (multiples of 2^(4 - subpixel_bits) sixteenths) and exactly onto this depth, with the whole depth range.
glm::vec3 clip_position(const oracle::WindowVertex& v, const PixelRect& viewport, int subpixel_bits = 4,
                        DepthStencilFormat format = DepthStencilFormat::d24s8);
glm::vec3 clip_position(const oracle::WindowVertex& v, int width, int height, int subpixel_bits = 4);

inline const glm::mat4 kIdentity{1.0F};

// How a canvas's samples lie: planes without gaps; colours in words of RGBA; gaps between all samples of a plane.
enum class SampleLayout { planes, words, gaps };
inline constexpr std::initializer_list<SampleLayout> kSampleLayouts{SampleLayout::planes, SampleLayout::words,
                                                                    SampleLayout::gaps};

// Owned planes with a few samples of padding after each row, which no draw may touch; an output plane of primitive
// numbers and, if wanted, one of the output's red at depth pass.
class Canvas {
 public:
  explicit Canvas(int width, int height, bool with_capture = false, SampleLayout layout = SampleLayout::planes);
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  RenderTarget target;
  oracle::Picture picture() const;
  void load(const oracle::Picture& picture);
  bool padding_is_whole() const;

 private:
  RenderTarget whole_;  // the target as it was made
  Plane<std::uint32_t> primitive_plane_;
  Plane<s9> captured_plane_;
  std::array<std::vector<std::uint8_t>, 4> color_;  // of words all in the first
  std::vector<std::uint32_t> depth_, primitive_;
  std::vector<std::uint8_t> stencil_;
  std::vector<s9> captured_;
};

// Vertices and triangles that grow.
struct Mesh {
  std::vector<glm::vec3> positions;
  std::vector<glm::uvec3> triangles;
  std::vector<ColorBytes> vertex_colors, triangle_colors;
  std::vector<glm::vec3> texture_coordinates;

  std::uint32_t add(const glm::vec3& position);
  void add_triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c) { triangles.emplace_back(a, b, c); }
  // Texture coordinates go to unit 0.
  VertexArrays arrays() const;
};

// One triangle over the whole target and more, at one depth.
Mesh level_triangle(float z);

// Stencil INCR for every fragment, no colour.
PipelineState counting_state();

// A triangle over the whole target, whose depth is its middle, and a quad.
inline const std::array<glm::vec3, 3> kWholeTarget{glm::vec3(-1, -1, 0), glm::vec3(3, -1, 0), glm::vec3(-1, 3, 0)};
inline const std::array<glm::vec3, 4> kWholeQuad{glm::vec3(-1, -1, 0), glm::vec3(1, -1, 0), glm::vec3(1, 1, 0),
                                                 glm::vec3(-1, 1, 0)};

// A new surface with what a draw leaves on it.
Surface drawn_surface(int width, int height, const PipelineState& state, const VertexArrays& arrays,
                      std::span<const TextureUnit> units = {}, const SurfaceFormat& format = {},
                      const glm::mat4& matrix = kIdentity);

// Draws the mesh with counting_state() onto a cleared surface and returns the stencil: how often each pixel was drawn.
PlaneSamples<std::uint8_t> coverage(const Mesh& mesh, const glm::mat4& matrix, int width, int height,
                                    CullFace cull = CullFace::none);

// The least and the largest value that a function takes within the reach of snapping around a pixel's centre.
template <class Function>
std::pair<double, double> range_around(int x, int y, Function value) {
  double low = 1e30, high = -1e30;
  for (const double dx : {-0.2, 0.0, 0.2}) {
    for (const double dy : {-0.2, 0.0, 0.2}) {
      const double v = value(x + 0.5 + dx, y + 0.5 + dy);
      low = std::min(low, v);
      high = std::max(high, v);
    }
  }
  return {low, high};
}

// Weights of a triangle's corners where the ray through a window position meets its plane, seen by a camera at the
// origin that looks along -z.
glm::dvec3 weights_at(std::span<const glm::vec3> corners, double x, double y, int width, int height, double tangent);

// A program of one silent stage whose output is register `rgb` with the alpha of `alpha`.
Program pass_through(Register rgb, Register alpha, const HardwareProfile& profile = profiles::geforce2);

// The matrix of a camera at the origin that looks along -z.
glm::mat4 perspective(double half_angle_tangent, double aspect, double near_plane, double far_plane);

}  // namespace ninebit::test

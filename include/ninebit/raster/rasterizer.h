// Drawing primitives: vertices in, fragments through the combiners and the fragment operations, planes out.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/fragment_probe.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/raster/surface.h"
#include "ninebit/raster/texture.h"

namespace NINEBIT_PUBLIC ninebit {

using ColorBytes = std::array<std::uint8_t, 4>;  // red, green, blue, alpha

// The most texture units and attributes that a draw may have.
inline constexpr int kMaxTextureUnits = 4;
inline constexpr int kMaxAttributes = 4;

// glBegin's modes.
enum class PrimitiveType : std::uint8_t {
  points,
  lines,
  line_strip,
  line_loop,
  triangles,
  triangle_strip,
  triangle_fan,
  quads,
  quad_strip,
  polygon  // one convex polygon
};

// The vertices of one draw call. The spans must outlive it.
struct VertexArrays {
  PrimitiveType type = PrimitiveType::triangles;  // what the vertices make
  std::span<const glm::vec3> positions{};         // (x, y, z); w is 1
  // Instead of `positions`: (x, y, z, w) of any w. With w = 0, (x, y, z) is a direction, and the vertex lies at
  // infinity.
  std::span<const glm::vec4> homogeneous_positions{};
  // Vertex numbers in drawing order; empty: all vertices in order. As in GL, vertices left over at the end are not
  // drawn.
  std::span<const std::uint32_t> indices{};

  // Primary colours: one a vertex, or one a primitive (a point, line, triangle, quad or polygon); both empty: opaque
  // white. Vertex colours in floats become bytes by byte_of_vertex_color (rule 17).
  std::span<const ColorBytes> vertex_colors{};
  std::span<const ColorBytes> primitive_colors{};
  std::span<const ColorBytes> secondary_colors{};  // one a vertex; empty: black
  std::span<const float> fog_factors{};            // one a vertex, clamped to [0, 1]; empty: 1

  // Texture coordinates (s, t, r) a vertex, for each unit with a texture, and q: empty, it is 1. All four are
  // interpolated in perspective; 2D textures are read at (s/q, t/q), a depth comparison takes r/q, cube maps
  // ignore q.
  std::array<std::span<const glm::vec3>, kMaxTextureUnits> texture_coordinates{};
  std::array<std::span<const float>, kMaxTextureUnits> texture_q{};
  // Four floats a vertex, interpolated in perspective, for output planes.
  std::array<std::span<const glm::vec4>, kMaxAttributes> attributes{};

  // The number of vertices, from whichever positions are given.
  [[nodiscard]] std::size_t vertex_count() const {
    return positions.empty() ? homogeneous_positions.size() : positions.size();
  }
};

// The vertex numbers of indexed triangles as one list. (Without triangles the list is empty, which stands for all
// vertices.)
[[nodiscard]] inline std::span<const std::uint32_t> index_list(std::span<const glm::uvec3> triangles) {
  return triangles.empty() ? std::span<const std::uint32_t>{}
                           : std::span<const std::uint32_t>(&triangles[0].x, 3 * triangles.size());
}

// A texture unit: what it samples, and how.
struct TextureUnit {
  const Texture* texture = nullptr;  // nullptr: the unit is off
  Sampler sampler;                   // how it is read
};

// Draws the primitives in their order. (Passes over the same geometry from the same view: prepared_draw.h.)
//
// - Clip coordinates are clip_from_object * (position, 1), computed in floats in a fixed order, with w in place of 1
//   for homogeneous positions, so (x, y, z, 1) and (x, y, z) give the same result. Primitives are clipped against the
//   near and far planes, both inclusive, and against a guard band that keeps window positions within 8,192 pixels of
//   the viewport's centre; the viewport's own sides cut pixels, not primitives. Primitives with a position that is not
//   finite, points outside the view volume, and polygons without area after snapping, draw nothing.
// - Window positions are truncated toward zero to 1/16 pixel (profile.subpixel_bits). A polygon draws the pixels whose
//   centres lie inside it, or on a top or left edge (top: in the picture, y up). A line draws the pixels whose diamonds
//   it leaves (OpenGL 1.3, 3.4.1), a wide one w pixels for each of those that a line (w - 1) / 2 pixels lower, or more
//   to the left, draws; a point of size n draws n × n pixels around it (3.3).
// - Quads and polygons are a fan of triangles around their first vertex. A polygon's facing is the sign of the sum of
//   their areas; it decides the polygon mode, and culling where that is line or point. Filled, each triangle has its
//   own facing: a closed mesh then draws as many front as back faces at a pixel, regardless of snapping. In the modes
//   line and point the boundary is drawn, with the edges that clipping added (2.11).
// - Window depth is held in 24 bits: the depth codes of the target's format, with as many fraction bits as are left.
//   Each vertex depth is rounded to them; a fragment's is the exact plane (or line) through them at the pixel's centre,
//   rounded to nearest, halves up; then the polygon offset is added, itself rounded so once a polygon, m being that of
//   its largest triangle; the sum is clamped and its fraction bits are rounded away, halves up. All in integers, so
//   that equal geometry gives equal depth in every pass.
// - Along a line everything is taken at the foot of the perpendicular from the pixel's centre, or at the end that it
//   lies beyond; a wide line's pixels side by side share it.
// - Texture coordinates, attributes, fog factors and smooth colours are interpolated in floats, in a fixed order for
//   each fragment; in perspective, colours as profile.color_interpolation says.
// - Each fragment then goes through scissor, program, alpha test, stencil test, depth test, blending and masks, in GL's
//   order; where primitives overlap, earlier ones are drawn first, for any number of threads.
//
// Reports positions of both kinds, arrays of unequal lengths, indices out of range, a target without the planes that
// the state needs, numbers outside the ranges that pipeline_state.h gives. A unit with an incomplete texture counts
// as off, as in GL.
[[nodiscard]] Status rasterize(const PipelineState& state, const glm::mat4& clip_from_object,
                               const VertexArrays& arrays, std::span<const TextureUnit> units, RenderTarget& target);

// Which planes clear() fills.
struct ClearBuffers {
  bool color = true;    // GL_COLOR_BUFFER_BIT
  bool depth = true;    // GL_DEPTH_BUFFER_BIT
  bool stencil = true;  // GL_STENCIL_BUFFER_BIT
};

// GL's clear: writes the values into the named planes of the target, through the colour mask, the depth test's `write`
// (whether or not the test is enabled), the front stencil write mask and the scissor. Other output planes stay.
// Reports the same errors about the target as rasterize().
[[nodiscard]] Status clear(const PipelineState& state, ClearBuffers buffers, const ClearValues& values,
                           RenderTarget& target);

}  // namespace ninebit

// Draws primitives: vertices to fragments, through the combiners and the fragment operations, into planes.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

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

static_assert(kMaxTextureUnits == kTextureStages);

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
  PrimitiveType type = PrimitiveType::triangles;  // how vertices form primitives
  std::span<const glm::vec3> positions{};         // (x, y, z) with w = 1
  // Instead of `positions`: (x, y, z, w) with any w. With w = 0, (x, y, z) is a direction: the vertex lies at infinity.
  std::span<const glm::vec4> homogeneous_positions{};
  // The vertices to draw, in order; empty: all vertices. An incomplete primitive at the end is not drawn, as in GL.
  std::span<const std::uint32_t> indices{};

  // Primary colours: one per vertex, or one per primitive (a point, line, triangle, quad or polygon); both empty:
  // opaque white. byte_of_vertex_color converts float vertex colours to bytes (rule 17).
  std::span<const ColorBytes> vertex_colors{};
  std::span<const ColorBytes> primitive_colors{};
  std::span<const ColorBytes> secondary_colors{};  // one per vertex; empty: black
  std::span<const float> fog_factors{};            // one per vertex, clamped to [0, 1]; empty: 1

  // Texture coordinates (s, t, r) per vertex, for each unit with a texture or of which a texture-shader stage reads
  // them, and q (empty: 1). All four are interpolated in perspective. 2D textures are read at (s/q, t/q), a depth
  // comparison uses r/q; cube maps ignore q.
  std::array<std::span<const glm::vec3>, kMaxTextureUnits> texture_coordinates{};
  std::array<std::span<const float>, kMaxTextureUnits> texture_q{};
  // Four floats per vertex, interpolated in perspective, for output planes.
  std::array<std::span<const glm::vec4>, kMaxAttributes> attributes{};

  // The number of positions of the kind that is used.
  [[nodiscard]] std::size_t vertex_count() const {
    return positions.empty() ? homogeneous_positions.size() : positions.size();
  }
};

// The vertex numbers of indexed triangles as one list. Without triangles it is empty, which stands for all vertices.
[[nodiscard]] inline std::span<const std::uint32_t> index_list(std::span<const glm::uvec3> triangles) {
  return triangles.empty() ? std::span<const std::uint32_t>{}
                           : std::span<const std::uint32_t>(&triangles[0].x, 3 * triangles.size());
}

// A texture unit: a texture and its sampler.
struct TextureUnit {
  const Texture* texture = nullptr;  // nullptr: the unit is off
  Sampler sampler;                   // how it is read
};

// Draws the primitives in order. For several passes over the same geometry and view, see prepared_draw.h.
//
// - Clip coordinates are clip_from_object * (position, 1), computed in floats in a fixed order; a homogeneous
//   position's own w replaces the 1. Primitives are clipped against the near and far planes, which are inside, and
//   against a guard band that keeps window positions within 8,192 pixels of the viewport's centre. The viewport's sides
//   reject pixels, not primitives. Nothing is drawn for primitives with a position that is not finite, points outside
//   the view volume, and polygons without area after snapping.
// - Window positions are truncated toward zero to 1/16 pixel (profile.subpixel_bits). A polygon draws the pixels whose
//   centres lie inside it, or on a top or left edge (top: in the picture, y up).
// - A line draws the pixels whose centres lie in the rectangle around it (profile.line_shape; rule 30): its ends are
//   square, and its width is multiplied by (max(|dx|, |dy|) + min(|dx|, |dy|) / 2) / its length. A point draws those
//   whose centres lie in the square around it (profile.point_shape; rule 31). Lines without length draw nothing.
// - With OpenGL's shapes, a line draws the pixels whose diamonds it leaves (OpenGL 1.3, 3.4.1). A line of width w is
//   moved down, or to the left, by (w - 1) / 2 pixels, and draws w pixels for each of its pixels. A point of size n
//   draws n × n pixels around it (3.3).
// - Quads and polygons are a fan of triangles around their first vertex; a quad strip is cut into the triangles of the
//   triangle strip (rule 32). A polygon's facing is the sign of the sum of their areas. It selects the polygon mode
//   and, in the modes line and point, decides culling. In the mode fill each triangle has its own facing, so that as
//   many front as back faces of a closed mesh cover a pixel, even after snapping. The modes line and point draw the
//   boundary, including edges that clipping added (2.11).
// - Window depth has 24 bits: the depth code of the target's format, and fraction bits for the rest. All of it is
//   computed in integers, so that equal geometry has equal depth in every pass:
//     1. Each vertex depth is rounded to 24 bits.
//     2. A fragment's depth is the exact plane (or line) through them at the pixel's centre, cut, or rounded to
//        nearest, halves up, as profile.depth_narrowing says.
//     3. The polygon offset is added. It is rounded to nearest, halves up, once per polygon; m is that of its largest
//        triangle.
//     4. The sum is clamped, and its fraction bits are cut or rounded away as in step 2.
// - A line's values are evaluated at the foot of the perpendicular from the pixel's centre, clamped to the line's ends.
//   Pixels side by side of a wide line of diamonds share them.
// - Texture coordinates, attributes, fog factors and smooth colours are interpolated in floats, in a fixed order per
//   fragment: in perspective, but colours as profile.color_interpolation says.
// - Each fragment then passes through scissor, texture-shader stages, program, alpha test, stencil test, depth test,
//   blending and masks, in GL's order. Overlapping primitives are drawn in their order, for any number of threads.
// - A fragment that a stage culls is dropped before the alpha test. A replaced depth takes the place of steps 1 to 4
//   (rule 39: cut to a code, clamped to the buffer's codes). Levels of detail of stages are found with the earlier
//   texel held fixed over the pixel and its neighbours; at points a stage that reads its texture at s, t, r over q has
//   rho 1, as a plain unit, and the others 0.
//
// Reports positions of both kinds, arrays of unequal lengths, indices out of range, a target that misses planes which
// the state needs, values out of the ranges of pipeline_state.h, faults of texture-shader stages (validate_stages.h)
// and coordinates that they read and the vertices do not have. A unit with an incomplete texture is off, as in GL; an
// inconsistent stage gives (0, 0, 0, 0), see check_draw.
[[nodiscard]] Status rasterize(const PipelineState& state, const glm::mat4& clip_from_object,
                               const VertexArrays& arrays, std::span<const TextureUnit> units, RenderTarget& target);

// One sentence for each inconsistent texture-shader stage of such a draw, in their order (TextureShaderProgram).
// Reports what rasterize() reports of the stages and the textures. Stages that are not enabled have no warnings.
[[nodiscard]] Result<std::vector<std::string>> texture_shader_warnings(const PipelineState& state,
                                                                       std::span<const TextureUnit> units);

// Settings that GL accepts and whose effect is easily overlooked, one sentence each: units that are off because their
// texture is incomplete, and why; units that the program reads and that have no texture, unless stages are enabled;
// then the texture_shader_warnings(). Reports what these report.
[[nodiscard]] Result<std::vector<std::string>> check_draw(const PipelineState& state,
                                                          std::span<const TextureUnit> units);

// Which planes clear() fills.
struct ClearBuffers {
  bool color = true;    // GL_COLOR_BUFFER_BIT
  bool depth = true;    // GL_DEPTH_BUFFER_BIT
  bool stencil = true;  // GL_STENCIL_BUFFER_BIT
};

// GL's clear: writes the values into the named planes of the target, through the colour mask, the depth test's `write`
// (whether or not the test is enabled), the front stencil write mask and the scissor. Output planes stay unchanged.
// Reports the errors that rasterize() reports for the target.
[[nodiscard]] Status clear(const PipelineState& state, ClearBuffers buffers, const ClearValues& values,
                           RenderTarget& target);

}  // namespace ninebit

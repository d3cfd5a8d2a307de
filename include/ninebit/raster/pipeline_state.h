// Everything a draw call depends on besides its vertices, textures and target: plain data with GL's defaults.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// GL_NEVER, GL_LESS, … GL_ALWAYS, in GL's order.
enum class CompareFunction : std::uint8_t { never, less, equal, lequal, greater, notequal, gequal, always };
// GL_KEEP, GL_ZERO, …: incr and decr clamp; incr_wrap and decr_wrap (EXT_stencil_wrap) wrap.
enum class StencilOperation : std::uint8_t { keep, zero, replace, incr, decr, invert, incr_wrap, decr_wrap };
// flat: every fragment has the colours of the primitive's provoking vertex.
enum class ShadeModel : std::uint8_t { flat, smooth };
// Which polygons are not drawn; none: GL_CULL_FACE is disabled.
enum class CullFace : std::uint8_t { none, front, back, front_and_back };
// The winding of a front face, as seen in the window, y up.
enum class FrontFace : std::uint8_t { counter_clockwise, clockwise };
// A polygon draws points at its vertices, its boundary, or its area.
enum class PolygonMode : std::uint8_t { point, line, fill };

// `left function right`. The functions are numbered as in GL (GL_NEVER + n), which makes each a set of three bits:
// less, equal, greater.
[[nodiscard]] constexpr bool compare(CompareFunction function, std::uint32_t left, std::uint32_t right) {
  const unsigned order = left < right ? 0U : left == right ? 1U : 2U;
  return ((static_cast<unsigned>(function) >> order) & 1U) != 0;
}

// A rectangle of pixels; x and y name its lower left corner. Width and height are not negative.
struct PixelRect {
  int x = 0;       // pixels from the left
  int y = 0;       // pixels from the lowest row up
  int width = 0;   // pixels
  int height = 0;  // pixels
};

// A fragment passes if `alpha function reference` holds; both are bytes.
struct AlphaTest {
  bool enabled = false;                                // GL_ALPHA_TEST
  CompareFunction function = CompareFunction::always;  // fragment's alpha on the left
  std::uint8_t reference = 0;                          // on the right
};

// The stencil test for fragments of one facing: (reference & mask) function (stored & mask).
struct StencilFace {
  CompareFunction function = CompareFunction::always;  // reference on the left
  int reference = 0;  // clamped to [0, 2^s - 1], s being the stencil bits of the target; REPLACE writes it unmasked
  std::uint8_t mask = 0xFF;                              // bits that are compared
  std::uint8_t write_mask = 0xFF;                        // bits that an operation may change
  StencilOperation fail = StencilOperation::keep;        // after a failed stencil test
  StencilOperation depth_fail = StencilOperation::keep;  // after a passed stencil test and a failed depth test
  StencilOperation depth_pass = StencilOperation::keep;  // after both passed, or without a depth test
};

// The stencil test, for each facing (EXT_stencil_two_side).
struct StencilTest {
  bool enabled = false;               // GL_STENCIL_TEST
  StencilFace front;                  // front-facing polygons, points and lines
  std::optional<StencilFace> back{};  // back-facing polygons in any polygon mode; empty: the same as front
};

// While the test is disabled, depth is neither compared nor written.
struct DepthTest {
  bool enabled = false;                              // GL_DEPTH_TEST
  CompareFunction function = CompareFunction::less;  // fragment's depth on the left, stored depth on the right
  bool write = true;                                 // GL_DEPTH_WRITEMASK
};

// factor × m + r × units is added to the depth of a polygon's fragments; the sum is clamped to [0, 1]. m is the
// polygon's slope as profile.polygon_offset_slope defines it; r is one step of the target's depth format, and 1 in
// formats that hold floating-point numbers or w.
struct PolygonOffset {
  bool fill = false;    // GL_POLYGON_OFFSET_FILL: for polygons in that polygon mode
  bool line = false;    // GL_POLYGON_OFFSET_LINE
  bool point = false;   // GL_POLYGON_OFFSET_POINT
  float factor = 0.0F;  // of the slope
  float units = 0.0F;   // of the depth format's steps
};

// GL 1.2's factors, with its imaging subset. src_color and dst_color are legal on both sides (NV_blend_square, which
// the GeForce 2 supports).
enum class BlendFactor : std::uint8_t {
  zero,
  one,
  src_color,
  one_minus_src_color,
  dst_color,
  one_minus_dst_color,
  src_alpha,
  one_minus_src_alpha,
  dst_alpha,
  one_minus_dst_alpha,
  constant_color,
  one_minus_constant_color,
  constant_alpha,
  one_minus_constant_alpha,
  src_alpha_saturate  // min(As, 1 - Ad) for colours, 1 for alpha; of the destination not in OpenGL 1.3, but on an NV2A
};
// Combines the two products: sum, difference; or the colours without factors.
enum class BlendEquation : std::uint8_t {
  add,
  subtract,
  reverse_subtract,
  min,
  max,
  // The NV2A's: the source is a signed byte, from -128 to 127.
  add_signed,              // destination + source, clamped
  reverse_subtract_signed  // destination - source, clamped
};

// In bytes: (source × factor + destination × factor) / 255; the sum is rounded once, to nearest, and clamped (rule 19,
// measured for all factors and equations). A target without an alpha plane has a destination alpha
// of 255.
struct Blend {
  bool enabled = false;                         // GL_BLEND
  BlendFactor source = BlendFactor::one;        // of the fragment's colour
  BlendFactor destination = BlendFactor::zero;  // of the stored colour
  BlendEquation equation = BlendEquation::add;  // combines both products
  std::array<std::uint8_t, 4> color{};          // the constant colour
};

// A stipple pattern as glPolygonStipple takes it: 32 rows from the lowest up, of four bytes. The highest bit of a row's
// first byte is its leftmost pixel.
using StipplePattern = std::array<std::uint8_t, 128>;

// Texture coordinates that run across each point (NV_point_sprite, rule 46): s from 0 at its left side to 1 at its
// right one, t from 0 at its upper side to 1 at its lower one, r is 0 and q is 1.
struct PointSprite {
  bool enabled = false;                              // GL_POINT_SPRITE_NV
  std::array<bool, kTextureStages> coord_replace{};  // GL_COORD_REPLACE_NV: the units that have these coordinates
};

// How a fragment's fog factor f follows from the interpolated value x of its vertices, VertexArrays::fog_factors. All
// but `factor` are the NV2A's SET_FOG_MODE, computed at each fragment from bias b and slope l (rule 49), with
// t = b - 1.5 + l x.
enum class FogFunction : std::uint8_t {
  factor,      // x itself, clamped to [0, 1] at the vertices: factors that OpenGL computed
  linear,      // b - 1 + l x
  linear_abs,  // b - 1 + l |x|
  exp,         // 2^(16 t), at most 1
  exp_abs,     // 2^(-16 |t|)
  exp2,        // 2^(-32 t²), as exp2_abs
  exp2_abs     // 2^(-32 t²)
};

// The fog registers. Programs always read its colour; they read the fragments' factors only while fog is enabled.
struct Fog {
  bool enabled = false;                        // GL_FOG
  std::array<std::uint8_t, 3> color{};         // red, green, blue
  FogFunction function = FogFunction::factor;  // of the vertices' values
  float bias = 0.0F;                           // SET_FOG_PARAMS 0
  float slope = 0.0F;                          // SET_FOG_PARAMS 1
};

// The state of a draw. rasterize() reports values outside of the given ranges.
struct PipelineState {
  HardwareProfile profile = profiles::geforce2;  // of the rasterizer; the program has its own arithmetic

  std::optional<PixelRect> viewport;  // within the target; empty: the whole target
  float depth_near = 0.0F;            // glDepthRange, each clamped to [0, 1]
  float depth_far = 1.0F;             // likewise
  // The number that window depth 1 stands for in a floating-point depth buffer (f24s8, f16); empty: the format's
  // largest.
  std::optional<float> float_depth_one;

  ShadeModel shade_model = ShadeModel::smooth;          // of primary and secondary colours
  CullFace cull_face = CullFace::none;                  // of polygons in any mode
  FrontFace front_face = FrontFace::counter_clockwise;  // decides facing: culling, modes and stencil depend on it
  PolygonMode front_mode = PolygonMode::fill;           // of front faces
  PolygonMode back_mode = PolygonMode::fill;            // of back faces
  PolygonOffset polygon_offset;                         // of polygons in the enabled modes
  // In pixels, in steps of 1/8, as profile.point_shape and line_shape say. Where they are OpenGL's, sizes are rounded
  // to whole pixels, halves up, and a size that becomes 0 counts as 1.
  float point_size = 1.0F;  // 0 to 64; 0 draws one pixel
  float line_width = 1.0F;  // 1/8 to 64

  PointSprite point_sprite;     // of points, also of those of polygon modes
  bool polygon_smooth = false;  // GL_POLYGON_SMOOTH: of polygons in the mode fill (rule 47)
  bool line_smooth = false;     // GL_LINE_SMOOTH: of lines, also of those of polygon modes
  // The stipple of polygons in the mode fill, by pixels of the target; empty: GL_POLYGON_STIPPLE is disabled.
  std::optional<StipplePattern> polygon_stipple;

  // If enabled, the stages give the texture registers, may cull fragments and may replace their depth.
  TextureShaderState texture_shader;

  Fog fog;  // read by programs
  // The register combiners; empty: they are disabled and the fragment's colour is its primary colour.
  std::optional<Program> program;

  std::optional<PixelRect> scissor;                        // empty: GL_SCISSOR_TEST is disabled
  AlphaTest alpha_test;                                    // the first test
  StencilTest stencil_test;                                // the second
  DepthTest depth_test;                                    // the third
  Blend blend;                                             // of fragments that passed all tests
  std::array<bool, 4> color_mask{true, true, true, true};  // red, green, blue, alpha: which are written
};

}  // namespace ninebit

// Everything a draw call depends on besides its vertices, textures and target: plain data with GL's defaults.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

enum class CompareFunction : std::uint8_t { never, less, equal, lequal, greater, notequal, gequal, always };
enum class StencilOperation : std::uint8_t { keep, zero, replace, incr, decr, invert, incr_wrap, decr_wrap };
enum class ShadeModel : std::uint8_t { flat, smooth };
enum class CullFace : std::uint8_t { none, front, back, front_and_back };
enum class FrontFace : std::uint8_t { counter_clockwise, clockwise };  // as seen in the window, y up
enum class PolygonMode : std::uint8_t { point, line, fill };

// `left function right`. The functions are numbered as in GL (GL_NEVER + n), which makes each a set of three bits:
// less, equal, greater.
[[nodiscard]] constexpr bool compare(CompareFunction function, std::uint32_t left, std::uint32_t right) {
  const unsigned order = left < right ? 0U : left == right ? 1U : 2U;
  return ((static_cast<unsigned>(function) >> order) & 1U) != 0;
}

// A rectangle of pixels; x and y name its lower left corner. Width and height are not negative.
struct PixelRect {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
};

struct AlphaTest {
  bool enabled = false;
  CompareFunction function = CompareFunction::always;
  std::uint8_t reference = 0;
};

// What the stencil test does with fragments of one facing: (reference & mask) function (stored & mask).
struct StencilFace {
  CompareFunction function = CompareFunction::always;
  int reference = 0;  // clamped to [0, 2^s - 1], s being the stencil bits of the target; REPLACE writes it unmasked
  std::uint8_t mask = 0xFF;
  std::uint8_t write_mask = 0xFF;
  StencilOperation fail = StencilOperation::keep;
  StencilOperation depth_fail = StencilOperation::keep;
  StencilOperation depth_pass = StencilOperation::keep;
};

struct StencilTest {
  bool enabled = false;
  StencilFace front;                  // also points, lines, and what has no facing
  std::optional<StencilFace> back{};  // back-facing polygons in any polygon mode; empty: the same as front
};

// While the test is disabled, depth is neither compared nor written.
struct DepthTest {
  bool enabled = false;
  CompareFunction function = CompareFunction::less;
  bool write = true;
};

// factor × m + r × units is added to the depth of a polygon's fragments; the sum is clamped to [0, 1]. m is the
// polygon's slope in the form of profile.polygon_offset_slope, r one step of the target's depth format.
struct PolygonOffset {
  bool fill = false;   // GL_POLYGON_OFFSET_FILL: for polygons in that polygon mode
  bool line = false;   // GL_POLYGON_OFFSET_LINE
  bool point = false;  // GL_POLYGON_OFFSET_POINT
  float factor = 0.0F;
  float units = 0.0F;
};

// GL 1.2's factors, those of its imaging subset included. src_color and dst_color are legal on both sides, as NV_blend_
// square has them, which a GeForce 2 has.
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
  src_alpha_saturate  // source only: min(As, 1 - Ad) for colours, 1 for alpha
};
enum class BlendEquation : std::uint8_t { add, subtract, reverse_subtract, min, max };

// In bytes: (source × factor + destination × factor) / 255, one sum, rounded once to nearest, clamped (rule 19; for
// other factors than the measured pair inferred). A target without an alpha plane has a destination alpha of 255.
struct Blend {
  bool enabled = false;
  BlendFactor source = BlendFactor::one;
  BlendFactor destination = BlendFactor::zero;
  BlendEquation equation = BlendEquation::add;
  std::array<std::uint8_t, 4> color{};  // the constant colour
};

// The fog registers: its colour is there in any case, the fragments' factors are read while it is enabled.
struct Fog {
  bool enabled = false;
  std::array<std::uint8_t, 3> color{};
};

struct PipelineState {
  HardwareProfile profile = profiles::geforce2;

  std::optional<PixelRect> viewport;  // within the target; empty: the whole target
  float depth_near = 0.0F;            // glDepthRange, each clamped to [0, 1]
  float depth_far = 1.0F;

  ShadeModel shade_model = ShadeModel::smooth;
  CullFace cull_face = CullFace::none;  // of polygons, before their mode is looked at
  FrontFace front_face = FrontFace::counter_clockwise;
  PolygonMode front_mode = PolygonMode::fill;
  PolygonMode back_mode = PolygonMode::fill;
  PolygonOffset polygon_offset;
  int point_size = 1;  // pixels, 1 to 64
  int line_width = 1;  // pixels, 1 to 64

  Fog fog;
  // The register combiners; empty: they are disabled and the fragment's colour is its primary colour.
  std::optional<Program> program;

  std::optional<PixelRect> scissor;  // empty: GL_SCISSOR_TEST is disabled
  AlphaTest alpha_test;
  StencilTest stencil_test;
  DepthTest depth_test;
  Blend blend;
  std::array<bool, 4> color_mask{true, true, true, true};
};

}  // namespace ninebit

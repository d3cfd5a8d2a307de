// Everything a draw call depends on besides its vertices, textures and target: plain data with GL's defaults.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {

enum class CompareFunction : std::uint8_t { never, less, equal, lequal, greater, notequal, gequal, always };
enum class StencilOperation : std::uint8_t { keep, zero, replace, incr, decr, invert, incr_wrap, decr_wrap };
enum class ShadeModel : std::uint8_t { flat, smooth };
enum class CullFace : std::uint8_t { none, front, back };

// `left function right`. The functions are numbered as in GL (GL_NEVER + n), which makes each a set of three bits:
// less, equal, greater.
[[nodiscard]] constexpr bool compare(CompareFunction function, std::uint32_t left, std::uint32_t right) {
  const unsigned order = left < right ? 0U : left == right ? 1U : 2U;
  return ((static_cast<unsigned>(function) >> order) & 1U) != 0;
}

struct AlphaTest {
  bool enabled = false;
  CompareFunction function = CompareFunction::always;
  std::uint8_t reference = 0;
};

// (reference & mask) function (stored & mask).
struct StencilTest {
  bool enabled = false;
  CompareFunction function = CompareFunction::always;
  std::uint8_t reference = 0;
  std::uint8_t mask = 0xFF;
  std::uint8_t write_mask = 0xFF;
  StencilOperation fail = StencilOperation::keep;
  StencilOperation depth_fail = StencilOperation::keep;
  StencilOperation depth_pass = StencilOperation::keep;
};

// While the test is disabled, depth is neither compared nor written.
struct DepthTest {
  bool enabled = false;
  CompareFunction function = CompareFunction::less;
  bool write = true;
};

struct PipelineState {
  HardwareProfile profile = profiles::geforce2;
  AlphaTest alpha_test;
  StencilTest stencil_test;
  DepthTest depth_test;
  std::array<bool, 4> color_mask{true, true, true, true};
  ShadeModel shade_model = ShadeModel::smooth;
  CullFace cull_face = CullFace::none;  // a triangle whose vertices run counter-clockwise in the window is a front
  // The register combiners; empty: they are disabled and the fragment's colour is its primary colour.
  std::optional<Program> program;
};

}  // namespace ninebit

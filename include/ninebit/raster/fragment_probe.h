// Records every fragment that a draw makes at one pixel, with its registers and its fate.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Which test ended a fragment, in GL's order of tests; `written` passed them all.
enum class FragmentFate : std::uint8_t { alpha_failed, stencil_failed, depth_failed, written };

// One fragment that a draw made at the watched pixel.
struct ProbedFragment {
  std::uint32_t primitive = 0;          // number in the draw
  std::uint32_t depth = 0;              // code of the target's format
  std::uint32_t stored_depth = 0;       // depth plane before the fragment; 0 without a plane
  std::uint8_t stored_stencil = 0;      // stencil plane before the fragment; 0 without a plane
  RegisterFile registers;               // before the first general combiner; `zero` and constants are 0 here
  std::array<std::uint8_t, 4> color{};  // input of the fragment operations, before masks
  bool depth_passes = false;            // regardless of the alpha and stencil tests
  FragmentFate fate = FragmentFate::written;
  friend constexpr bool operator==(const ProbedFragment&, const ProbedFragment&) = default;
};

// A render target with a probe (RenderTarget::probe) appends every fragment that a draw makes at this pixel, in drawing
// order for any number of threads. This includes fragments that the rasterizer would otherwise skip because they cannot
// pass the tests. A probe changes no pixel.
struct FragmentProbe {
  int x = 0;                                // window coordinates: y up
  int y = 0;                                // from the lowest row up
  std::vector<ProbedFragment> fragments{};  // grows with each draw; the caller clears it
};

}  // namespace ninebit

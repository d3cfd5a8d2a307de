// Watching one pixel of a draw: every fragment that is drawn there, with its registers and what became of it.
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
  std::uint32_t primitive = 0;                // its number in the draw
  std::uint32_t depth = 0;                    // its code
  std::uint32_t stored_depth = 0;             // what it met in the depth plane; 0 without a plane
  std::uint8_t stored_stencil = 0;            // and in the stencil plane
  RegisterFile registers;                     // before the first general combiner; `zero` and constants are 0 here
  std::array<std::uint8_t, 4> color{};        // what came to the fragment operations, masks not applied
  bool depth_passes = false;                  // whether the depth test passes, whatever alpha and stencil test say
  FragmentFate fate = FragmentFate::written;  // what became of it
  friend constexpr bool operator==(const ProbedFragment&, const ProbedFragment&) = default;
};

// A render target with a probe (RenderTarget::probe) appends every fragment that a draw makes at this pixel, in drawing
// order, whatever the number of threads; also those that the rasterizer would otherwise not compute, because no test
// lets them through. All other pixels are drawn as without a probe, and so is this one.
struct FragmentProbe {
  int x = 0;                                // window coordinates: y up
  int y = 0;                                // from the lowest row up
  std::vector<ProbedFragment> fragments{};  // grows with each draw; the caller clears it
};

}  // namespace ninebit

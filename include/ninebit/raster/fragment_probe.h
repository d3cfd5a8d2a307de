// Watches pixels of a draw: every fragment that is drawn there, with its registers and its fate.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/evaluate_stages.h"

namespace NINEBIT_PUBLIC ninebit {

// The first test that rejected a fragment, in GL's order; `written`: it passed all tests.
enum class FragmentFate : std::uint8_t {
  alpha_failed,
  stencil_failed,
  depth_failed,
  written,
  culled  // by a texture-shader stage, before all tests
};

// One fragment that a draw made at the watched pixel.
struct ProbedFragment {
  std::uint32_t primitive = 0;          // its number in the draw
  std::uint32_t depth = 0;              // its code; a replaced depth if the stages replace it
  std::uint32_t stored_depth = 0;       // the depth plane's code before the fragment; 0 without a plane
  std::uint8_t stored_stencil = 0;      // the stencil plane's value before the fragment; 0 without a plane
  RegisterFile registers;               // before the first general combiner; `zero` and constants are 0 here
  std::array<std::uint8_t, 4> color{};  // input of the fragment operations, before masks
  bool depth_passes = false;            // whether the depth test passes, regardless of the alpha and stencil tests;
                                        // false for a culled fragment, which is not tested
  FragmentFate fate = FragmentFate::written;    // what rejected it, or `written`
  std::optional<TextureShaderResult> stages{};  // of its texture-shader stages; empty: they are not enabled
  friend bool operator==(const ProbedFragment&, const ProbedFragment&) = default;
};

// A draw into a target with probes (RenderTarget::probes) appends every fragment at their pixels, in drawing order, for
// any number of threads. Fragments that early tests would reject are computed and appended, too. No pixel changes.
struct FragmentProbe {
  int x = 0;                                // window coordinates: y up
  int y = 0;                                // from the lowest row up
  std::vector<ProbedFragment> fragments{};  // grows with each draw; the caller clears it
};

}  // namespace ninebit

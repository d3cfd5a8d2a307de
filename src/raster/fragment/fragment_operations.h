// Alpha test, stencil test, depth test, blending and masks, in GL's order, for one fragment at a time.
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/raster/fragment_probe.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/surface.h"
#include "src/raster/fragment/stencil.h"
#include "src/raster/surface/color_store.h"

namespace ninebit {

// A fragment that the scissor let through, without its colour.
struct UncoloredFragment {
  int x = 0;
  int y = 0;
  std::uint32_t depth = 0;  // a code of the target's format
  std::uint32_t primitive = 0;
  bool front_facing = true;     // false: of a back-facing polygon, in whatever mode
  std::uint8_t coverage = 255;  // of a smoothed primitive
};

// The operations of one draw call, with every decision of the state taken once. The target must have passed
// check_target (target_check.h).
class FragmentOperations {
 public:
  // With reject_early == false, is_lost_early never returns true; results are the same. For tests and probes.
  FragmentOperations(const PipelineState& state, const RenderTarget& target, bool reject_early = true);

  // Whether the fragment certainly changes nothing, including output planes, so that its colour need not be computed.
  // `false` guarantees nothing. Exact also while earlier fragments of the same draw wait in a batch: see the
  // constructor.
  [[nodiscard]] bool is_lost_early(const UncoloredFragment& f) const {
    if (early_stencil_ && !side(f).passes(target_.stencil.at(f.x, f.y))) return true;
    return (f.front_facing ? early_depth_front_ : early_depth_back_) &&
           !compare(depth_function_, f.depth, target_.depth.at(f.x, f.y));
  }

  // Whether the depth test would pass now.
  [[nodiscard]] bool depth_passes(const UncoloredFragment& f) const {
    return !depth_enabled_ || compare(depth_function_, f.depth, target_.depth.at(f.x, f.y));
  }

  // The fate that `apply` would give the fragment now.
  [[nodiscard]] FragmentFate fate_of(const UncoloredFragment& f, const ColorBytes& whole) const {
    const ColorBytes color = covered(f, whole);
    if (alpha_enabled_ && !compare(alpha_function_, color[3], alpha_reference_)) return FragmentFate::alpha_failed;
    if (stencil_enabled_ && !side(f).passes(target_.stencil.at(f.x, f.y))) return FragmentFate::stencil_failed;
    return depth_passes(f) ? FragmentFate::written : FragmentFate::depth_failed;
  }

  // Runs the tests (the alpha test by rule 18) and writes colour, depth and stencil. Returns whether the fragment
  // passed all tests.
  bool apply(const UncoloredFragment& f, const ColorBytes& whole) const {
    const ColorBytes color = covered(f, whole);
    if (alpha_enabled_ && !compare(alpha_function_, color[3], alpha_reference_)) return false;
    if (stencil_enabled_) {
      if (!apply_stencil(f)) return false;
    } else if (!depth_passes(f)) {
      return false;
    }
    if (depth_write_) target_.depth.at(f.x, f.y) = f.depth;
    if (!writes_color_) return true;
    if (blends_) {
      write_blended(f, color);
    } else {
      write(f, color);
    }
    return true;
  }

  // Whether `apply` uses the fragment's colour at all.
  [[nodiscard]] bool needs_color() const { return alpha_enabled_ || writes_color_; }

 private:
  // The colour with its alpha multiplied by the coverage (rule 47).
  [[nodiscard]] ColorBytes covered(const UncoloredFragment& f, const ColorBytes& color) const {
    if (f.coverage == 255) return color;
    const int product = color[3] * f.coverage;
    return {color[0], color[1], color[2], static_cast<std::uint8_t>((product + (cuts_coverage_ ? 0 : 127)) / 255)};
  }

  [[nodiscard]] const StencilSide& side(const UncoloredFragment& f) const { return f.front_facing ? front_ : back_; }

  // The stencil test, then the depth test; true: both passed.
  [[nodiscard]] bool apply_stencil(const UncoloredFragment& f) const {
    const StencilSide& test = side(f);
    std::uint8_t& stored = target_.stencil.at(f.x, f.y);
    if (!test.passes(stored)) {
      stored = test.after_fail(stored);
      return false;
    }
    const bool depth = depth_passes(f);
    stored = depth ? test.after_depth_pass(stored) : test.after_depth_fail(stored);
    return depth;
  }

  void write(const UncoloredFragment& f, const ColorBytes& whole) const {
    const ColorBytes color = store_(whole);
    for (std::size_t i = 0; i < 4; ++i) {
      if (color_mask_[i]) target_.color[i].at(f.x, f.y) = color[i];
    }
  }
  void write_blended(const UncoloredFragment& f, const ColorBytes& color) const;

  RenderTarget target_;
  CompareFunction alpha_function_;
  CompareFunction depth_function_;
  std::uint8_t alpha_reference_;
  bool alpha_enabled_;
  bool stencil_enabled_;
  bool depth_enabled_;
  bool depth_write_;
  bool writes_color_;
  bool blends_;
  bool cuts_coverage_;
  bool early_stencil_;
  bool early_depth_front_;
  bool early_depth_back_;
  std::array<bool, 4> color_mask_;  // false also where the target has no such plane
  Blend blend_;
  ColorStore store_;
  BlendReads reads_;
  StencilSide front_;
  StencilSide back_;
};

}  // namespace ninebit

// Alpha test, stencil test, depth test and masks, in GL's order, for one fragment at a time.
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/raster/fragment_probe.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/surface.h"

namespace ninebit {

struct Fragment {
  int x = 0;
  int y = 0;
  std::uint32_t z24 = 0;
  std::uint32_t primitive = 0;
};

// The operations of one draw call, with every decision of the state taken once.
class FragmentOperations {
 public:
  FragmentOperations(const PipelineState& state, const RenderTarget& target);

  // Whether the fragment is lost for certain and without a trace, so that its colour need not be computed. `false`
  // promises nothing. Exact also while earlier fragments of the same draw wait in a batch: see the constructor.
  [[nodiscard]] bool is_lost_early(const Fragment& f) const {
    if (early_stencil_ && !stencil_passes(target_.stencil.at(f.x, f.y))) return true;
    return early_depth_ && !compare(depth_function_, f.z24, target_.depth_z24.at(f.x, f.y));
  }

  // Whether the depth test would pass now.
  [[nodiscard]] bool depth_passes(const Fragment& f) const {
    return !depth_enabled_ || compare(depth_function_, f.z24, target_.depth_z24.at(f.x, f.y));
  }

  // Tests the fragment and writes what it may; tells which test ended it.
  FragmentFate apply(const Fragment& f, const ColorBytes& color) const {
    if (!compare(alpha_function_, color[3], alpha_reference_)) return FragmentFate::alpha_failed;
    if (stencil_enabled_) {
      std::uint8_t& stored = target_.stencil.at(f.x, f.y);
      if (!stencil_passes(stored)) {
        stored = stencil_fail_[stored];
        return FragmentFate::stencil_failed;
      }
      const bool depth = depth_passes(f);
      stored = depth ? stencil_depth_pass_[stored] : stencil_depth_fail_[stored];
      if (!depth) return FragmentFate::depth_failed;
    } else if (!depth_passes(f)) {
      return FragmentFate::depth_failed;
    }
    if (depth_write_) target_.depth_z24.at(f.x, f.y) = f.z24;
    if (!writes_color_) return FragmentFate::written;
    for (std::size_t i = 0; i < 4; ++i) {
      if (color_mask_[i]) target_.color[i].at(f.x, f.y) = color[i];
    }
    if (target_.primitive) target_.primitive.at(f.x, f.y) = f.primitive;
    return FragmentFate::written;
  }

  [[nodiscard]] bool needs_alpha() const { return alpha_function_ != CompareFunction::always; }
  [[nodiscard]] bool writes_color() const { return writes_color_; }

 private:
  using StencilTable = std::array<std::uint8_t, 256>;  // stored value to new value

  [[nodiscard]] bool stencil_passes(std::uint8_t stored) const {
    return compare(stencil_function_, stencil_reference_, stored & stencil_mask_);
  }

  RenderTarget target_;
  CompareFunction alpha_function_;
  std::uint8_t alpha_reference_;
  bool stencil_enabled_;
  CompareFunction stencil_function_;
  std::uint8_t stencil_reference_;  // already masked
  std::uint8_t stencil_mask_;
  StencilTable stencil_fail_, stencil_depth_fail_, stencil_depth_pass_;
  bool depth_enabled_;
  CompareFunction depth_function_;
  bool depth_write_;
  std::array<bool, 4> color_mask_;
  bool writes_color_;
  bool early_stencil_;
  bool early_depth_;
};

}  // namespace ninebit

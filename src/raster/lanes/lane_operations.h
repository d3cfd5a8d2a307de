// The fragment operations of one draw, prepared for lanes of fragments: plain numbers, every decision taken once.
#pragma once

#include <cstdint>

#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"

namespace ninebit {

// A comparison as words of all ones or zeros: (less where left < right, or equal where they are equal), inverted.
struct LaneComparison {
  std::uint32_t less = 0;
  std::uint32_t equal = 0;
  std::uint32_t invert = 0;
};

// The stencil test and its operations for one facing; see StencilFace.
struct LaneStencil {
  LaneComparison test;
  std::uint32_t reference = 0;  // masked, for the test
  std::uint32_t mask = 0;
  std::uint32_t replacement = 0;  // the reference, not masked
  std::uint32_t largest = 0;      // value
  std::uint32_t writable = 0;     // bits
  StencilOperation fail = StencilOperation::keep;
  StencilOperation depth_fail = StencilOperation::keep;
  StencilOperation depth_pass = StencilOperation::keep;
  // Whether such a fragment leaves the stored value as it was.
  bool fail_keeps = true;
  bool depth_fail_keeps = true;
  bool depth_pass_keeps = true;
};

struct LaneOperations {
  LaneOperations(const PipelineState& state, const RenderTarget& target);

  bool alpha = false;  // what is enabled
  bool stencil = false;
  bool depth = false;
  bool depth_write = false;
  bool color = false;  // whether any colour plane is written
  LaneComparison alpha_test;
  LaneComparison depth_test;
  std::uint32_t alpha_reference = 0;
  LaneStencil front;
  LaneStencil back;
  bool two_sided = false;  // whether front and back may differ
  bool stencil_write = false;
  bool tests_change = false;  // whether a fragment that is drawn may change the outcome of a later one's tests

  // Whether a fragment is drawn where it is nearer than what is stored, and no other test is made.
  bool is_nearest_alone = false;

  // Whether what the tests say of a fragment when it is gathered is final: nothing that waits changes it, and those
  // that fail leave no trace.
  bool are_tests_final = false;
  // Whether, besides, the depth test is EQUAL and the stencil test the same for both facings.
  bool asks_equal_depth = false;
  bool stencil_decides = false;  // whether the stencil test is any but ALWAYS
  // Whether a fragment that is farther than what is stored leaves no trace.
  bool loses_farther = false;

  // Whether the fragments' colours are looked at.
  [[nodiscard]] bool needs_color() const { return alpha || color; }

  [[nodiscard]] const LaneStencil& side(bool front_facing) const { return front_facing ? front : back; }
};

}  // namespace ninebit

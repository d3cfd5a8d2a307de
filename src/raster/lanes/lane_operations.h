// The fragment operations of one draw, prepared for lanes of fragments: plain numbers, each decision made once.
#pragma once

#include <cstdint>

#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"
#include "src/raster/surface/color_store.h"

namespace ninebit {

// A comparison as words of all ones or all zeros: ((left < right and `less`) or (left == right and `equal`)) xor
// `invert`.
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
  // True if such a fragment does not change the stored value.
  bool fail_keeps = true;
  bool depth_fail_keeps = true;
  bool depth_pass_keeps = true;
};

// Blending, with colours as words: red in the lowest byte.
struct LaneBlend {
  Blend state;
  std::uint32_t constant = 0;     // colour
  std::uint32_t source_kept = 0;  // the bits that are read (rule 44)
  std::uint32_t stored_kept = 0;
  std::uint32_t stored_set = 0;  // what is read as ones
};

struct LaneOperations {
  // `replaces_depth`: a fragment's depth is not known when it is gathered, so no test is made then.
  LaneOperations(const PipelineState& state, const RenderTarget& target, bool replaces_depth = false);

  bool alpha = false;    // true if the alpha test is enabled and may fail
  bool stencil = false;  // true if the stencil test is enabled and the target has a stencil plane
  bool depth = false;    // true if the depth test is enabled and the target has a depth plane
  bool depth_write = false;
  bool replaces_depth = false;
  bool color = false;   // true if any colour plane is written
  ColorStore store;     // of colours that are written
  bool blends = false;  // true if they are blended
  LaneBlend blend;
  bool stipples = false;                // true if a stipple pattern leaves pixels out
  bool smooths = false;                 // true if alpha is multiplied by the coverage of polygons or of lines
  std::uint32_t coverage_rounding = 0;  // added to the product before it is divided by 255
  LaneComparison alpha_test;
  LaneComparison depth_test;
  std::uint32_t alpha_reference = 0;
  LaneStencil front;
  LaneStencil back;
  bool two_sided = false;  // true if front and back may differ
  bool stencil_write = false;
  bool tests_change = false;  // true if a fragment that is drawn may change the outcome of a later one's tests

  // True if the nearest fragment is drawn, and no other test is made.
  bool is_nearest_alone = false;

  // True if tests may be made when a fragment is gathered: fragments in the batch do not change their outcome, and
  // fragments that fail change nothing.
  bool are_tests_final = false;
  // True if, in addition, the depth test is EQUAL, the stencil test the same for both facings, and nothing is stippled.
  bool asks_equal_depth = false;
  // True if no test leaves a fragment out when it is gathered.
  bool tests_nothing = false;
  bool stencil_decides = false;  // true if the stencil test may fail
  // True if a fragment that is farther than the stored depth changes nothing.
  bool loses_farther = false;

  // True if the fragments' colours are read.
  [[nodiscard]] bool needs_color() const { return alpha || color; }

  [[nodiscard]] const LaneStencil& side(bool front_facing) const { return front_facing ? front : back; }

 private:
  void prepare_blend(const PipelineState& state, const RenderTarget& target);
  void prepare_stencil(const StencilTest& test, int bits);
  void find_consequences(CompareFunction depth_function);
};

}  // namespace ninebit

#include "src/raster/lanes/lane_operations.h"

#include <algorithm>

namespace ninebit {
namespace {

// Two words and an inversion instead of three words: what holds for `greater` inverts the other two.
LaneComparison comparison(CompareFunction function) {
  const auto word = [](bool set) { return set ? ~std::uint32_t{0} : 0; };
  const bool less = compare(function, 0, 1), equal = compare(function, 0, 0), greater = compare(function, 1, 0);
  return {word(less != greater), word(equal != greater), word(greater)};
}

LaneStencil stencil(const StencilFace& face, int bits) {
  const int largest = (1 << bits) - 1;
  LaneStencil s;
  s.test = comparison(face.function);
  s.largest = static_cast<std::uint32_t>(largest);
  s.replacement = static_cast<std::uint32_t>(std::clamp(face.reference, 0, largest));
  s.mask = face.mask & s.largest;
  s.reference = s.replacement & s.mask;
  s.writable = face.write_mask & s.largest;
  s.fail = face.fail;
  s.depth_fail = face.depth_fail;
  s.depth_pass = face.depth_pass;
  const auto keeps = [&](StencilOperation operation) { return operation == StencilOperation::keep || s.writable == 0; };
  s.fail_keeps = keeps(s.fail);
  s.depth_fail_keeps = keeps(s.depth_fail);
  s.depth_pass_keeps = keeps(s.depth_pass);
  return s;
}

}  // namespace

LaneOperations::LaneOperations(const PipelineState& state, const RenderTarget& target)
    : alpha(state.alpha_test.enabled && state.alpha_test.function != CompareFunction::always),
      stencil(state.stencil_test.enabled && stencil_bits(target.format) > 0 && target.stencil),
      depth(state.depth_test.enabled && target.depth),
      depth_write(depth && state.depth_test.write),
      alpha_test(comparison(state.alpha_test.function)),
      depth_test(comparison(state.depth_test.function)),
      alpha_reference(state.alpha_test.reference) {
  for (std::size_t i = 0; i < 4; ++i) color = color || (state.color_mask[i] && target.color[i]);
  tests_change = depth_write;
  is_nearest_alone = depth_write && state.depth_test.function == CompareFunction::less && !alpha && !stencil;
  const CompareFunction function = state.depth_test.function;
  loses_farther = depth && (function == CompareFunction::less || function == CompareFunction::lequal ||
                            function == CompareFunction::equal || function == CompareFunction::never);
  are_tests_final = !tests_change;
  asks_equal_depth = are_tests_final && depth && function == CompareFunction::equal;
  if (!stencil) return;
  const int bits = stencil_bits(target.format);
  front = ninebit::stencil(state.stencil_test.front, bits);
  back = ninebit::stencil(state.stencil_test.back.value_or(state.stencil_test.front), bits);
  two_sided = state.stencil_test.back.has_value();
  for (const LaneStencil* s : {&front, &back}) {
    loses_farther = loses_farther && s->fail_keeps && s->depth_fail_keeps;
    stencil_write = stencil_write || !s->fail_keeps || !s->depth_fail_keeps || !s->depth_pass_keeps;
  }
  const auto is_constant = [](const LaneComparison& test) { return test.less == 0 && test.equal == 0; };
  tests_change = tests_change || (stencil_write && !(is_constant(front.test) && is_constant(back.test)));
  are_tests_final =
      !tests_change && front.fail_keeps && front.depth_fail_keeps && back.fail_keeps && back.depth_fail_keeps;
  asks_equal_depth = are_tests_final && depth && function == CompareFunction::equal && !two_sided;
  const auto may_fail = [](const StencilFace& face) { return face.function != CompareFunction::always; };
  stencil_decides = may_fail(state.stencil_test.front) || (two_sided && may_fail(*state.stencil_test.back));
}

}  // namespace ninebit

#include "src/raster/lanes/lane_operations.h"

#include <algorithm>

#include "src/raster/fragment/blend.h"

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

LaneOperations::LaneOperations(const PipelineState& state, const RenderTarget& target, bool with_replaced_depth)
    : alpha(state.alpha_test.enabled && state.alpha_test.function != CompareFunction::always),
      stencil(state.stencil_test.enabled && stencil_bits(target.format) > 0 && target.stencil),
      depth(state.depth_test.enabled && target.depth),
      depth_write(depth && state.depth_test.write),
      replaces_depth(with_replaced_depth),
      store(target.color_format),
      alpha_test(comparison(state.alpha_test.function)),
      depth_test(comparison(state.depth_test.function)),
      alpha_reference(state.alpha_test.reference) {
  for (std::size_t i = 0; i < 4; ++i) color = color || (state.color_mask[i] && target.color[i]);
  blends = color && state.blend.enabled && !replaces(state.blend);
  if (blends) prepare_blend(state, target);
  stipples = state.polygon_stipple.has_value();
  smooths = state.polygon_smooth || state.line_smooth;
  coverage_rounding = state.profile.coverage_narrowing.value == Narrowing::toward_zero ? 0 : 127;
  if (stencil) prepare_stencil(state.stencil_test, stencil_bits(target.format));
  find_consequences(state.depth_test.function);
}

// A plane that the target lacks is read as 0, or 255 of alpha. The tile's words may hold anything there.
void LaneOperations::prepare_blend(const PipelineState& state, const RenderTarget& target) {
  const BlendReads reads(target.color_format, state.profile.surface_blend);
  blend = {.state = state.blend,
           .constant = word_of(state.blend.color),
           .source_kept = reads.kept,
           .stored_kept = reads.kept,
           .stored_set = reads.set};
  for (std::size_t k = 0; k < 4; ++k) {
    if (target.color[k]) continue;
    const std::uint32_t byte = std::uint32_t{0xFF} << (8 * k);
    blend.stored_kept &= ~byte;
    if (k == 3) blend.stored_set |= byte;
  }
}

void LaneOperations::prepare_stencil(const StencilTest& test, int bits) {
  front = ninebit::stencil(test.front, bits);
  back = ninebit::stencil(test.back.value_or(test.front), bits);
  two_sided = test.back.has_value();
  for (const LaneStencil* s : {&front, &back}) {
    stencil_write = stencil_write || !s->fail_keeps || !s->depth_fail_keeps || !s->depth_pass_keeps;
  }
  const auto may_fail = [](const StencilFace& face) { return face.function != CompareFunction::always; };
  stencil_decides = may_fail(test.front) || (two_sided && may_fail(*test.back));
}

// Without a stencil test, front and back are those of a test that changes nothing.
void LaneOperations::find_consequences(CompareFunction depth_function) {
  const auto is_constant = [](const LaneComparison& test) { return test.less == 0 && test.equal == 0; };
  tests_change = depth_write || (stencil_write && !(is_constant(front.test) && is_constant(back.test)));
  const bool failures_keep = front.fail_keeps && front.depth_fail_keeps && back.fail_keeps && back.depth_fail_keeps;
  are_tests_final = !tests_change && failures_keep && !replaces_depth;
  tests_nothing = are_tests_final && !depth && !stencil && !stipples;
  asks_equal_depth = are_tests_final && depth && depth_function == CompareFunction::equal && !two_sided && !stipples;
  is_nearest_alone =
      depth_write && depth_function == CompareFunction::less && !alpha && !stencil && !stipples && !blends;
  const bool farther_fails = depth_function == CompareFunction::less || depth_function == CompareFunction::lequal ||
                             depth_function == CompareFunction::equal || depth_function == CompareFunction::never;
  loses_farther = depth && farther_fails && failures_keep && !replaces_depth;
}

}  // namespace ninebit

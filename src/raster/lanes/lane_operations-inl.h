// The fragment operations for a vector of fragments, no two of them at the same pixel. D is a tag of 32-bit integers.
#if defined(NINEBIT_RASTER_LANES_LANE_OPERATIONS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_OPERATIONS_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_OPERATIONS_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_OPERATIONS_INL_H_
#endif

#include <cstdint>

#include "hwy/highway.h"
#include "src/raster/lanes/lane_blend-inl.h"
#include "src/raster/lanes/lane_operations.h"
#include "src/raster/lanes/lane_pass.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/rules/fragment_vector-inl.h"
#include "src/raster/setup/window_primitives.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// A LaneComparison as masks, to be used many times.
template <class D>
struct ComparisonMasks {
  hn::Mask<D> less, equal, invert;
  HWY_INLINE ComparisonMasks(D d, const LaneComparison& c)
      : less(mask_of(d, c.less)), equal(mask_of(d, c.equal)), invert(mask_of(d, c.invert)) {}

  // Both sides below 2^31.
  HWY_INLINE hn::Mask<D> operator()(hn::Vec<D> left, hn::Vec<D> right) const {
    return hn::Xor(hn::Or(hn::And(hn::Lt(left, right), less), hn::And(hn::Eq(left, right), equal)), invert);
  }
};

// The stored values after an operation, masked.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V stencil_lanes(D d, StencilOperation operation, const LaneStencil& s, V stored) {
  if (operation == StencilOperation::keep) return stored;
  const VectorValues<D> values;
  const V largest = hn::Set(d, static_cast<std::int32_t>(s.largest));
  const V reference = hn::Set(d, static_cast<std::int32_t>(s.replacement));
  const V result = stencil_result(values, operation, hn::And(stored, largest), reference, largest);
  return write_masked(values, stored, result, hn::Set(d, static_cast<std::int32_t>(s.writable)));
}

// True where stored depth × 256 + stencil has this depth: such words differ in the lowest byte only.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> has_depth(D d, V stored, V depth) {
  const hn::RebindToUnsigned<D> du;
  const auto difference = hn::BitCast(du, hn::Xor(hn::ShiftLeft<8>(depth), stored));
  return hn::RebindMask(d, hn::Lt(difference, hn::Set(du, 0x100)));
}

template <class D>
struct LaneTests {
  hn::Mask<D> stencil;  // passed
  hn::Mask<D> depth;
};

// A draw's operations as vectors use them, for the fragments of one facing.
template <class D>
struct LaneDraw {
  const LaneOperations& operations;
  const LaneStencil& side;
  const ComparisonMasks<D> depth_test, stencil_test, alpha_test;
  HWY_INLINE LaneDraw(D d, const LaneOperations& all, bool front_facing)
      : operations(all),
        side(all.side(front_facing)),
        depth_test(d, all.depth_test),
        stencil_test(d, side.test),
        alpha_test(d, all.alpha_test) {}
};

template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> stencil_passes(D d, const LaneDraw<D>& draw, V stored) {
  return draw.stencil_test(hn::Set(d, static_cast<std::int32_t>(draw.side.reference)),
                           hn::And(stored, hn::Set(d, static_cast<std::int32_t>(draw.side.mask))));
}

// The tests against stored depth × 256 + stencil. A disabled test passes.
template <class D, class V = hn::Vec<D>>
HWY_INLINE LaneTests<D> test_lanes(D d, const LaneDraw<D>& draw, V depth, V stored) {
  const LaneOperations& operations = draw.operations;
  const auto all = hn::FirstN(d, hn::Lanes(d));
  LaneTests<D> tests{all, all};
  if (operations.stencil) tests.stencil = stencil_passes(d, draw, stored);
  if (operations.depth) {
    const hn::RebindToUnsigned<D> du;
    tests.depth = draw.depth_test(depth, hn::BitCast(d, hn::ShiftRight<8>(hn::BitCast(du, stored))));
  }
  return tests;
}

// The fragments of `mask`, without those that will certainly fail a test and change nothing.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> not_lost(D d, const LaneDraw<D>& draw, hn::Mask<D> mask, V depth, V stored) {
  if (draw.operations.replaces_depth) return mask;
  const LaneStencil& side = draw.side;
  const LaneTests<D> tests = test_lanes(d, draw, depth, stored);
  if (!draw.operations.stencil) return hn::And(mask, tests.depth);
  if (side.fail_keeps) mask = hn::And(mask, tests.stencil);
  // Fragments that fail the stencil test may still change the stencil value.
  if (side.depth_fail_keeps) mask = hn::And(mask, hn::Or(tests.depth, hn::Not(tests.stencil)));
  return mask;
}

// The new stencil values: the low eight bits of `stored` after the stencil operations, and nothing else.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V stencil_after(D d, const LaneStencil& side, const LaneTests<D>& tests, V stored) {
  const V value = hn::And(stored, hn::Set(d, 0xFF));
  const V passed = hn::IfThenElse(tests.depth, stencil_lanes(d, side.depth_pass, side, value),
                                  stencil_lanes(d, side.depth_fail, side, value));
  return hn::IfThenElse(tests.stencil, passed, stencil_lanes(d, side.fail, side, value));
}

template <class D>
struct LaneResult {
  hn::Vec<D> depth_stencil;
  hn::Mask<D> drawn;
};

// The fragments of `mask` that pass the alpha test.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> alpha_passes(D d, const LaneDraw<D>& draw, hn::Mask<D> mask, V alpha) {
  if (!draw.operations.alpha) return mask;
  const auto reference = hn::Set(d, static_cast<std::int32_t>(draw.operations.alpha_reference));
  return hn::And(mask, draw.alpha_test(alpha, reference));
}

// Alpha, stencil and depth test of the fragments of `mask`: the new words of the planes, and the fragments that passed.
template <class D, class V = hn::Vec<D>>
HWY_INLINE LaneResult<D> apply_lanes(D d, const LaneDraw<D>& draw, hn::Mask<D> mask, V depth, V alpha, V stored) {
  const LaneOperations& operations = draw.operations;
  mask = alpha_passes(d, draw, mask, alpha);
  const LaneTests<D> tests = test_lanes(d, draw, depth, stored);
  const auto drawn = hn::And(mask, hn::And(tests.stencil, tests.depth));
  V after = stored;
  if (operations.stencil_write) {
    const V value = stencil_after(d, draw.side, tests, stored);
    after = hn::IfThenElse(mask, hn::Or(hn::AndNot(hn::Set(d, 0xFF), stored), value), after);
  }
  if (operations.depth_write) {
    after = hn::IfThenElse(drawn, hn::Or(hn::ShiftLeft<8>(depth), hn::And(after, hn::Set(d, 0xFF))), after);
  }
  return {after, drawn};
}

// Colours as they replace `stored`, which is read only if they are blended.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V stored_colors(D d, const LaneOperations& operations, V colors, V stored) {
  if (HWY_UNLIKELY(operations.blends)) colors = blended_colors(d, operations.blend, colors, stored);
  if (HWY_LIKELY(operations.store.is_exact)) return colors;
  return stored_color(VectorValues<D>(), colors, operations.store.masks);
}

// Window depths as codes of the target. Those of formats of real numbers are codes already.
template <class D>
HWY_INLINE hn::Vec<D> depth_codes(D d, const LanePass& pass, const SetupPrimitive& p, hn::Vec<D> z24) {
  const WindowDepth& depth = pass.context.depth;
  if ((p.offset_z24 == 0 && depth.step_z24() == 1) || depth.is_real()) return z24;
  return depth_code(VectorValues<D>(), z24, hn::Set(d, p.offset_z24),
                    hn::Set(d, static_cast<std::int32_t>(depth.max_z24())), depth.fraction_bits(), depth.half());
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard

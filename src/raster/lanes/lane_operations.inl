// The fragment operations for a vector of fragments, no two of them at the same pixel. No include guard: included once
// inside Highway's namespace of every SIMD target, with `hn` for its operations. D is a tag of 32-bit integers.

HWY_INLINE std::int32_t* lanes_of(std::uint32_t* words) {
  return reinterpret_cast<std::int32_t*>(words);  // signed and unsigned words may alias
}
HWY_INLINE const std::int32_t* lanes_of(const std::uint32_t* words) {
  return reinterpret_cast<const std::int32_t*>(words);
}

// 0, 1, 2, … (Highway's Iota makes it word by word, in memory, each time.)
template <class D>
HWY_INLINE hn::Vec<D> lane_numbers(D d) {
  alignas(64) static constexpr std::array<std::int32_t, 16> kNumbers{0, 1, 2,  3,  4,  5,  6,  7,
                                                                     8, 9, 10, 11, 12, 13, 14, 15};
  return hn::Load(d, kNumbers.data());
}

// A bit for each lane, the first one lowest.
template <class D>
HWY_INLINE std::uint64_t bits_of(D d, hn::Mask<D> mask) {
#if HWY_TARGET <= HWY_AVX3
  return static_cast<std::uint64_t>(mask.raw) & ((std::uint64_t{1} << hn::Lanes(d)) - 1);
#else
  // One byte at a time: a wider load would have to wait until what was stored is in the cache.
  std::array<std::uint8_t, 8> bytes;
  hn::StoreMaskBits(d, mask, bytes.data());
  return hn::MaxLanes(d) > 8 ? bytes[0] | static_cast<std::uint64_t>(bytes[1]) << 8 : bytes[0];
#endif
}

template <class D>
HWY_INLINE hn::Mask<D> mask_of(D d, std::uint32_t word) {
  return hn::MaskFromVec(hn::Set(d, static_cast<std::int32_t>(word)));
}

// A LaneComparison, to be used many times.
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

// What an operation makes of stored values (see stencil_result), masked.
template <class D, class V = hn::Vec<D>>
HWY_INLINE V stencil_lanes(D d, StencilOperation operation, const LaneStencil& s, V stored) {
  const V largest = hn::Set(d, static_cast<std::int32_t>(s.largest)), one = hn::Set(d, 1);
  const V value = hn::And(stored, largest);
  V result = value;
  switch (operation) {
    case StencilOperation::keep:
      return stored;
    case StencilOperation::zero:
      result = hn::Zero(d);
      break;
    case StencilOperation::replace:
      result = hn::Set(d, static_cast<std::int32_t>(s.replacement));
      break;
    case StencilOperation::incr:
      result = hn::Min(hn::Add(value, one), largest);
      break;
    case StencilOperation::decr:
      result = hn::Max(hn::Sub(value, one), hn::Zero(d));
      break;
    case StencilOperation::invert:
      result = hn::AndNot(value, largest);
      break;
    case StencilOperation::incr_wrap:
      result = hn::And(hn::Add(value, one), largest);
      break;
    case StencilOperation::decr_wrap:
      result = hn::And(hn::Sub(value, one), largest);
      break;
  }
  const V writable = hn::Set(d, static_cast<std::int32_t>(s.writable));
  return hn::Or(hn::And(result, writable), hn::AndNot(writable, stored));
}

// Whether stored depth × 256 + stencil has this depth: such words are alike but for the lowest byte.
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

// What vectors ask of a draw's operations, for the fragments of one facing.
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

// The tests against stored depth × 256 + stencil. What is disabled passes.
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

// The fragments of `mask` that are not lost for certain and without a trace.
template <class D, class V = hn::Vec<D>>
HWY_INLINE hn::Mask<D> not_lost(D d, const LaneDraw<D>& draw, hn::Mask<D> mask, V depth, V stored) {
  const LaneStencil& side = draw.side;
  const LaneTests<D> tests = test_lanes(d, draw, depth, stored);
  if (!draw.operations.stencil) return hn::And(mask, tests.depth);
  if (side.fail_keeps) mask = hn::And(mask, tests.stencil);
  // Of those that fail the stencil test nothing is known yet.
  if (side.depth_fail_keeps) mask = hn::And(mask, hn::Or(tests.depth, hn::Not(tests.stencil)));
  return mask;
}

// New stencil values in the low eight bits of `stored`, and only there.
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

// Alpha, stencil and depth test of the fragments of `mask`; what then stands in the planes, and which fragments passed.
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

// Window depths as codes of the target, see WindowDepth::code.
template <class D>
HWY_INLINE hn::Vec<D> depth_codes(D d, const LanePass& pass, const SetupPrimitive& p, hn::Vec<D> z24) {
  const WindowDepth& depth = pass.context.depth;
  if (p.offset_z24 == 0 && depth.step_z24() == 1) return z24;
  const auto offset = hn::Set(d, p.offset_z24);  // within ±2^25
  const auto largest = hn::Set(d, static_cast<std::int32_t>(depth.max_z24()));
  const auto z = hn::Min(hn::Max(hn::Add(z24, offset), hn::Zero(d)), largest);
  const auto step = static_cast<std::int32_t>(depth.step_z24());
  return hn::ShiftRightSame(hn::Add(z, hn::Set(d, step >> 1)), depth.fraction_bits());
}

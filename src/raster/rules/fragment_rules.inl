// THE rules of coverage, weights of colours, depth codes, stencil operations and cube-map faces, written once. No
// include guard: one_fragment.h includes it for one fragment, fragment_vector-inl.h for a vector of fragments on every
// SIMD target.
//
// The includer provides the macro NINEBIT_RULE (the functions' attributes). Each rule takes a value domain `o`, which
// has these members:
//
//   V, F, FM      types: 32-bit integers, floats, truth values
//   V set(int); F set(float)
//   V or F add, sub; V min_of, max_of, shift_left, shift_right, bits_and, bits_or
//   V bits_and_not(V x, V y)                       y without the bits of x
//   F mul, div, negated, abs_of, floor_of
//   FM less, equal, greater_equal, less_equal, all, any
//   FM without(FM x, FM y)                         y and not x
//   F select(FM choice, F yes, F no)
//   V number_where(FM choice, int yes, V no)
//   V or F where(FM choice, V or F yes)            else 0

// The top-left rule (rule 21): negative for a left edge, which goes down, and for a top edge, which is level and goes
// to the left. A centre on such an edge is inside; one on another edge is outside. |dx| is less than 2^kEdgeBits.
inline constexpr int kEdgeBits = 14;
template <class O>
NINEBIT_RULE typename O::V top_left_sign(const O& o, typename O::V dx, typename O::V dy) {
  return o.add(o.shift_left(dy, kEdgeBits), dx);
}

// A share cut to 256ths (rule 27).
template <class O>
NINEBIT_RULE typename O::F eight_bit_share(const O& o, typename O::F share) {
  return o.mul(o.floor_of(o.mul(share, o.set(256.0F))), o.set(1.0F / 256.0F));
}

// The weight of a vertex beside two weights of eight bits.
template <class O>
NINEBIT_RULE typename O::F remaining_weight(const O& o, typename O::F one, typename O::F other) {
  return o.sub(o.sub(o.set(1.0F), one), other);
}

// The depth code that is compared and stored: z24 + offset, clamped to [0, largest], without its fraction bits: `half`
// of them is added first, which rounds, or nothing, which cuts (rule 28). |offset| is at most 2^25.
template <class O>
NINEBIT_RULE typename O::V depth_code(const O& o, typename O::V z24, typename O::V offset_z24,
                                      typename O::V largest_z24, int fraction_bits, int half) {
  const auto z = o.min_of(o.max_of(o.add(z24, offset_z24), o.set(0)), largest_z24);
  return o.shift_right(o.add(z, o.set(half)), fraction_bits);
}

// The stencil value after an operation; both values are at most `largest`, which is 2^bits - 1. Nothing is masked.
template <class O>
NINEBIT_RULE typename O::V stencil_result(const O& o, StencilOperation operation, typename O::V stored,
                                          typename O::V reference, typename O::V largest) {
  switch (operation) {
    case StencilOperation::keep:
      return stored;
    case StencilOperation::zero:
      return o.set(0);
    case StencilOperation::replace:
      return reference;
    case StencilOperation::incr:
      return o.min_of(o.add(stored, o.set(1)), largest);
    case StencilOperation::decr:
      return o.max_of(o.sub(stored, o.set(1)), o.set(0));
    case StencilOperation::invert:
      return o.bits_and_not(stored, largest);
    case StencilOperation::incr_wrap:
      return o.bits_and(o.add(stored, o.set(1)), largest);
    case StencilOperation::decr_wrap:
      return o.bits_and(o.sub(stored, o.set(1)), largest);
  }
  return stored;
}

// The write mask: bits that it has not keep their stored value.
template <class O>
NINEBIT_RULE typename O::V write_masked(const O& o, typename O::V stored, typename O::V result,
                                        typename O::V writable) {
  return o.bits_or(o.bits_and(result, writable), o.bits_and_not(writable, stored));
}

// A colour as a surface stores it (rule 43): cut to the bits that its format has, which repeat below. Words have red in
// the lowest byte.
template <class O>
NINEBIT_RULE typename O::V stored_color(const O& o, typename O::V color, const ColorMasks& masks) {
  const auto mask = [&o](std::uint32_t bits) { return o.set(static_cast<int>(bits)); };
  const auto kept = o.bits_and(color, mask(masks.kept));
  const auto repeated = o.bits_or(o.bits_or(o.bits_and(o.shift_right(color, 5), mask(masks.low_of_5)),
                                            o.bits_and(o.shift_right(color, 6), mask(masks.low_of_6))),
                                  o.bits_and(o.shift_right(color, 7), mask(masks.low_of_7)));
  return o.bits_or(o.bits_or(kept, repeated), mask(masks.set));
}

// Where a direction meets the cube; see cube_coordinate.
template <class O>
struct CubePlace {
  typename O::V face;  // a CubeFace
  typename O::F s, t;
};

// The major-axis table of ARB_texture_cube_map. On ties x wins over y and y over z; a zero counts as positive. The zero
// direction, as NaN, is the first place of +X (rule 41).
template <class O>
NINEBIT_RULE CubePlace<O> cube_place(const O& o, typename O::F rx, typename O::F ry, typename O::F rz) {
  const auto zero = o.set(0.0F), half = o.set(0.5F), one = o.set(1.0F);
  const auto ax = o.abs_of(rx), ay = o.abs_of(ry), az = o.abs_of(rz);
  const auto not_x = o.any(o.less(ax, ay), o.less(ax, az));
  const auto is_z = o.all(not_x, o.less(ay, az));
  const auto is_y = o.without(is_z, not_x);
  const auto major = o.select(is_z, rz, o.select(is_y, ry, rx));
  const auto ma = o.abs_of(major);
  const auto negative = o.less(major, zero);
  // sc and tc are components, negated on some faces.
  const auto sc_positive = o.select(not_x, rx, o.negated(rz));
  const auto sc = o.select(o.without(is_y, negative), o.negated(sc_positive), sc_positive);
  const auto tc_positive = o.select(is_y, rz, o.negated(ry));
  const auto tc = o.select(o.all(is_y, negative), o.negated(tc_positive), tc_positive);
  const auto s = o.mul(o.add(o.div(sc, ma), one), half);
  const auto t = o.mul(o.add(o.div(tc, ma), one), half);
  // Infinity over infinity, or 0 over 0, is NaN, which fails both comparisons.
  const auto s_is_on_face = o.all(o.greater_equal(s, zero), o.less_equal(s, one));
  const auto t_is_on_face = o.all(o.greater_equal(t, zero), o.less_equal(t, one));
  const auto is_number = o.all(o.all(o.equal(rx, rx), o.equal(ry, ry)), o.equal(rz, rz));
  CubePlace<O> place;
  place.face = o.number_where(is_z, static_cast<int>(CubeFace::positive_z),
                              o.number_where(is_y, static_cast<int>(CubeFace::positive_y), o.set(0)));
  place.face = o.add(place.face, o.number_where(negative, 1, o.set(0)));
  place.face = o.where(is_number, place.face);
  place.s = o.where(o.all(is_number, s_is_on_face), s);
  place.t = o.where(o.all(is_number, t_is_on_face), t);
  return place;
}

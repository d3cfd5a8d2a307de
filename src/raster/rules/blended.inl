// Blending; see fragment_rules.inl. The numbers are from 0 to 65,535, so that 16 bits hold them.

// A component of both colours, and the values that its factors take: bytes, 255 being 1.0.
template <class O>
struct BlendComponent {
  typename O::V source, destination;
  typename O::V source_alpha, destination_alpha;
  typename O::V constant, constant_alpha;
  typename O::V alpha_bits;  // 255 if the component is alpha, else 0
};

template <class O>
NINEBIT_RULE typename O::V one_minus(const O& o, typename O::V byte) {
  return o.sub(o.set(255), byte);
}

template <class O>
NINEBIT_RULE typename O::V blend_factor(const O& o, BlendFactor factor, const BlendComponent<O>& c) {
  switch (factor) {
    case BlendFactor::zero:
      break;
    case BlendFactor::one:
      return o.set(255);
    case BlendFactor::src_color:
      return c.source;
    case BlendFactor::one_minus_src_color:
      return one_minus(o, c.source);
    case BlendFactor::dst_color:
      return c.destination;
    case BlendFactor::one_minus_dst_color:
      return one_minus(o, c.destination);
    case BlendFactor::src_alpha:
      return c.source_alpha;
    case BlendFactor::one_minus_src_alpha:
      return one_minus(o, c.source_alpha);
    case BlendFactor::dst_alpha:
      return c.destination_alpha;
    case BlendFactor::one_minus_dst_alpha:
      return one_minus(o, c.destination_alpha);
    case BlendFactor::constant_color:
      return c.constant;
    case BlendFactor::one_minus_constant_color:
      return one_minus(o, c.constant);
    case BlendFactor::constant_alpha:
      return c.constant_alpha;
    case BlendFactor::one_minus_constant_alpha:
      return one_minus(o, c.constant_alpha);
    case BlendFactor::src_alpha_saturate:
      return o.max_of(o.min_of(c.source_alpha, one_minus(o, c.destination_alpha)), c.alpha_bits);
  }
  return o.set(0);
}

// A byte from a number that is 256 larger, and may lie on either side of the bytes.
template <class O>
NINEBIT_RULE typename O::V clamped_byte(const O& o, typename O::V more) {
  return o.sub(o.min_of(o.max_of(more, o.set(256)), o.set(256 + 255)), o.set(256));
}

// The byte that replaces the destination's (rule 19): one sum of products, one rounding to nearest (255 is odd: there
// are no halves).
template <class O>
NINEBIT_RULE typename O::V blended(const O& o, const Blend& state, const BlendComponent<O>& c) {
  // The source as a signed byte, and 128 more.
  const auto biased = o.sub(o.add(c.source, o.set(128)), o.shift_left(o.bits_and(c.source, o.set(128)), 1));
  const auto source = o.mul(c.source, blend_factor(o, state.source, c));
  const auto destination = o.mul(c.destination, blend_factor(o, state.destination, c));
  auto sum = o.set(0);  // in units of 1/255²
  switch (state.equation) {
    case BlendEquation::min:
      return o.min_of(c.source, c.destination);
    case BlendEquation::max:
      return o.max_of(c.source, c.destination);
    case BlendEquation::add_signed:
      return clamped_byte(o, o.add(o.add(c.destination, biased), o.set(128)));
    case BlendEquation::reverse_subtract_signed:
      return clamped_byte(o, o.sub(o.add(c.destination, o.set(256 + 128)), biased));
    case BlendEquation::add:
      sum = o.min_of(o.saturated_sum(source, destination), o.set(255 * 255));
      break;
    case BlendEquation::subtract:
      sum = o.saturated_difference(source, destination);
      break;
    case BlendEquation::reverse_subtract:
      sum = o.saturated_difference(destination, source);
      break;
  }
  // x / 255 is (x + 1 + x / 256) / 256 below 65,535.
  const auto x = o.add(sum, o.set(127));
  return o.shift_right(o.add(o.add(x, o.set(1)), o.shift_right(x, 8)), 8);
}

// The weights of vertices' colours, of eight bits; see fragment_rules.inl.

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

template <class F>
struct VertexWeights {
  F first, second, third;
};

// The weights of a triangle's vertices, from two of their shares.
template <class O>
NINEBIT_RULE VertexWeights<typename O::F> eight_bit_weights(const O& o, typename O::F a, typename O::F c) {
  const auto first = eight_bit_share(o, a), third = eight_bit_share(o, c);
  return {first, remaining_weight(o, first, third), third};
}

// The same of a line, from all three shares. The vertex that is not an end of it has the share 0 (the first one that
// has); the line's ends follow it in order, which holds for the edges of polygons, too. Where clipping left no share at
// 0, as of a triangle.
template <class O>
NINEBIT_RULE VertexWeights<typename O::F> eight_bit_line_weights(const O& o, typename O::F a, typename O::F b,
                                                                 typename O::F c) {
  const auto zero = o.set(0.0F);
  const auto no_first = o.equal(a, zero), no_second = o.without(no_first, o.equal(b, zero));
  const auto no_third = o.without(o.any(no_first, no_second), o.equal(c, zero));
  const auto end = eight_bit_share(o, o.select(no_first, c, o.select(no_second, a, b)));
  const auto start = remaining_weight(o, end, zero);
  const VertexWeights<typename O::F> of = eight_bit_weights(o, a, c);
  return {o.select(no_first, zero, o.select(no_second, end, o.select(no_third, start, of.first))),
          o.select(no_first, start, o.select(no_second, zero, o.select(no_third, end, of.second))),
          o.select(no_first, end, o.select(no_second, start, o.select(no_third, zero, of.third)))};
}

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

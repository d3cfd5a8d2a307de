// From a depth to its code; see fragment_rules.inl.

// The depth code that is compared and stored: z24 + offset, clamped to [0, largest], without its fraction bits: `half`
// of them is added first, which rounds, or nothing, which cuts (rule 28). |offset| is at most 2^25.
template <class O>
NINEBIT_RULE typename O::V depth_code(const O& o, typename O::V z24, typename O::V offset_z24,
                                      typename O::V largest_z24, int fraction_bits, int half) {
  const auto z = o.min_of(o.max_of(o.add(z24, offset_z24), o.set(0)), largest_z24);
  return o.shift_right(o.add(z, o.set(half)), fraction_bits);
}

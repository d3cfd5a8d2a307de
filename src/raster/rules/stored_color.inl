// The colours of surfaces of fewer bits; see fragment_rules.inl.

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

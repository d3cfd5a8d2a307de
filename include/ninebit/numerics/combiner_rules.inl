// THE arithmetic of the register combiners, written once. No include guard: it is included once inside a constexpr
// namespace (the reference) and once where programs are emitted as text. Batches are compiled to other formulas, which
// take their mappings, ranges and constants from the reference and are tested against it.
//
// The includer provides the macro NINEBIT_RULE (the functions' attributes), the type V (an int, or an expression of
// ints) and these primitives:
//   V set(int); V add(V, V); V sub(V, V); V mul(V, V); V min_of(V, V); V max_of(V, V); V abs_of(V);
//   V divide(V n, int d)          n / d rounded down, for 0 <= n < 2^24, 1 <= d <= 510 and n / d < 2^13
//   V negate_where_negative(V sign, V x)      sign < 0 ? -x : x
//   V select_where_at_least(V v, V limit, V yes, V no)      v >= limit ? yes : no
//
// Rule numbers are those of docs/numerics.md.

// Rule 2 and the mapping table of NV_register_combiners: a register value to what the product sees, [-one, one].
NINEBIT_RULE V map_input(const Datapath& d, InputMapping mapping, V e) {
  const V positive = max_of(e, set(0));
  // clang-format off
  switch (mapping) {
    case InputMapping::unsigned_identity: return positive;
    case InputMapping::unsigned_invert: return sub(set(d.one), min_of(positive, set(d.one)));
    case InputMapping::expand_normal: return sub(add(positive, positive), set(d.expand_offset));
    case InputMapping::expand_negate: return sub(set(d.expand_offset), add(positive, positive));
    case InputMapping::half_bias_normal: return sub(positive, set(d.half));
    case InputMapping::half_bias_negate: return sub(set(d.half), positive);
    case InputMapping::signed_identity: return e;
    case InputMapping::signed_negate: return sub(set(0), e);
  }
  // clang-format on
  return e;
}

// n / divisor as a whole number, without a limit to the register range; |n / divisor| must not exceed `most`.
NINEBIT_RULE V narrow(Narrowing narrowing, V n, int divisor, int most) {
  if (narrowing == Narrowing::toward_zero) return negate_where_negative(n, divide(abs_of(n), divisor));
  // Halves up is a division rounded down; the shift by whole quotients keeps it among positive numbers.
  return sub(divide(add(n, set(divisor * most + divisor / 2)), divisor), set(most));
}

NINEBIT_RULE V clamp_to(V v, int low, int high) {
  return min_of(max_of(v, set(low)), set(high));
}

// Rules 3 and 4: an output's bias, in wide values (units of 1 / one²).
NINEBIT_RULE V add_bias(const Datapath& d, Bias bias, V wide) {
  return bias == Bias::by_negative_one_half ? sub(wide, set(d.half * d.one)) : wide;
}

// What narrow_before_scale leaves, and scale_output doubles, in a code: scaled values are divided by this.
NINEBIT_RULE int scaled_unit(const Datapath& d) {
  return d.narrowing_point == NarrowingPoint::before_scale ? 2 : 2 * d.one;
}

// Rule 7: the biased value itself or, if it is narrowed before it is scaled, a code.
NINEBIT_RULE V narrow_before_scale(const Datapath& d, V biased) {
  // Two dot products of three full products each, and the bias: the quotient stays below eight.
  return d.narrowing_point == NarrowingPoint::before_scale ? narrow(d.general_narrowing, biased, d.one, 8 * d.one)
                                                           : biased;
}

// Rules 5 and 6: what narrow_before_scale left, times the scale, doubled so that one half of it is a whole number.
NINEBIT_RULE V scale_output(Scale scale, V v) {
  const int twice_scale = scale == Scale::by_one_half ? 1 : scale == Scale::none ? 2 : scale == Scale::by_two ? 4 : 8;
  return mul(v, set(twice_scale));
}

// Rule 8: a scaled value as a whole code, without a limit to the register range; its size must not exceed `most`.
NINEBIT_RULE V narrow_output(const Datapath& d, V scaled, int most) {
  return narrow(d.general_narrowing, scaled, scaled_unit(d), most);
}

NINEBIT_RULE V clamp_output(const Datapath& d, V code) {
  return clamp_to(code, d.lowest, d.one);
}

// Rules 3 to 8: what a general combiner writes for a wide value: (wide + bias) × scale, narrowed, clamped to
// [lowest, one].
NINEBIT_RULE V combiner_output(const Datapath& d, Scale scale, Bias bias, V wide) {
  const V scaled = scale_output(scale, narrow_before_scale(d, add_bias(d, bias, wide)));
  // This clamp comes first only to keep the quotient small: it cuts nothing that the last one would not.
  const int most = d.one + 1, limit = scaled_unit(d) * most;
  return clamp_output(d, narrow_output(d, clamp_to(scaled, -limit, limit), most));
}

// Rule 11: CD where spare0's alpha is at least one half or, by its lowest bit, odd without its negative part; else AB.
// AB and CD are wide values.
NINEBIT_RULE V mux(const Datapath& d, bool by_lowest_bit, V spare0_alpha, V ab, V cd) {
  if (!by_lowest_bit) return select_where_at_least(spare0_alpha, set(d.half), cd, ab);
  const V positive = max_of(spare0_alpha, set(0));
  return select_where_at_least(sub(positive, mul(divide(positive, 2), set(2))), set(1), cd, ab);
}

// Rule 13: what a register gives to the colour sum; `inverted`: 1 - x.
NINEBIT_RULE V color_sum_part(const Datapath& d, bool inverted, V v) {
  return inverted ? map_input(d, InputMapping::unsigned_invert, v) : v;
}

// Rule 13: spare0 + secondary, each without its negative part; up to 2.0 without the clamp.
NINEBIT_RULE V color_sum(const Datapath& d, bool clamp, V spare0, V secondary) {
  const V sum = add(max_of(spare0, set(0)), max_of(secondary, set(0)));
  return clamp ? min_of(sum, set(d.one)) : sum;
}

// Rule 10: E·F of two mapped inputs in [0, one].
NINEBIT_RULE V e_times_f(const Datapath& d, V e, V f) {
  return narrow(d.final_narrowing, mul(e, f), d.one, d.one);
}

// The part of A·B + (1 - A)·C that C has, a wide value.
NINEBIT_RULE V one_minus_a_times_c(const Datapath& d, V a, V c) {
  return mul(sub(set(d.one), a), c);
}

// Rule 9: A·B + (1 - A)·C as a whole code in [0, 2 one].
NINEBIT_RULE V narrow_mix(const Datapath& d, V mix) {
  return narrow(d.final_narrowing, mix, d.one, 2 * d.one);
}

// Rule 14.
NINEBIT_RULE V clamp_final(const Datapath& d, V v) {
  return clamp_to(v, 0, d.one);
}

// Rules 9 and 14: A·B + (1 - A)·C narrowed, D added, clamped to [0, one]. A in [0, one], the others in [0, 2 one].
NINEBIT_RULE V final_rgb(const Datapath& d, V a, V b, V c, V added) {
  return clamp_final(d, add(narrow_mix(d, add(mul(a, b), one_minus_a_times_c(d, a, c))), added));
}

// Rule 14: G.
NINEBIT_RULE V final_alpha(const Datapath& d, V g) {
  return clamp_final(d, g);
}

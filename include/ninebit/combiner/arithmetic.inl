// The arithmetic of the register combiners, defined once: input mappings, general combiner output, mux, final combiner.
// Rule numbers are those of docs/numerics.md. The order of the steps is in portion_walk.h.
//
// This file has no include guard. Four files include it, each in a namespace of its own:
//   include/ninebit/combiner/evaluate.h     V is int, functions are constexpr: the reference
//   src/language/emit/emit_program.cpp      V is an expression: the text of emitted C and GLSL
//   src/language/emit/emit_pixel.cpp        the same, of vectors: GLSL and HLSL by stages
//   src/study/datapath/sum_kernels.cpp      V is a vector of 32-bit lanes, once for each of Highway's SIMD targets
// Batches do not include it: src/combiner/batch_compiler.cpp compiles them to other formulas, reads mappings, ranges
// and constants off the reference, and is tested against it.
//
// The includer defines the macro NINEBIT_RULE (the attributes of all functions), the type V and these primitives:
//   V set(int); V add(V, V); V sub(V, V); V mul(V, V); V min_of(V, V); V max_of(V, V); V abs_of(V);
//   V divide(V n, int d)          n / d rounded down, for 0 <= n < 2^24, 1 <= d <= 510 and n / d < 2^13
//   V negate_where_negative(V sign, V x)      sign < 0 ? -x : x
//   V select_where_at_least(V v, V limit, V yes, V no)      v >= limit ? yes : no

// ---- Input mappings -------------------------------------------------------------------------------------------------

// Rule 2 and the mapping table of NV_register_combiners: maps a register code to a factor of a product, in [-one, one].
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

// ---- Narrowing, of both combiners -----------------------------------------------------------------------------------

// Returns n / divisor as a whole number, not limited to the register range. |n / divisor| must not exceed `most`.
NINEBIT_RULE V narrow(Narrowing narrowing, V n, int divisor, int most) {
  if (narrowing == Narrowing::toward_zero) return negate_where_negative(n, divide(abs_of(n), divisor));
  // Halves up is a division rounded down. Adding `most` whole quotients first keeps the dividend positive.
  return sub(divide(add(n, set(divisor * most + divisor / 2)), divisor), set(most));
}

NINEBIT_RULE V clamp_to(V v, int low, int high) {
  return min_of(max_of(v, set(low)), set(high));
}

// ---- General combiner output ----------------------------------------------------------------------------------------

// Rules 3 and 4: adds an output's bias to a wide value (units of 1 / one²).
NINEBIT_RULE V add_bias(const Datapath& d, Bias bias, V wide) {
  return bias == Bias::by_negative_one_half ? sub(wide, set(d.half * d.one)) : wide;
}

// The divisor that makes a code of a value from scale_output, which doubles its results.
NINEBIT_RULE int scaled_unit(const Datapath& d) {
  return d.narrowing_point == NarrowingPoint::before_scale ? 2 : 2 * d.one;
}

// Rule 7: returns the biased value or, in profiles that narrow before the scale, the code that it narrows to.
NINEBIT_RULE V narrow_before_scale(const Datapath& d, V biased) {
  // Two dot products of three full products each, and the bias: the quotient stays below eight.
  return d.narrowing_point == NarrowingPoint::before_scale ? narrow(d.general_narrowing, biased, d.one, 8 * d.one)
                                                           : biased;
}

// Rules 5 and 6: returns twice the result of narrow_before_scale times the scale. Doubled, because the scale of one
// half must give a whole number.
NINEBIT_RULE V scale_output(Scale scale, V v) {
  const int twice_scale = scale == Scale::by_one_half ? 1 : scale == Scale::none ? 2 : scale == Scale::by_two ? 4 : 8;
  return mul(v, set(twice_scale));
}

// Rule 8: narrows a value from scale_output to a code, not limited to the register range. The code's magnitude must not
// exceed `most`.
NINEBIT_RULE V narrow_output(const Datapath& d, V scaled, int most) {
  return narrow(d.general_narrowing, scaled, scaled_unit(d), most);
}

// Clamps a code to the range of outputs, [lowest_output, one].
NINEBIT_RULE V clamp_output(const Datapath& d, V code) {
  return clamp_to(code, d.lowest_output, d.one);
}

// Rules 3 to 8 and 22: returns the code that a general combiner writes for a wide value: (wide + bias) × scale,
// narrowed and clamped to [lowest_output, one].
NINEBIT_RULE V combiner_output(const Datapath& d, Scale scale, Bias bias, V wide) {
  const V scaled = scale_output(scale, narrow_before_scale(d, add_bias(d, bias, wide)));
  // The first clamp only keeps the quotient small. The last clamp would cut the same values.
  const int most = d.one + 1, limit = scaled_unit(d) * most;
  return clamp_output(d, narrow_output(d, clamp_to(scaled, -limit, limit), most));
}

// ---- Mux ------------------------------------------------------------------------------------------------------------

// Rule 11: chooses between the wide values AB and CD. By threshold: CD if spare0's alpha is at least one half, else AB.
// By lowest bit: CD if max(0, spare0's alpha) is odd, else AB.
NINEBIT_RULE V mux(const Datapath& d, bool by_lowest_bit, V spare0_alpha, V ab, V cd) {
  if (!by_lowest_bit) return select_where_at_least(spare0_alpha, set(d.half), cd, ab);
  const V positive = max_of(spare0_alpha, set(0));
  return select_where_at_least(sub(positive, mul(divide(positive, 2), set(2))), set(1), cd, ab);
}

// ---- Final combiner -------------------------------------------------------------------------------------------------

// Rule 13: returns a register's part of the colour sum: its code or, if `inverted`, one - max(0, code).
NINEBIT_RULE V color_sum_part(const Datapath& d, bool inverted, V v) {
  return inverted ? map_input(d, InputMapping::unsigned_invert, v) : v;
}

// Rule 13: returns max(0, spare0) + max(0, secondary), clamped to `one` if `clamp`; up to 2 one without the clamp.
NINEBIT_RULE V color_sum(const Datapath& d, bool clamp, V spare0, V secondary) {
  const V sum = add(max_of(spare0, set(0)), max_of(secondary, set(0)));
  return clamp ? min_of(sum, set(d.one)) : sum;
}

// Rule 10: returns E·F, a code, for two mapped inputs in [0, one].
NINEBIT_RULE V e_times_f(const Datapath& d, V e, V f) {
  return narrow(d.final_narrowing, mul(e, f), d.one, d.one);
}

// Returns (1 - A)·C, a wide value.
NINEBIT_RULE V one_minus_a_times_c(const Datapath& d, V a, V c) {
  return mul(sub(set(d.one), a), c);
}

// Rule 9: narrows A·B + (1 - A)·C to a code in [0, 2 one].
NINEBIT_RULE V narrow_mix(const Datapath& d, V mix) {
  return narrow(d.final_narrowing, mix, d.one, 2 * d.one);
}

// Rule 14: clamps a code to [0, one].
NINEBIT_RULE V clamp_final(const Datapath& d, V v) {
  return clamp_to(v, 0, d.one);
}

// Rules 9 and 14: narrows A·B + (1 - A)·C, adds D, clamps to [0, one]. A is in [0, one], the others are in [0, 2 one].
NINEBIT_RULE V final_rgb(const Datapath& d, V a, V b, V c, V added) {
  return clamp_final(d, add(narrow_mix(d, add(mul(a, b), one_minus_a_times_c(d, a, c))), added));
}

// Rule 14: returns G clamped to [0, one], the alpha of the result.
NINEBIT_RULE V final_alpha(const Datapath& d, V g) {
  return clamp_final(d, g);
}

// The arithmetic of the combiners with one rule broken. All other rules are those of combiner/arithmetic.inl.
#pragma once

#include "ninebit/combiner/evaluate.h"
#include "src/study/vectors/vector_mistakes.h"

namespace ninebit::vectors {

using reference::V;

// A mapping that does not clamp negative codes: the line through what it gives for 0 and for 1.
constexpr V map_unclamped(const Datapath& d, InputMapping mapping, V e) {
  const V at_0 = reference::map_input(d, mapping, 0);
  return e >= 0 ? reference::map_input(d, mapping, e) : at_0 + (reference::map_input(d, mapping, 1) - at_0) * e;
}

// Registers that are not clamped hold what fits 12 bits, so that their products fit 32.
inline constexpr V kMostUnclamped = 2047;

// The value domain (portion_walk.h) of a mistake.
class MistakenCodes {
 public:
  using Input = V;
  using Wide = V;
  using Output = V;

  constexpr MistakenCodes(const Datapath& d, BrokenRule broken, const ProgramStage& stage, RegisterFile& registers)
      : d_(d), broken_(broken), stage_(stage), registers_(registers), right_(d, stage, registers) {}

  constexpr V input(const CombinerInput& in, int component) const {
    if (broken_ == BrokenRule::half_exact) return twice(in, component);
    return broken_ == BrokenRule::negative_inputs ? map_unclamped(d_, in.mapping, fetched(in, component))
                                                  : right_.input(in, component);
  }
  constexpr V product(V x, V y) const {
    const V wide = right_.product(x, y);
    if (broken_ == BrokenRule::products_shifted) return wide >> 8;
    if (broken_ != BrokenRule::products_narrowed) return wide;
    return reference::narrow(d_.general_narrowing, wide, d_.one, 2 * d_.one) * d_.one;
  }
  constexpr V sum(V x, V y) const {
    const V wide = right_.sum(x, y);
    return broken_ == BrokenRule::sums_clamped ? reference::clamp_to(wide, -d_.one * d_.one, d_.one * d_.one) : wide;
  }
  constexpr V mux(V ab, V cd) const {
    if (broken_ == BrokenRule::mux_above_half) {
      Datapath above = d_;
      ++above.half;
      return reference::CodeDomain(above, stage_, registers_).mux(ab, cd);
    }
    return broken_ == BrokenRule::mux_swapped ? right_.mux(cd, ab) : right_.mux(ab, cd);
  }
  constexpr V output(const detail::Target& target, V wide) const {
    const PortionOutput& out = target.out;
    switch (broken_) {
      case BrokenRule::outputs_from_zero:
        return reference::max_of(right_.output(target, wide), 0);
      case BrokenRule::outputs_unclamped:
        return reference::clamp_to(narrowed(scaled(out, wide)), -kMostUnclamped, kMostUnclamped);
      case BrokenRule::bias_after_scale: {
        // scale_output doubles, so the bias is added twice.
        const V doubled = reference::scale_output(out.scale, wide);
        return clamped(reference::add_bias(d_, out.bias, reference::add_bias(d_, out.bias, doubled)));
      }
      case BrokenRule::rounded_down:
        // To the nearest code, of half a unit less.
        return reference::clamp_output(d_, nearest(scaled(out, wide) - reference::scaled_unit(d_) / 2));
      case BrokenRule::halves_from_zero: {
        const V n = scaled(out, wide);
        return reference::clamp_output(d_, reference::negate_where_negative(n, nearest(reference::abs_of(n))));
      }
      case BrokenRule::half_exact: {
        // Inputs are doubled, so that half a code is whole: wide values are four times what they are.
        const V bias = out.bias == Bias::none ? 0 : 2 * d_.one * d_.one;
        return reference::clamp_output(
            d_, reference::narrow(d_.general_narrowing, reference::scale_output(out.scale, wide - bias), 8 * d_.one,
                                  kMostCodes));
      }
      case BrokenRule::shifted:
      case BrokenRule::shifted_bias_255: {
        const V unit = broken_ == BrokenRule::shifted ? d_.one + 1 : d_.one;
        const V bias = out.bias == Bias::none ? 0 : d_.half * unit;
        return reference::clamp_output(d_, floor_of(reference::scale_output(out.scale, wide - bias), 2 * (d_.one + 1)));
      }
      case BrokenRule::sums_shifted:
      case BrokenRule::products_shifted: {
        const V code = broken_ == BrokenRule::sums_shifted ? wide >> 8 : wide;
        const V bias = out.bias == Bias::none ? 0 : d_.half;
        return reference::clamp_output(d_, reference::scale_output(out.scale, code - bias) >> 1);
      }
      default:
        return right_.output(target, wide);
    }
  }
  constexpr void write(Register to, int component, V code) { right_.write(to, component, code); }

 private:
  // Wide values of unclamped registers, times the scale, stay below this many codes.
  static constexpr int kMostCodes = 400'000;

  [[nodiscard]] constexpr V fetched(const CombinerInput& in, int component) const {
    return reference::fetch(registers_, in.reg, component, stage_.constant0, stage_.constant1);
  }
  // Twice a mapped input with a half of one / 2: the expanding mappings, 2x - one, are twice the half-bias mappings.
  [[nodiscard]] constexpr V twice(const CombinerInput& in, int component) const {
    Datapath expanding = d_;
    expanding.expand_offset = d_.one;
    const V code = fetched(in, component);
    if (in.mapping == InputMapping::half_bias_normal) {
      return reference::map_input(expanding, InputMapping::expand_normal, code);
    }
    if (in.mapping == InputMapping::half_bias_negate) {
      return reference::map_input(expanding, InputMapping::expand_negate, code);
    }
    return 2 * reference::map_input(d_, in.mapping, code);
  }
  [[nodiscard]] constexpr V scaled(const PortionOutput& out, V wide) const {
    return reference::scale_output(out.scale,
                                   reference::narrow_before_scale(d_, reference::add_bias(d_, out.bias, wide)));
  }
  [[nodiscard]] constexpr V narrowed(V scaled) const { return reference::narrow_output(d_, scaled, kMostCodes); }
  [[nodiscard]] constexpr V clamped(V scaled) const { return reference::clamp_output(d_, narrowed(scaled)); }
  [[nodiscard]] constexpr V nearest(V scaled) const {
    return reference::narrow(Narrowing::nearest_halves_up, scaled, reference::scaled_unit(d_), kMostCodes);
  }
  [[nodiscard]] static constexpr V floor_of(V n, int divisor) {
    return reference::narrow(Narrowing::nearest_halves_up, n - divisor / 2, divisor, kMostCodes);
  }

  const Datapath d_;
  BrokenRule broken_;
  const ProgramStage& stage_;
  RegisterFile& registers_;
  reference::CodeDomain right_;
};

// The value domain (final_walk.h) of a mistake in the final combiner.
class MistakenFinal {
 public:
  using Input = V;
  using Code = V;
  static constexpr bool kEveryStep = false;

  constexpr MistakenFinal(const Program& program, BrokenRule broken, const RegisterFile& registers)
      : d_(program.datapath), broken_(broken), program_(program), registers_(registers), right_(program, registers) {}

  constexpr V input(const CombinerInput& in, int component) const {
    return map(in.mapping, reference::fetch(registers_, in.reg, component, program_.constant0, program_.constant1));
  }
  constexpr V map(InputMapping mapping, V e) const {
    return broken_ == BrokenRule::negative_inputs ? map_unclamped(d_, mapping, e) : right_.map(mapping, e);
  }
  constexpr V sum_part(bool inverted, Register r, int component) const {
    return inverted && broken_ == BrokenRule::negative_inputs
               ? map(InputMapping::unsigned_invert, registers_[r][static_cast<std::size_t>(component)])
               : right_.sum_part(inverted, r, component);
  }
  constexpr V sum(bool clamp, V spare0, V secondary) const {
    if (broken_ != BrokenRule::negative_inputs) return right_.sum(clamp, spare0, secondary);
    return clamp ? reference::min_of(spare0 + secondary, d_.one) : spare0 + secondary;
  }
  constexpr V product(V e, V f) const { return shifts() ? shift(e * f) : narrow(e * f); }
  constexpr V rgb(int, V a, V b, V c, V added) const {
    const V ab = a * b, rest = reference::one_minus_a_times_c(d_, a, c);
    if (broken_ == BrokenRule::products_shifted) return reference::clamp_final(d_, shift(ab) + shift(rest) + added);
    return reference::clamp_final(d_, (shifts() ? shift(ab + rest) : narrow(ab + rest)) + added);
  }
  constexpr V alpha(V g) const { return right_.alpha(g); }

 private:
  // Inputs that are not clamped reach ±2 and more: quotients stay below 16.
  [[nodiscard]] constexpr V narrow(V wide) const {
    return reference::narrow(d_.final_narrowing, wide, d_.one, 16 * d_.one);
  }
  [[nodiscard]] constexpr bool shifts() const {
    return broken_ == BrokenRule::shifted || broken_ == BrokenRule::shifted_bias_255 ||
           broken_ == BrokenRule::sums_shifted || broken_ == BrokenRule::products_shifted;
  }
  [[nodiscard]] static constexpr V shift(V wide) { return wide >> 8; }

  const Datapath& d_;
  BrokenRule broken_;
  const Program& program_;
  const RegisterFile& registers_;
  reference::FinalCodes right_;
};

}  // namespace ninebit::vectors

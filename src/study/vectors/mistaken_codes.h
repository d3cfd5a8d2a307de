// The arithmetic of the combiners with rules broken, in codes or, for models that compute in real numbers, without
// narrowing. It is written here a second time, in floating point, because mistakes are made together: any set of them
// is a model. Without a mistake it gives what combiner/arithmetic.inl gives:
// VectorModels.WithoutBrokenRulesIsTheReference.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <type_traits>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/fixed9.h"
#include "src/study/vectors/vector_mistakes.h"

namespace ninebit::vectors {

template <class T>
using NumberFile = std::array<std::array<T, 4>, kRegisterCount>;

// The rules that both combiners share. T is double for codes, whose wide values are whole numbers below 2^53, and float
// for fractions of 1.
template <class T>
class MistakenNumbers {
 public:
  MistakenNumbers(const Datapath& d, const BrokenRules& broken)
      : d_(d), broken_(broken), is_real_(d.arithmetic != Arithmetic::integer), one_(of_code(d.one)) {}

  // Whether a rule is broken. Rules are looked up only where that makes a difference, so that asked() are few.
  [[nodiscard]] bool has(BrokenRule rule) const {
    asked_[static_cast<std::size_t>(rule)] = true;
    return broken_[static_cast<std::size_t>(rule)];
  }
  // The rules that were looked up: others, broken or not, change nothing in what was computed.
  [[nodiscard]] const BrokenRules& asked() const { return asked_; }
  [[nodiscard]] bool is_real() const { return is_real_; }
  [[nodiscard]] T one() const { return one_; }
  [[nodiscard]] T half() const { return is_real_ || has(BrokenRule::half_exact) ? one_ / 2 : of_code(d_.half); }
  [[nodiscard]] const Datapath& datapath() const { return d_; }

  [[nodiscard]] T of_code(int code) const {
    if constexpr (std::is_same_v<T, float>) return static_cast<float>(code) / static_cast<float>(d_.one);
    return static_cast<T>(code);
  }
  // A number as a code that need not be whole.
  [[nodiscard]] double code_of(T x) const {
    return std::is_same_v<T, float> ? static_cast<double>(x) * d_.one : static_cast<double>(x);
  }

  // The byte of a colour in [0, one].
  [[nodiscard]] std::uint8_t byte_of(const HardwareProfile& profile, T color) const {
    const double rounded = std::floor(code_of(color) + 0.5);
    const auto cut = static_cast<double>(std::floor(color * (static_cast<T>(d_.one) / one_)));
    const double code = cut != rounded && has(BrokenRule::colors_cut) ? cut : rounded;
    // Unclamped floats can overflow to what is not a number.
    return code >= 0 ? to_byte(profile, static_cast<s9>(std::min(code, static_cast<double>(d_.one)))) : 0;
  }

  [[nodiscard]] T map(InputMapping mapping, T e) const {
    if (mapping == InputMapping::signed_identity) return e;
    if (mapping == InputMapping::signed_negate) return -e;
    const bool keeps = e < 0 && (has(BrokenRule::negative_inputs) ||
                                 (mapping != InputMapping::unsigned_identity && has(BrokenRule::signed_mappings)));
    const T positive = keeps ? e : std::max(e, T{0});
    const T expand = is_real_ ? one_ : of_code(d_.expand_offset);
    switch (mapping) {
      case InputMapping::unsigned_identity:
        return positive;
      case InputMapping::unsigned_invert:
        return one_ - (positive > one_ && !has(BrokenRule::invert_above_one) ? one_ : positive);
      case InputMapping::expand_normal:
        return 2 * positive - expand;
      case InputMapping::expand_negate:
        return expand - 2 * positive;
      case InputMapping::half_bias_normal:
        return positive - half();
      case InputMapping::half_bias_negate:
        return half() - positive;
      case InputMapping::signed_identity:
      case InputMapping::signed_negate:
        break;
    }
    return e;
  }
  // A register as an input.
  [[nodiscard]] T read(InputMapping mapping, T number) const {
    const bool clamps = mapping == InputMapping::unsigned_identity && number > one_ && has(BrokenRule::identity_to_one);
    return map(mapping, clamps ? one_ : number);
  }
  // n / divisor as a whole number.
  [[nodiscard]] static T narrow(Narrowing narrowing, T n, T divisor) {
    return narrowing == Narrowing::toward_zero ? std::trunc(n / divisor) : std::floor((n + divisor / 2) / divisor);
  }
  [[nodiscard]] static T shift(T wide) { return std::floor(wide / 256); }
  [[nodiscard]] bool shifts() const {
    return has(BrokenRule::shifted) || has(BrokenRule::shifted_bias_255) || has(BrokenRule::sums_shifted) ||
           has(BrokenRule::products_shifted);
  }

 private:
  Datapath d_;
  BrokenRules broken_;
  mutable BrokenRules asked_{};
  bool is_real_;
  T one_;
};

// The value domain (portion_walk.h) of the general combiners. Wide values are products of two numbers.
template <class T>
class MistakenGeneral {
 public:
  using Input = T;
  using Wide = T;
  using Output = T;

  MistakenGeneral(const MistakenNumbers<T>& numbers, const ProgramStage& stage, NumberFile<T>& registers)
      : n_(numbers), stage_(stage), registers_(registers) {}

  // C and D of a portion read other registers.
  void read_second(const Portion& portion, const NumberFile<T>& registers) {
    c_ = &portion.c;
    d_ = &portion.d;
    second_ = &registers;
  }

  // The same for a copy of that portion.
  void read_second_of(const Portion& copy) {
    if (second_ != nullptr) read_second(copy, *second_);
  }

  T input(const CombinerInput& in, int component) const {
    if (in.usage == ComponentUsage::blue && n_.has(BrokenRule::alpha_reads_red)) component = kRed;
    const bool is_second = &in == c_ || &in == d_;
    return n_.read(in.mapping, fetched(is_second ? *second_ : registers_, in.reg, static_cast<std::size_t>(component)));
  }
  T product(T x, T y) const {
    if (n_.is_real()) return x * y;
    if (n_.has(BrokenRule::products_shifted)) return n_.shift(x * y) * n_.one();
    if (!n_.has(BrokenRule::products_narrowed)) return x * y;
    return n_.narrow(n_.datapath().general_narrowing, x * y, n_.one()) * n_.one();
  }
  T sum(T x, T y) const {
    const T most = n_.one() * n_.one(), clamped = std::clamp(x + y, -most, most);
    return clamped != x + y && n_.has(BrokenRule::sums_clamped) ? clamped : x + y;
  }
  T mux(T ab, T cd) const {
    const T alpha = registers_[static_cast<std::size_t>(Register::spare0)][kAlpha];
    const T half = n_.is_real() ? n_.half() : n_.of_code(n_.datapath().half);
    const bool takes_cd = stage_.mux_by_lowest_bit
                              ? std::fmod(std::floor(n_.code_of(std::max(alpha, T{0})) + 0.5), 2.0) == 1.0
                          : n_.has(BrokenRule::mux_above_half) ? alpha > half
                                                               : alpha >= half;
    return takes_cd == n_.has(BrokenRule::mux_swapped) ? ab : cd;
  }
  T output(const detail::Target& target, T wide) const {
    const Datapath& d = n_.datapath();
    const PortionOutput& out = target.out;
    const T one = n_.one();
    const bool shifts = !n_.is_real() && (n_.has(BrokenRule::shifted) || n_.has(BrokenRule::shifted_bias_255));
    T bias = 0;
    if (out.bias != Bias::none) {
      bias = n_.half() * (shifts && n_.has(BrokenRule::shifted) ? one + 1 : one);
      if (target.k == 2 && !out.mux_sum && n_.has(BrokenRule::bias_of_products)) bias = 2 * bias;
    }
    if (!n_.is_real() && n_.has(BrokenRule::sums_shifted)) wide = n_.shift(wide) * one;
    const bool in_order = out.scale != Scale::none || d.narrowing_point == NarrowingPoint::before_scale;
    const bool after = bias != 0 && in_order && n_.has(BrokenRule::bias_after_scale);
    if (!after) wide -= bias;
    if (!n_.is_real() && !n_.shifts() && d.narrowing_point == NarrowingPoint::before_scale) {
      wide = n_.narrow(d.general_narrowing, wide, one) * one;
    }
    constexpr std::array kScales{T{1}, T{2}, T{4}, T{0.5}};
    const T scaled = wide * kScales[static_cast<std::size_t>(out.scale)] - (after ? bias : T{0});
    return clamped(target.k, shifts ? n_.shift(scaled) : narrowed(scaled));
  }
  void write(Register to, int component, T number) {
    registers_[static_cast<std::size_t>(to)][static_cast<std::size_t>(component)] = number;
  }

 private:
  [[nodiscard]] T fetched(const NumberFile<T>& registers, Register reg, std::size_t component) const {
    if (reg == Register::zero) return 0;
    if (reg == Register::constant0) return n_.of_code(stage_.constant0[component]);
    if (reg == Register::constant1) return n_.of_code(stage_.constant1[component]);
    return registers[static_cast<std::size_t>(reg)][component];
  }
  [[nodiscard]] T narrowed(T scaled) const {
    const T one = n_.one();
    if (n_.is_real()) return scaled / one;
    const bool down =
        n_.has(BrokenRule::rounded_down) || n_.has(BrokenRule::sums_shifted) || n_.has(BrokenRule::products_shifted);
    if (down) return std::floor(scaled / one);
    if (n_.has(BrokenRule::halves_from_zero)) {
      return std::copysign(n_.narrow(Narrowing::nearest_halves_up, std::abs(scaled), one), scaled);
    }
    return n_.narrow(n_.datapath().general_narrowing, scaled, one);
  }
  [[nodiscard]] T clamped(std::size_t k, T number) const {
    if (number >= 0 && number <= n_.one()) return number;
    const T lowest = number < 0 && n_.has(BrokenRule::outputs_from_zero) ? T{0}
                     : n_.is_real()                                      ? -n_.one()
                                                                         : n_.of_code(n_.datapath().lowest_output);
    const T clamped = std::clamp(number, lowest, n_.one());
    if (clamped == number) return number;
    constexpr T kMost{1e15F};  // keeps later products finite
    const bool is_free = n_.has(BrokenRule::outputs_unclamped) || (k == 2 && n_.has(BrokenRule::thirds_unclamped));
    return is_free ? std::clamp(number, -kMost, kMost) : clamped;
  }

  const MistakenNumbers<T>& n_;
  const ProgramStage& stage_;
  NumberFile<T>& registers_;
  const CombinerInput *c_ = nullptr, *d_ = nullptr;
  const NumberFile<T>* second_ = nullptr;
};

// The value domain (final_walk.h) of the final combiner.
template <class T>
class MistakenFinal {
 public:
  using Input = T;
  using Code = T;
  static constexpr bool kEveryStep = false;

  MistakenFinal(const MistakenNumbers<T>& numbers, const Program& program, const NumberFile<T>& registers)
      : n_(numbers), program_(program), registers_(registers) {}

  T input(const CombinerInput& in, int component) const {
    const bool reads_red = in.usage == ComponentUsage::blue && n_.has(BrokenRule::g_reads_red);
    const auto c = static_cast<std::size_t>(reads_red ? kRed : component);
    const T number = in.reg == Register::zero        ? T{0}
                     : in.reg == Register::constant0 ? n_.of_code(program_.constant0[c])
                     : in.reg == Register::constant1 ? n_.of_code(program_.constant1[c])
                                                     : registers_[static_cast<std::size_t>(in.reg)][c];
    return n_.read(in.mapping, number);
  }
  T map(InputMapping mapping, T e) const { return n_.map(mapping, e); }
  T sum_part(bool inverted, Register r, int component) const {
    const T number = registers_[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)];
    if (!inverted) return number;
    return number < 0 && !n_.has(BrokenRule::negative_inputs) ? n_.one()
                                                              : n_.map(InputMapping::unsigned_invert, number);
  }
  T sum(bool clamp, T spare0, T secondary) const {
    const bool negative =
        (spare0 < 0 || secondary < 0) && (n_.has(BrokenRule::negative_inputs) || n_.has(BrokenRule::sum_negative));
    const T total = negative ? spare0 + secondary : std::max(spare0, T{0}) + std::max(secondary, T{0});
    return clamp ? std::min(total, n_.one()) : total;
  }
  T product(T e, T f) const {
    if (n_.is_real() || n_.has(BrokenRule::e_times_f_exact)) return e * f / n_.one();
    return n_.shifts() ? n_.shift(e * f) : narrow(e * f);
  }
  T rgb(int, T a, T b, T c, T added) const { return clamped(mix(a * b, (n_.one() - a) * c) + added); }
  T alpha(T g) const { return clamped(g); }

 private:
  [[nodiscard]] T mix(T ab, T rest) const {
    if (ab == 0 && rest == 0) return T{0};
    if (n_.is_real() || n_.has(BrokenRule::mix_exact) || n_.has(BrokenRule::colors_cut)) return (ab + rest) / n_.one();
    if (n_.has(BrokenRule::products_shifted)) return n_.shift(ab) + n_.shift(rest);
    if (n_.shifts()) return n_.shift(ab + rest);
    return n_.has(BrokenRule::mix_of_narrowed) ? narrow(ab) + narrow(rest) : narrow(ab + rest);
  }
  [[nodiscard]] T narrow(T wide) const { return n_.narrow(n_.datapath().final_narrowing, wide, n_.one()); }
  [[nodiscard]] T clamped(T number) const { return std::clamp(number, T{0}, n_.one()); }

  const MistakenNumbers<T>& n_;
  const Program& program_;
  const NumberFile<T>& registers_;
};

}  // namespace ninebit::vectors

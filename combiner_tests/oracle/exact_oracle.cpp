#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdlib>

#include "combiner_tests/oracle/real_oracle.h"

namespace ninebit::oracle {
namespace {

__extension__ typedef unsigned __int128 TwoDigits;

void trim(Whole& x) {
  while (!x.digits.empty() && x.digits.back() == 0) x.digits.pop_back();
  if (x.digits.empty()) x.negative = false;
}

Whole negated(Whole x) {
  if (!x.digits.empty()) x.negative = !x.negative;
  return x;
}

bool smaller_magnitude(const Whole& x, const Whole& y) {
  if (x.digits.size() != y.digits.size()) return x.digits.size() < y.digits.size();
  for (std::size_t i = x.digits.size(); i > 0; --i) {
    if (x.digits[i - 1] != y.digits[i - 1]) return x.digits[i - 1] < y.digits[i - 1];
  }
  return false;
}

Whole power_of_two(int exponent) {
  Whole result;
  result.digits.assign_zeros(static_cast<std::size_t>(exponent / 64) + 1);
  result.digits.back() = std::uint64_t{1} << (exponent % 64);
  return result;
}

Whole larger(const Whole& x, const Whole& y) {
  return less(x, y) ? y : x;
}
Whole smaller(const Whole& x, const Whole& y) {
  return less(y, x) ? y : x;
}

using Numerators = std::array<std::array<Whole, 4>, kRegisterCount>;

int component_read(ComponentUsage usage, int channel) {
  return usage == ComponentUsage::rgb ? channel : usage == ComponentUsage::alpha ? 3 : 2;
}

// All that a stage can read, as numerators over `den`.
struct Bench {
  Numerators registers;
  Whole den, twice_den;
  Whole unit = 1;  // den / one: what a code counts
  Codes constant0{}, constant1{};

  [[nodiscard]] Whole read(const CombinerInput& in, int channel) const {
    const auto c = static_cast<std::size_t>(component_read(in.usage, channel));
    if (in.reg == Register::zero) return 0;
    if (in.reg == Register::constant0 || in.reg == Register::constant1) {
      return times(in.reg == Register::constant0 ? constant0[c] : constant1[c], unit);
    }
    return registers[static_cast<std::size_t>(in.reg)][c];
  }

  // The mapped input over 2 den.
  [[nodiscard]] Whole mapped(const CombinerInput& in, int channel) const {
    return mapped(in.mapping, read(in, channel));
  }
  [[nodiscard]] Whole mapped(InputMapping mapping, const Whole& e) const {
    if (mapping == InputMapping::signed_identity) return times(2, e);
    if (mapping == InputMapping::signed_negate) return times(-2, e);
    const Whole p = e.negative ? Whole() : times(2, e);
    switch (mapping) {
      case InputMapping::unsigned_identity:
        return p;
      case InputMapping::unsigned_invert:
        return minus(twice_den, smaller(p, twice_den));
      case InputMapping::expand_normal:
        return minus(times(2, p), twice_den);
      case InputMapping::expand_negate:
        return minus(twice_den, times(2, p));
      case InputMapping::half_bias_normal:
        return minus(p, den);
      case InputMapping::half_bias_negate:
        return minus(den, p);
      case InputMapping::signed_identity:
      case InputMapping::signed_negate:
        break;
    }
    return p;
  }
};

// (value + bias) · scale over 4 product_den, clamped; value over product_den.
Whole option(const PortionOutput& out, const Whole& value, const Whole& product_den) {
  // Four times as many quarters, and one half is two quarters.
  Whole biased = times(4, value);
  if (out.bias == Bias::by_negative_one_half) biased = minus(biased, times(2, product_den));
  const Whole most = times(4, product_den);
  if (out.scale == Scale::by_two) biased = times(2, biased);
  if (out.scale == Scale::by_four) biased = times(4, biased);
  if (out.scale == Scale::by_one_half) {
    biased = times(2, value);
    if (out.bias == Bias::by_negative_one_half) biased = minus(biased, product_den);
  }
  return smaller(larger(biased, negated(most)), most);
}

// spare0.alpha >= 1/2, or its nearest code odd
bool second_chosen(const HardwareProfile& profile, bool by_lowest_bit, const Bench& bench) {
  const Whole& alpha = bench.registers[static_cast<std::size_t>(Register::spare0)][3];
  if (!by_lowest_bit) return !less(times(2, alpha), bench.den);
  return nearest_code(profile, {larger(alpha, 0), bench.den}) % 2 != 0;
}

void run_stage(const GeneralCombiner& stage, bool cd_chosen, Bench& bench) {
  const Whole product_den = times(bench.twice_den, bench.twice_den);
  const Whole growth = times(16, bench.den);  // (4 product_den) / den
  Numerators after = bench.registers;
  for (auto& reg : after) {
    for (Whole& n : reg) n = times(n, growth);
  }
  const auto portion = [&](const Portion& p, int first, int channels) {
    std::array<Whole, 3> ab, cd;
    for (int c = 0; c < channels; ++c) {
      const auto i = static_cast<std::size_t>(c);
      ab[i] = times(bench.mapped(p.a, first + c), bench.mapped(p.b, first + c));
      cd[i] = times(bench.mapped(p.c, first + c), bench.mapped(p.d, first + c));
    }
    if (p.out.ab_dot_product) ab.fill(plus(plus(ab[0], ab[1]), ab[2]));
    if (p.out.cd_dot_product) cd.fill(plus(plus(cd[0], cd[1]), cd[2]));
    for (int c = 0; c < channels; ++c) {
      const auto i = static_cast<std::size_t>(c);
      const auto put = [&](Register to, const Whole& value) {
        if (to == Register::discard) return;
        after[static_cast<std::size_t>(to)][static_cast<std::size_t>(first + c)] = option(p.out, value, product_den);
      };
      put(p.out.ab, ab[i]);
      put(p.out.cd, cd[i]);
      put(p.out.sum, !p.out.mux_sum ? plus(ab[i], cd[i]) : cd_chosen ? cd[i] : ab[i]);
    }
  };
  portion(stage.rgb, 0, 3);
  const auto raise_blue = [&](bool asked, Register reg) {
    if (!asked || reg == Register::discard) return;
    auto& written = after[static_cast<std::size_t>(reg)];
    written[3] = written[2];
  };
  raise_blue(stage.rgb.out.ab_blue_to_alpha, stage.rgb.out.ab);
  raise_blue(stage.rgb.out.cd_blue_to_alpha, stage.rgb.out.cd);
  portion(stage.alpha, 3, 1);
  bench.registers = after;
  bench.unit = times(bench.unit, growth);
  bench.den = times(bench.den, growth);
  bench.twice_den = times(2, bench.den);
}

Codes codes_of(const HardwareProfile& profile, const ColorF& color) {
  Codes codes{};
  for (std::size_t i = 0; i < 4; ++i) codes[i] = constant_code(profile, color[i]);
  return codes;
}

}  // namespace

Whole::Whole(int n) : negative(n < 0) {
  if (n != 0) digits.push_back(static_cast<std::uint64_t>(std::abs(std::int64_t{n})));
}

Whole plus(const Whole& x, const Whole& y) {
  if (y.digits.empty()) return x;
  if (x.negative != y.negative) return minus(x, negated(y));
  Whole result;
  result.negative = x.negative;
  TwoDigits carry = 0;
  for (std::size_t i = 0; i < x.digits.size() || i < y.digits.size() || carry != 0; ++i) {
    if (i < x.digits.size()) carry += x.digits[i];
    if (i < y.digits.size()) carry += y.digits[i];
    result.digits.push_back(static_cast<std::uint64_t>(carry));
    carry >>= 64;
  }
  return result;
}

Whole minus(const Whole& x, const Whole& y) {
  if (y.digits.empty()) return x;
  if (x.negative != y.negative) return plus(x, negated(y));
  if (smaller_magnitude(x, y)) return negated(minus(y, x));
  Whole result = x;
  std::uint64_t borrow = 0;
  for (std::size_t i = 0; i < x.digits.size(); ++i) {
    const TwoDigits taken = TwoDigits{i < y.digits.size() ? y.digits[i] : 0} + borrow;
    borrow = x.digits[i] < taken ? 1 : 0;
    result.digits[i] -= static_cast<std::uint64_t>(taken);
  }
  trim(result);
  return result;
}

Whole times(const Whole& x, const Whole& y) {
  Whole result;
  result.negative = x.negative != y.negative;
  result.digits.assign_zeros(x.digits.size() + y.digits.size());
  const std::uint64_t *const a = x.digits.begin(), *const b = y.digits.begin();
  std::uint64_t* const to = result.digits.data();
  const std::size_t length = y.digits.size();
  for (std::size_t i = 0; i < x.digits.size(); ++i) {
    std::uint64_t carry = 0;
    for (std::size_t j = 0; j < length; ++j) {
      const TwoDigits sum = TwoDigits{a[i]} * b[j] + to[i + j] + carry;
      to[i + j] = static_cast<std::uint64_t>(sum);
      carry = static_cast<std::uint64_t>(sum >> 64);
    }
    to[i + length] = carry;
  }
  trim(result);
  return result;
}

Whole times(int n, const Whole& x) {
  Whole result;
  if (n == 0 || x.digits.empty()) return result;
  result.negative = x.negative != (n < 0);
  result.digits.assign_zeros(x.digits.size() + 1);
  std::uint64_t* to = result.digits.data();
  const auto factor = static_cast<std::uint64_t>(std::abs(std::int64_t{n}));
  std::uint64_t carry = 0;
  for (const std::uint64_t digit : x.digits) {
    const TwoDigits product = TwoDigits{digit} * factor + carry;
    *to++ = static_cast<std::uint64_t>(product);
    carry = static_cast<std::uint64_t>(product >> 64);
  }
  *to = carry;
  trim(result);
  return result;
}

bool less(const Whole& x, const Whole& y) {
  if (x.negative != y.negative) return x.negative;
  return x.negative ? smaller_magnitude(y, x) : smaller_magnitude(x, y);
}

int nearest_code(const HardwareProfile& profile, const Ratio& x) {
  // The largest code c with (2c - 1) / (2 one) <= x.
  const Whole numerator = times(2 * profile.one, x.num);
  int low = -2 * profile.one - 1, high = 2 * profile.one + 1;
  while (high - low > 1) {
    const int middle = (low + high) / 2 - (low + high < 0 && (low + high) % 2 != 0 ? 1 : 0);
    (less(numerator, times(2 * middle - 1, x.den)) ? high : low) = middle;
  }
  return low;
}

bool is_nearest_double(const Ratio& x, double d) {
  if (d == 0.0) return x.num.digits.empty();  // what is tested here is never that small
  if ((d < 0) != x.num.negative) return false;
  int exponent = 0;
  const auto mantissa = static_cast<std::int64_t>(std::ldexp(std::frexp(std::fabs(d), &exponent), 53));
  exponent -= 53;
  // |x| against k / 4 · 2^exponent: -1, 0 or 1.
  const auto compared = [&](std::int64_t k) {
    const Whole scaled = plus(times(static_cast<int>(k >> 30), power_of_two(30)), static_cast<int>(k & 0x3FFFFFFF));
    Whole left = x.num, right = times(scaled, x.den);
    left.negative = false;
    if (exponent - 2 >= 0) right = times(right, power_of_two(exponent - 2));
    if (exponent - 2 < 0) left = times(left, power_of_two(2 - exponent));
    return less(left, right) ? -1 : less(right, left) ? 1 : 0;
  };
  const bool at_power = mantissa == std::int64_t{1} << 52;
  const int below = compared(4 * mantissa - (at_power ? 1 : 2)), above = compared(4 * mantissa + 2);
  const bool even = mantissa % 2 == 0;
  return (below > 0 || (below == 0 && even)) && (above < 0 || (above == 0 && even));
}

ExactOutcome run_exact(const CombinerState& state, const HardwareProfile& profile, const Registers& initial) {
  const Codes global0 = codes_of(profile, state.constant0), global1 = codes_of(profile, state.constant1);
  Bench bench;
  bench.den = profile.one.value;
  bench.twice_den = 2 * profile.one.value;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) bench.registers[r][c] = initial[r][c];
  }
  for (int i = 0; i < state.num_general_combiners; ++i) {
    const GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    bench.constant0 = state.per_stage_constants ? codes_of(profile, stage.constant0) : global0;
    bench.constant1 = state.per_stage_constants ? codes_of(profile, stage.constant1) : global1;
    run_stage(stage, second_chosen(profile, state.mux_by_lowest_bit, bench), bench);
  }
  bench.constant0 = global0;
  bench.constant1 = global1;

  // The final combiner, whose inputs are numerators over square = (2 den)².
  const FinalCombiner& f = state.final_combiner;
  const Whole twice = times(2, bench.den), square = times(twice, twice);
  std::array<Whole, 3> product, sum;
  for (std::size_t c = 0; c < 3; ++c) {
    product[c] = times(bench.mapped(f.e, static_cast<int>(c)), bench.mapped(f.f, static_cast<int>(c)));
    const auto summand = [&](Register reg, bool from_one) {
      const Whole positive = larger(bench.registers[static_cast<std::size_t>(reg)][c], 0);
      return from_one ? minus(bench.den, positive) : positive;
    };
    sum[c] = plus(summand(Register::spare0, state.color_sum_invert_spare0),
                  summand(Register::secondary, state.color_sum_invert_secondary));
    if (state.color_sum_clamp) sum[c] = smaller(sum[c], bench.den);
  }
  const auto value = [&](const CombinerInput& in, int channel) {
    const auto c = static_cast<std::size_t>(channel);
    if (in.reg == Register::e_times_f) {
      return in.mapping == InputMapping::unsigned_invert ? minus(square, smaller(product[c], square)) : product[c];
    }
    const bool is_sum = in.reg == Register::spare0_plus_secondary;
    return times(is_sum ? bench.mapped(in.mapping, sum[c]) : bench.mapped(in, channel), twice);
  };
  ExactOutcome outcome;
  const Whole fourth = times(square, square);
  for (int channel = 0; channel < 3; ++channel) {
    const Whole a = value(f.a, channel);
    const Whole mixed = plus(times(a, value(f.b, channel)), times(minus(square, a), value(f.c, channel)));
    const Whole total = plus(mixed, times(value(f.d, channel), square));
    outcome.color[static_cast<std::size_t>(channel)] = {smaller(larger(total, 0), fourth), fourth};
  }
  outcome.color[3] = {smaller(larger(value(f.g, 3), 0), square), square};
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) outcome.registers[r][c] = {bench.registers[r][c], bench.den};
  }
  return outcome;
}

}  // namespace ninebit::oracle

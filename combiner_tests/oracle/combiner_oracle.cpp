#include "combiner_tests/oracle/combiner_oracle.h"

#include <cstddef>

namespace ninebit::oracle {
namespace {

using Color = std::array<Fraction, 3>;

Fraction whole(int n) {
  return {n, 1};
}

std::int64_t floor_of(Fraction x) {
  const std::int64_t quotient = x.num / x.den;
  return x.num % x.den < 0 ? quotient - 1 : quotient;
}

Fraction larger(Fraction x, Fraction y) {
  return less(x, y) ? y : x;
}

Fraction smaller(Fraction x, Fraction y) {
  return less(y, x) ? y : x;
}

// The whole number that a narrowing makes of x.
std::int64_t narrowed(Narrowing narrowing, Fraction x) {
  if (narrowing == Narrowing::nearest_halves_up) return floor_of(plus(x, {1, 2}));
  const bool negative = less(x, whole(0));
  const std::int64_t magnitude = floor_of(negative ? minus(whole(0), x) : x);
  return negative ? -magnitude : magnitude;
}

int channel_read(ComponentUsage usage, int channel) {
  if (usage == ComponentUsage::alpha) return 3;
  if (usage == ComponentUsage::blue) return 2;
  return channel;
}

// The inputs of a stage or of the final combiner: registers, with the constants that hold there.
struct View {
  const HardwareProfile& profile;
  const Registers& registers;
  Codes constant0;
  Codes constant1;
  Color e_times_f{};
  Color color_sum{};

  [[nodiscard]] Fraction input(const CombinerInput& in, int channel) const {
    const auto component = static_cast<std::size_t>(channel_read(in.usage, channel));
    return mapped(profile, in.mapping, content(in.reg, component));
  }

  [[nodiscard]] Fraction content(Register reg, std::size_t component) const {
    if (reg == Register::zero) return whole(0);
    if (reg == Register::constant0) return real(profile, constant0[component]);
    if (reg == Register::constant1) return real(profile, constant1[component]);
    if (reg == Register::e_times_f) return component < 3 ? e_times_f[component] : whole(0);
    if (reg == Register::spare0_plus_secondary) return component < 3 ? color_sum[component] : whole(0);
    return real(profile, registers[static_cast<std::size_t>(reg)][component]);
  }
};

struct Products {
  std::array<Fraction, 4> ab;
  std::array<Fraction, 4> cd;
};

// One of A·B and C·D of the RGB portion, componentwise or as a dot product in all three components.
void multiply_rgb(const View& view, const CombinerInput& x, const CombinerInput& y, bool dot,
                  std::array<Fraction, 4>& product) {
  for (int channel = 0; channel < 3; ++channel) {
    product[static_cast<std::size_t>(channel)] = times(view.input(x, channel), view.input(y, channel));
  }
  if (!dot) return;
  const Fraction sum = plus(plus(product[0], product[1]), product[2]);
  product[0] = product[1] = product[2] = sum;
}

// The mux reads the alpha that spare0 has when the stage begins: its highest bit, which is that it reaches one half, or
// the lowest of its bits as they are without a negative part.
bool picks_second(const View& view, bool by_lowest_bit) {
  const Fraction select = view.content(Register::spare0, 3);
  if (!by_lowest_bit) return !less(select, real(view.profile, view.profile.half));
  const std::int64_t code = floor_of(times(larger(select, whole(0)), whole(view.profile.one)));
  return (code & 1) != 0;
}

void write(const View& view, const PortionOutput& out, std::size_t component, bool picks_cd, Fraction ab, Fraction cd,
           Registers& after) {
  const Fraction third = !out.mux_sum ? plus(ab, cd) : picks_cd ? cd : ab;
  const auto assign = [&](Register to, Fraction value) {
    if (to == Register::discard) return;
    after[static_cast<std::size_t>(to)][component] = general_output(view.profile, out.scale, out.bias, value);
  };
  assign(out.ab, ab);
  assign(out.cd, cd);
  assign(out.sum, third);
}

Codes constant_codes(const HardwareProfile& profile, const ColorF& color) {
  Codes codes{};
  for (std::size_t i = 0; i < 4; ++i) codes[i] = constant_code(profile, color[i]);
  return codes;
}

}  // namespace

Fraction plus(Fraction x, Fraction y) {
  if (x.den == y.den) return {x.num + y.num, x.den};
  if (x.den % y.den == 0) return {x.num + y.num * (x.den / y.den), x.den};
  if (y.den % x.den == 0) return {x.num * (y.den / x.den) + y.num, y.den};
  return {x.num * y.den + y.num * x.den, x.den * y.den};
}

Fraction minus(Fraction x, Fraction y) {
  return plus(x, {-y.num, y.den});
}

Fraction times(Fraction x, Fraction y) {
  return {x.num * y.num, x.den * y.den};
}

bool less(Fraction x, Fraction y) {
  return x.num * y.den < y.num * x.den;
}

Fraction real(const HardwareProfile& profile, int code) {
  return {code, profile.one};
}

Fraction mapped(const HardwareProfile& profile, InputMapping mapping, Fraction e) {
  const Fraction positive = larger(whole(0), e);
  const Fraction half = real(profile, profile.half);
  const Fraction expanded = minus(times(whole(2), positive), real(profile, profile.expand_offset));
  switch (mapping) {
    case InputMapping::unsigned_identity:
      return positive;
    case InputMapping::unsigned_invert:
      return minus(whole(1), smaller(positive, whole(1)));
    case InputMapping::expand_normal:
      return expanded;
    case InputMapping::expand_negate:
      return minus(whole(0), expanded);
    case InputMapping::half_bias_normal:
      return minus(positive, half);
    case InputMapping::half_bias_negate:
      return minus(half, positive);
    case InputMapping::signed_identity:
      return e;
    case InputMapping::signed_negate:
      return minus(whole(0), e);
  }
  return e;
}

int general_output(const HardwareProfile& profile, Scale scale, Bias bias, Fraction value) {
  if (bias == Bias::by_negative_one_half) value = minus(value, real(profile, profile.half));
  Fraction codes = times(value, whole(profile.one));
  if (profile.narrowing_point.value == NarrowingPoint::before_scale) {
    codes = {narrowed(profile.general_narrowing, codes), 1};
  }
  if (scale == Scale::by_two) codes = times(codes, whole(2));
  if (scale == Scale::by_four) codes = times(codes, whole(4));
  if (scale == Scale::by_one_half) codes = times(codes, {1, 2});
  const std::int64_t code = narrowed(profile.general_narrowing, codes);
  if (code > profile.one) return profile.one;
  if (code < profile.lowest_output) return profile.lowest_output;
  return static_cast<int>(code);
}

int constant_code(const HardwareProfile& profile, float component) {
  // The byte nearest to 255 · component: the number of half steps (2n - 1) / 510 that the component reaches.
  int reached = 0, not_reached = 256;
  while (not_reached - reached > 1) {
    const int n = (reached + not_reached) / 2;
    (static_cast<double>(component) * 510.0 >= 2.0 * n - 1.0 ? reached : not_reached) = n;
  }
  int kept = reached;
  for (int i = 0; i < profile.byte_shift; ++i) kept /= 2;
  return kept;
}

Outcome run(const CombinerState& state, const HardwareProfile& profile, const Registers& initial) {
  const Codes global0 = constant_codes(profile, state.constant0);
  const Codes global1 = constant_codes(profile, state.constant1);

  Registers current = initial;
  for (int i = 0; i < state.num_general_combiners; ++i) {
    const GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    const View view{profile, current, state.per_stage_constants ? constant_codes(profile, stage.constant0) : global0,
                    state.per_stage_constants ? constant_codes(profile, stage.constant1) : global1};
    Products p;
    multiply_rgb(view, stage.rgb.a, stage.rgb.b, stage.rgb.out.ab_dot_product, p.ab);
    multiply_rgb(view, stage.rgb.c, stage.rgb.d, stage.rgb.out.cd_dot_product, p.cd);
    p.ab[3] = times(view.input(stage.alpha.a, 3), view.input(stage.alpha.b, 3));
    p.cd[3] = times(view.input(stage.alpha.c, 3), view.input(stage.alpha.d, 3));
    Registers after = current;
    // The blue that an RGB portion also writes to an alpha comes first: what the alpha portion writes there stays.
    const PortionOutput& rgb = stage.rgb.out;
    const auto blue_to_alpha = [&](bool asked, Register to, Fraction blue) {
      if (!asked || to == Register::discard) return;
      after[static_cast<std::size_t>(to)][3] = general_output(profile, rgb.scale, rgb.bias, blue);
    };
    blue_to_alpha(rgb.ab_blue_to_alpha, rgb.ab, p.ab[2]);
    blue_to_alpha(rgb.cd_blue_to_alpha, rgb.cd, p.cd[2]);
    for (std::size_t component = 0; component < 4; ++component) {
      const PortionOutput& out = component == 3 ? stage.alpha.out : stage.rgb.out;
      write(view, out, component, picks_second(view, state.mux_by_lowest_bit), p.ab[component], p.cd[component], after);
    }
    current = after;
  }

  Outcome outcome{current, {}};
  View view{profile, current, global0, global1};
  const FinalCombiner& f = state.final_combiner;
  for (int channel = 0; channel < 3; ++channel) {
    const auto c = static_cast<std::size_t>(channel);
    const Fraction product = times(view.input(f.e, channel), view.input(f.f, channel));
    const std::int64_t ef = narrowed(profile.final_narrowing, times(product, whole(profile.one)));
    view.e_times_f[c] = real(profile, static_cast<int>(ef));
    const auto summand = [&](Register reg, bool from_one) {
      const Fraction positive = larger(whole(0), view.content(reg, c));
      return from_one ? minus(whole(1), positive) : positive;
    };
    const Fraction sum = plus(summand(Register::spare0, state.color_sum_invert_spare0),
                              summand(Register::secondary, state.color_sum_invert_secondary));
    view.color_sum[c] = state.color_sum_clamp ? smaller(sum, whole(1)) : sum;
  }
  for (int channel = 0; channel < 3; ++channel) {
    const Fraction a = view.input(f.a, channel);
    const Fraction mixed =
        plus(times(a, view.input(f.b, channel)), times(minus(whole(1), a), view.input(f.c, channel)));
    const std::int64_t mixed_code = narrowed(profile.final_narrowing, times(mixed, whole(profile.one)));
    const Fraction added = times(view.input(f.d, channel), whole(profile.one));
    // D is a whole number of codes already.
    const std::int64_t total = mixed_code + floor_of(added);
    outcome.color[static_cast<std::size_t>(channel)] = static_cast<int>(total < 0             ? 0
                                                                        : total > profile.one ? profile.one.value
                                                                                              : total);
  }
  const std::int64_t g = floor_of(times(view.input(f.g, 3), whole(profile.one)));
  outcome.color[3] = static_cast<int>(g < 0 ? 0 : g > profile.one ? profile.one.value : g);
  return outcome;
}

}  // namespace ninebit::oracle

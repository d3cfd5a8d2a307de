#include <cmath>
#include <cstddef>

#include "combiner_tests/oracle/real_oracle.h"

namespace ninebit::oracle {
namespace {

// A float whose operations are done in double and rounded.
struct Single {
  double value = 0;
  Single() = default;
  Single(double exact) : value(static_cast<double>(static_cast<float>(exact))) {}
  friend Single operator+(Single x, Single y) { return x.value + y.value; }
  friend Single operator-(Single x, Single y) { return x.value - y.value; }
  friend Single operator*(Single x, Single y) { return x.value * y.value; }
};

Single limited(Single x, double low, double high) {
  return std::fmin(std::fmax(x.value, low), high);
}

using Color = std::array<Single, 4>;
using File = std::array<Color, kRegisterCount>;

Single mapped(InputMapping mapping, Single e) {
  const Single p = e.value > 0 ? e : Single(0);
  switch (mapping) {
    case InputMapping::unsigned_identity:
      return p;
    case InputMapping::unsigned_invert:
      return Single(1) - limited(p, 0, 1);
    case InputMapping::expand_normal:
      return Single(2) * p - Single(1);
    case InputMapping::expand_negate:
      return Single(1) - Single(2) * p;
    case InputMapping::half_bias_normal:
      return p - Single(0.5);
    case InputMapping::half_bias_negate:
      return Single(0.5) - p;
    case InputMapping::signed_identity:
      return e;
    case InputMapping::signed_negate:
      return Single(0) - e;
  }
  return p;
}

Color color_of(const HardwareProfile& profile, const ColorF& color) {
  Color result;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = static_cast<double>(constant_code(profile, color[i])) / profile.one;
  }
  return result;
}

Single option(const PortionOutput& out, Single value) {
  if (out.bias == Bias::by_negative_one_half) value = value - Single(0.5);
  constexpr std::array kFactor{1.0, 2.0, 4.0, 0.5};
  return limited(value * Single(kFactor[static_cast<std::size_t>(out.scale)]), -1, 1);
}

// The four components of all that the final combiner and the stages read.
struct Reader {
  const File& file;
  Color constant0, constant1;
  Color product{}, sum{};

  [[nodiscard]] Single operator()(const CombinerInput& in, std::size_t channel) const {
    const std::size_t c = in.usage == ComponentUsage::alpha ? 3 : in.usage == ComponentUsage::blue ? 2 : channel;
    switch (in.reg) {
      case Register::zero:
        return mapped(in.mapping, 0);
      case Register::constant0:
        return mapped(in.mapping, constant0[c]);
      case Register::constant1:
        return mapped(in.mapping, constant1[c]);
      case Register::e_times_f:
        return mapped(in.mapping, product[c]);
      case Register::spare0_plus_secondary:
        return mapped(in.mapping, sum[c]);
      default:
        return mapped(in.mapping, file[static_cast<std::size_t>(in.reg)][c]);
    }
  }
};

}  // namespace

FloatOutcome run_float(const CombinerState& state, const HardwareProfile& profile, const Registers& initial) {
  File file;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) file[r][c] = static_cast<double>(initial[r][c]) / profile.one;
  }
  const Color global0 = color_of(profile, state.constant0), global1 = color_of(profile, state.constant1);
  for (int s = 0; s < state.num_general_combiners; ++s) {
    const GeneralCombiner& stage = state.general[static_cast<std::size_t>(s)];
    const File before = file;
    const Reader read{before, state.per_stage_constants ? color_of(profile, stage.constant0) : global0,
                      state.per_stage_constants ? color_of(profile, stage.constant1) : global1};
    const double select = before[static_cast<std::size_t>(Register::spare0)][3].value;
    const int select_code = static_cast<int>(std::floor(std::fmax(select, 0) * profile.one + 0.5));
    const bool cd_chosen = state.mux_by_lowest_bit ? select_code % 2 != 0 : select >= 0.5;
    for (std::size_t c = 0; c < 4; ++c) {
      const Portion& p = c < 3 ? stage.rgb : stage.alpha;
      const auto product = [&](const CombinerInput& x, const CombinerInput& y, bool dot) {
        if (!dot) return read(x, c) * read(y, c);
        return read(x, 0) * read(y, 0) + read(x, 1) * read(y, 1) + read(x, 2) * read(y, 2);
      };
      const Single ab = product(p.a, p.b, p.out.ab_dot_product), cd = product(p.c, p.d, p.out.cd_dot_product);
      const Single third = !p.out.mux_sum ? ab + cd : cd_chosen ? cd : ab;
      if (p.out.ab != Register::discard) file[static_cast<std::size_t>(p.out.ab)][c] = option(p.out, ab);
      if (p.out.cd != Register::discard) file[static_cast<std::size_t>(p.out.cd)][c] = option(p.out, cd);
      if (p.out.sum != Register::discard) file[static_cast<std::size_t>(p.out.sum)][c] = option(p.out, third);
      // After blue comes alpha, whose portion has the last word.
      if (c != 2) continue;
      if (p.out.ab_blue_to_alpha && p.out.ab != Register::discard) {
        file[static_cast<std::size_t>(p.out.ab)][3] = option(p.out, ab);
      }
      if (p.out.cd_blue_to_alpha && p.out.cd != Register::discard) {
        file[static_cast<std::size_t>(p.out.cd)][3] = option(p.out, cd);
      }
    }
  }
  const FinalCombiner& f = state.final_combiner;
  Reader read{file, global0, global1};
  FloatOutcome outcome{};
  for (std::size_t c = 0; c < 3; ++c) {
    read.product[c] = read(f.e, c) * read(f.f, c);
    const auto spare0 = static_cast<std::size_t>(Register::spare0);
    const auto secondary = static_cast<std::size_t>(Register::secondary);
    const auto summand = [&](std::size_t reg, bool from_one) {
      const Single positive = limited(file[reg][c], 0, 1);
      return from_one ? Single(1) - positive : positive;
    };
    read.sum[c] = summand(spare0, state.color_sum_invert_spare0) + summand(secondary, state.color_sum_invert_secondary);
    if (state.color_sum_clamp) read.sum[c] = limited(read.sum[c], 0, 1);
  }
  for (std::size_t c = 0; c < 3; ++c) {
    const Single a = read(f.a, c);
    const Single rgb = a * read(f.b, c) + (Single(1) - a) * read(f.c, c) + read(f.d, c);
    outcome.color[c] = static_cast<float>(limited(rgb, 0, 1).value);
  }
  outcome.color[3] = static_cast<float>(limited(read(f.g, 3), 0, 1).value);
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) outcome.registers[r][c] = static_cast<float>(file[r][c].value);
  }
  return outcome;
}

Outcome run_real(const CombinerState& state, const HardwareProfile& profile, const Registers& initial) {
  Outcome outcome{initial, {}};
  const auto not_read = [](std::size_t r) { return r <= static_cast<std::size_t>(Register::constant1); };
  if (profile.arithmetic.value == Arithmetic::exact) {
    const ExactOutcome exact = run_exact(state, profile, initial);
    for (std::size_t c = 0; c < 4; ++c) {
      outcome.color[c] = nearest_code(profile, exact.color[c]);
      for (std::size_t r = 0; r < kRegisterCount; ++r) {
        if (!not_read(r)) outcome.registers[r][c] = nearest_code(profile, exact.registers[r][c]);
      }
    }
    return outcome;
  }
  const auto code = [&](float x) { return static_cast<int>(std::floor(static_cast<double>(x) * profile.one + 0.5)); };
  const FloatOutcome floats = run_float(state, profile, initial);
  for (std::size_t c = 0; c < 4; ++c) {
    outcome.color[c] = code(floats.color[c]);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      if (!not_read(r)) outcome.registers[r][c] = code(floats.registers[r][c]);
    }
  }
  return outcome;
}

}  // namespace ninebit::oracle

// The final combiner of a trace.
#include <algorithm>
#include <utility>

#include "src/combiner/trace_values.h"

namespace ninebit {
namespace {

class FinalTracer {
 public:
  FinalTracer(const Program& program, const TracedRegisters& before, const RealEvaluation& real,
              const RealEvaluation& ideal)
      : program_(program),
        d_(program.datapath),
        f_(program.final_combiner),
        values_(program.datapath),
        before_(before),
        real_(real.final_combiner),
        ideal_(ideal.final_combiner),
        real_color_(real.color),
        ideal_color_(ideal.color) {}

  TracedFinal run() const {
    TracedFinal result;
    for (const CombinerInput* in : {&f_.a, &f_.b, &f_.c, &f_.d, &f_.g}) {
      result.uses_e_times_f = result.uses_e_times_f || in->reg == Register::e_times_f;
      result.uses_color_sum = result.uses_color_sum || in->reg == Register::spare0_plus_secondary;
    }
    for (std::size_t c = 0; c < 3; ++c) {
      special_registers(c, result.rgb[c]);
    }
    for (std::size_t c = 0; c < 3; ++c) mix(c, result.rgb);
    result.g = input(f_.g, kAlpha, result.rgb, real_.g, ideal_.g);
    const int g = result.g.mapped.code, alpha = values_.integer() ? reference::final_alpha(d_, g) : 0;
    result.alpha = values_.code(alpha, real_color_[kAlpha], ideal_color_[kAlpha]);
    result.alpha_cut =
        values_.known_code(g - result.alpha.code, real_.g - real_color_[kAlpha], ideal_.g - ideal_color_[kAlpha]);
    return result;
  }

 private:
  using Channels = std::array<TracedFinalChannel, 3>;

  // E·F and spare0 + secondary.
  void special_registers(std::size_t c, TracedFinalChannel& to) const {
    const auto channel = static_cast<int>(c);
    to.input[4] = input(f_.e, channel, {}, real_.input[4][c], ideal_.input[4][c]);
    to.input[5] = input(f_.f, channel, {}, real_.input[5][c], ideal_.input[5][c]);
    const TracedCode &e = to.input[4].mapped, &f = to.input[5].mapped;
    const int exact = reference::mul(e.code, f.code);
    const int narrowed = values_.integer() ? reference::e_times_f(d_, e.code, f.code) : 0;
    to.e_times_f_product = values_.wide(exact, real_.e_times_f[c], ideal_.e_times_f[c]);
    to.e_times_f_dropped = values_.wide(exact - d_.one * narrowed, 0, 0);
    to.e_times_f = values_.code(narrowed, real_.e_times_f[c], ideal_.e_times_f[c]);

    const auto sum = [&](bool clamp) {
      const auto part = [&](bool inverted, Register r) {
        return reference::color_sum_part(d_, inverted, before_.codes[r][c]);
      };
      return reference::color_sum(d_, clamp, part(program_.color_sum_invert_spare0, Register::spare0),
                                  part(program_.color_sum_invert_secondary, Register::secondary));
    };
    const auto part = [&](const RealRegisters& r, Register reg, bool inverted, const auto& sub) {
      const double x = std::max(r[reg][c], 0.0);
      return inverted ? sub(1.0, x) : x;
    };
    const auto parts = [&](const RealRegisters& r, const auto& sub) {
      return std::pair(part(r, Register::spare0, program_.color_sum_invert_spare0, sub),
                       part(r, Register::secondary, program_.color_sum_invert_secondary, sub));
    };
    const auto [spare0, secondary] = parts(before_.real, [&](double x, double y) { return values_.sub(x, y); });
    const auto [ideal_spare0, ideal_secondary] = parts(before_.ideal, [](double x, double y) { return x - y; });
    to.color_sum_unclamped = values_.code(sum(false), values_.add(spare0, secondary), ideal_spare0 + ideal_secondary);
    to.color_sum = values_.code(sum(program_.color_sum_clamp), real_.color_sum[c], ideal_.color_sum[c]);
  }

  // A·B + (1 - A)·C + D.
  void mix(std::size_t c, Channels& rgb) const {
    TracedFinalChannel& to = rgb[c];
    const std::array<const CombinerInput*, 4> from{&f_.a, &f_.b, &f_.c, &f_.d};
    for (std::size_t v = 0; v < 4; ++v) {
      to.input[v] = input(*from[v], static_cast<int>(c), rgb, real_.input[v][c], ideal_.input[v][c]);
    }
    const TracedCode &a = to.input[0].mapped, &b = to.input[1].mapped, &third = to.input[2].mapped,
                     &added = to.input[3].mapped;
    const int ab = reference::mul(a.code, b.code), rest = reference::one_minus_a_times_c(d_, a.code, third.code);
    const int mixed = reference::add(ab, rest);
    const int narrowed = values_.integer() ? reference::narrow_mix(d_, mixed) : 0;
    const int sum = reference::add(narrowed, added.code);
    const double real_ab = values_.mul(a.real, b.real);
    const double real_rest = values_.mul(values_.sub(1.0, a.real), third.real);
    const double real_mix = values_.add(real_ab, real_rest);
    const double ideal_ab = a.ideal * b.ideal, ideal_rest = (1.0 - a.ideal) * third.ideal;
    const double ideal_mix = ideal_ab + ideal_rest;
    to.a_times_b = values_.wide(ab, real_ab, ideal_ab);
    to.one_minus_a_times_c = values_.wide(rest, real_rest, ideal_rest);
    to.mix = values_.wide(mixed, real_mix, ideal_mix);
    to.dropped = values_.wide(mixed - d_.one * narrowed, 0, 0);
    to.narrowed = values_.code(narrowed, real_mix, ideal_mix);
    to.sum = values_.code(sum, real_.unclamped[c], ideal_.unclamped[c]);
    to.written = values_.code(values_.integer() ? reference::clamp_final(d_, sum) : 0, real_color_[c], ideal_color_[c]);
    to.cut = values_.known_code(to.sum.code - to.written.code, real_.unclamped[c] - real_color_[c],
                                ideal_.unclamped[c] - ideal_color_[c]);
  }

  TracedInput input(const CombinerInput& in, int channel, const Channels& rgb, double real, double ideal) const {
    const int component = reference::component_of(in.usage, channel);
    TracedInput result{.from = in, .component = component, .read = read(in.reg, component, rgb), .mapped = {}};
    const int mapped = values_.integer() ? reference::map_input(d_, in.mapping, result.read.code) : 0;
    result.mapped = values_.code(mapped, real, ideal);
    return result;
  }

  TracedCode read(Register reg, int component, const Channels& rgb) const {
    const auto i = static_cast<std::size_t>(component);
    if (reg == Register::e_times_f) return rgb[i].e_times_f;
    if (reg == Register::spare0_plus_secondary) return rgb[i].color_sum;
    const int code = reference::fetch(before_.codes, reg, component, program_.constant0, program_.constant1);
    if (reg == Register::zero || reg == Register::constant0 || reg == Register::constant1) {
      return values_.known_code(code, values_.real_of_code(code), values_.ideal_of_code(code));
    }
    return values_.known_code(code, before_.real[reg][i], before_.ideal[reg][i]);
  }

  const Program& program_;
  const Datapath& d_;
  const FinalCombiner& f_;
  TraceValues values_;
  const TracedRegisters& before_;
  const RealFinal &real_, &ideal_;
  const RealColor &real_color_, &ideal_color_;
};

}  // namespace

TracedFinal trace_final(const Program& program, const TracedRegisters& before, const RealEvaluation& real,
                        const RealEvaluation& ideal) {
  return FinalTracer(program, before, real, ideal).run();
}

}  // namespace ninebit

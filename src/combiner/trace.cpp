#include "ninebit/combiner/trace.h"

#include <span>

#include "ninebit/combiner/portion_walk.h"
#include "ninebit/numerics/fixed9.h"
#include "src/combiner/trace_values.h"

namespace ninebit {
namespace {

// The largest magnitude of an output before its clamp, in codes: six products below two each, the bias, a scale of
// four.
int most_output(const Datapath& d) {
  return 64 * d.one;
}

// The value domain of a trace (portion_walk.h): codes as in the reference, with every step of an output kept.
class OutputSteps {
 public:
  using Input = int;
  using Wide = int;
  struct Output {
    int biased = 0;
    int early = 0;  // `biased` or, in profiles that narrow before they scale, the code that it narrows to
    int narrowed = 0;
    int written = 0;
  };

  OutputSteps(const Datapath& d, const ProgramStage& stage, RegisterFile& registers)
      : d_(d), codes_(d, stage, registers) {}

  int input(const CombinerInput& in, int component) const { return codes_.input(in, component); }
  int product(int x, int y) const { return codes_.product(x, y); }
  int sum(int x, int y) const { return codes_.sum(x, y); }
  int mux(int ab, int cd) const { return codes_.mux(ab, cd); }
  Output output(const detail::Target& target, int wide) const {
    Output to;
    to.biased = reference::add_bias(d_, target.out.bias, wide);
    to.early = reference::narrow_before_scale(d_, to.biased);
    to.narrowed = reference::narrow_output(d_, reference::scale_output(target.out.scale, to.early), most_output(d_));
    to.written = reference::clamp_output(d_, to.narrowed);
    return to;
  }
  void write(Register to, int component, const Output& value) { codes_.write(to, component, value.written); }

 private:
  const Datapath& d_;
  reference::CodeDomain codes_;
};

// Puts the three ways of each value of a stage together: codes, real numbers, exact numbers. Without integer arithmetic
// the codes of `steps` are not read.
class StageTracer {
 public:
  using Steps = detail::StageSteps<OutputSteps>;

  StageTracer(const Datapath& d, const ProgramStage& stage, const TracedRegisters& before, const Steps& steps)
      : d_(d), values_(d), stage_(stage), before_(before), steps_(steps) {}

  TracedPortion portion(const Portion& state, int first, std::size_t channels, std::span<const RealChannel> real,
                        std::span<const RealChannel> ideal) const {
    const PortionOutput& out = state.out;
    TracedPortion result{.state = state, .channel = {}};
    if (!is_live(out)) return result;
    result.uses_ab = out.ab != Register::discard || out.sum != Register::discard;
    result.uses_cd = out.cd != Register::discard || out.sum != Register::discard;
    for (std::size_t c = 0; c < channels; ++c) {
      TracedChannel& to = result.channel.emplace_back();
      to.component = first + static_cast<int>(c);
      const auto& codes = steps_[static_cast<std::size_t>(to.component)];
      const std::array<const CombinerInput*, 4> from{&state.a, &state.b, &state.c, &state.d};
      for (std::size_t v = 0; v < 4; ++v) {
        to.input[v] = input(*from[v], static_cast<int>(c), codes.input[v], real[c].input[v], ideal[c].input[v]);
      }
      to.ab_product = product(to.input[0].mapped, to.input[1].mapped);
      to.cd_product = product(to.input[2].mapped, to.input[3].mapped);
      to.ab = values_.wide(codes.wide[0], real[c].ab.wide, ideal[c].ab.wide);
      to.cd = values_.wide(codes.wide[1], real[c].cd.wide, ideal[c].cd.wide);
      const auto output_of = [&](std::size_t k, const RealOutput& real_output, const RealOutput& ideal_output) {
        return output(out, codes.wide[k], codes.output[k], real_output, ideal_output);
      };
      if (out.ab != Register::discard) to.ab_output = output_of(0, real[c].ab, ideal[c].ab);
      if (out.cd != Register::discard) to.cd_output = output_of(1, real[c].cd, ideal[c].cd);
      if (out.sum == Register::discard) continue;
      to.third = values_.wide(codes.wide[2], real[c].third.wide, ideal[c].third.wide);
      to.third_output = output_of(2, real[c].third, ideal[c].third);
    }
    return result;
  }

 private:
  TracedInput input(const CombinerInput& in, int channel, int mapped, double real, double ideal) const {
    // An alpha portion reads alpha or blue. Only the unset inputs of an unused product have another usage.
    const int component = reference::component_of(in.usage, channel);
    const auto i = static_cast<std::size_t>(component);
    TracedInput result{.from = in, .component = component, .read = {}, .mapped = {}};
    const int code = reference::fetch(before_.codes, in.reg, component, stage_.constant0, stage_.constant1);
    const bool fixed = in.reg == Register::zero || in.reg == Register::constant0 || in.reg == Register::constant1;
    result.read = values_.known_code(code, fixed ? values_.real_of_code(code) : before_.real[in.reg][i],
                                     fixed ? values_.ideal_of_code(code) : before_.ideal[in.reg][i]);
    result.mapped = values_.code(mapped, real, ideal);
    return result;
  }

  TracedWide product(const TracedCode& x, const TracedCode& y) const {
    return values_.wide(reference::mul(x.code, y.code), values_.mul(x.real, y.real), x.ideal * y.ideal);
  }

  TracedOutput output(const PortionOutput& out, int wide, const OutputSteps::Output& codes, const RealOutput& real,
                      const RealOutput& ideal) const {
    const bool has_bias = out.bias != Bias::none;
    const double real_biased = has_bias ? values_.sub(real.wide, 0.5) : real.wide;
    const double ideal_biased = has_bias ? ideal.wide - 0.5 : ideal.wide;
    const double real_cut = real.scaled - real.written, ideal_cut = ideal.scaled - ideal.written;
    TracedOutput result;
    if (!values_.integer()) {
      result.wide = values_.wide(0, real.wide, ideal.wide);
      result.biased = values_.wide(0, real_biased, ideal_biased);
      result.scaled = values_.wide(0, real.scaled, ideal.scaled);
      result.narrowed = values_.code(0, real.scaled, ideal.scaled);
      result.written = values_.code(0, real.written, ideal.written);
      result.cut = values_.known_code(result.narrowed.code - result.written.code, real_cut, ideal_cut);
      return result;
    }
    const int twice_scaled = reference::scale_output(out.scale, codes.biased);
    result.wide = values_.wide(wide, 0, ideal.wide);
    result.biased = values_.wide(codes.biased, 0, ideal_biased);
    if (d_.narrowing_point == NarrowingPoint::before_scale) result.early = values_.code(codes.early, 0, ideal_biased);
    result.scaled = values_.halves(twice_scaled, 0, ideal.scaled);
    result.dropped = values_.halves(twice_scaled - 2 * d_.one * codes.narrowed, 0, 0);
    result.narrowed = values_.code(codes.narrowed, 0, ideal.scaled);
    result.cut = values_.code(codes.narrowed - codes.written, 0, ideal_cut);
    result.written = values_.code(codes.written, 0, ideal.written);
    return result;
  }

  const Datapath& d_;
  TraceValues values_;
  const ProgramStage& stage_;
  const TracedRegisters& before_;
  const Steps& steps_;
};

// With integer arithmetic the real numbers are those of the codes, with another one those of evaluate_real.
TracedRegisters registers_of(const TraceValues& values, const RegisterFile& codes, const RealRegisters& real,
                             const RealRegisters& ideal) {
  TracedRegisters result{codes, real, ideal};
  if (!values.integer()) return result;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) result.real.value[r][c] = values.ideal_of_code(codes.value[r][c]);
  }
  return result;
}

}  // namespace

Trace trace(const Program& program, const HardwareProfile& profile, const RegisterFile& initial) {
  const Datapath& d = program.datapath;
  const TraceValues values(d);
  const RealEvaluation ideal = evaluate_real(program, initial, Arithmetic::exact);
  // Not read if the arithmetic is integer.
  const RealEvaluation real =
      d.arithmetic == Arithmetic::float32 ? evaluate_real(program, initial, Arithmetic::float32) : ideal;
  Trace result;
  result.before = registers_of(values, initial, real.before, ideal.before);
  for (std::size_t i = 0; i < ideal.stage.size(); ++i) {
    const RealStage &real_stage = real.stage[i], &ideal_stage = ideal.stage[i];
    const TracedRegisters before = result.registers();
    const auto spare0 = [](const auto& registers) { return registers[Register::spare0][kAlpha]; };
    TracedStage& to = result.stage.emplace_back();
    to.spare0_alpha = values.known_code(spare0(before.codes), spare0(before.real), spare0(before.ideal));
    const ProgramStage& stage = program.general[i];
    to.mux_by_lowest_bit = stage.mux_by_lowest_bit;
    to.takes_cd = values.integer() ? reference::mux(d, stage.mux_by_lowest_bit, spare0(before.codes), 0, 1) == 1
                                   : real_stage.takes_cd;
    to.ideal_takes_cd = ideal_stage.takes_cd;

    RegisterFile after = values.integer() ? before.codes : real_stage.codes;
    StageTracer::Steps steps{};
    if (values.integer()) {
      OutputSteps domain(d, stage, after);
      detail::walk_stage(domain, stage, steps);
    }
    const StageTracer tracer(d, stage, before, steps);
    to.rgb = tracer.portion(stage.rgb, kRed, 3, real_stage.rgb, ideal_stage.rgb);
    to.alpha = tracer.portion(stage.alpha, kAlpha, 1, {&real_stage.alpha, 1}, {&ideal_stage.alpha, 1});
    to.after = registers_of(values, after, real_stage.after, ideal_stage.after);
  }
  result.final_combiner = trace_final(program, result.registers(), real, ideal);
  result.color = real.codes.color;
  if (values.integer()) {
    for (std::size_t c = 0; c < 3; ++c) result.color[c] = static_cast<s9>(result.final_combiner.rgb[c].written.code);
    result.color[kAlpha] = static_cast<s9>(result.final_combiner.alpha.code);
  }
  for (std::size_t c = 0; c < 4; ++c) result.bytes[c] = to_byte(profile, result.color[c]);
  return result;
}

}  // namespace ninebit

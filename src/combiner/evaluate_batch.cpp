// The batch evaluator: the rules of combiner_rules.inl over vectors of int32 lanes, compiled once for every SIMD target
// and chosen at run time.
#include <cstring>

#include "ninebit/combiner/evaluate.h"
#include "src/combiner/real_batch.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/combiner/evaluate_batch.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using D = hn::ScalableTag<std::int32_t>;
using V = hn::Vec<D>;
constexpr D kD;
using D16 = hn::Rebind<s9, D>;
constexpr D16 kD16;

HWY_INLINE V set(int v) {
  return hn::Set(kD, v);
}
HWY_INLINE V add(V a, V b) {
  return hn::Add(a, b);
}
HWY_INLINE V sub(V a, V b) {
  return hn::Sub(a, b);
}
HWY_INLINE V mul(V a, V b) {
  return hn::Mul(a, b);
}
HWY_INLINE V min_of(V a, V b) {
  return hn::Min(a, b);
}
HWY_INLINE V max_of(V a, V b) {
  return hn::Max(a, b);
}
HWY_INLINE V abs_of(V a) {
  return hn::Abs(a);
}
// n is exact in a float, and the correctly rounded quotient of n and d cannot reach the next whole number: it is at
// least 1 / 510 away from it, and floats below 2^13 lie closer than that.
HWY_INLINE V divide(V n, int d) {
  const hn::RebindToFloat<D> df;
  return hn::ConvertTo(kD, hn::Div(hn::ConvertTo(df, n), hn::Set(df, static_cast<float>(d))));
}
HWY_INLINE V negate_where_negative(V sign, V x) {
  return hn::IfThenElse(hn::Lt(sign, set(0)), hn::Neg(x), x);
}
HWY_INLINE V select_where_at_least(V v, V limit, V yes, V no) {
  return hn::IfThenElse(hn::Lt(v, limit), no, yes);
}

#define NINEBIT_RULE HWY_INLINE
#include "ninebit/numerics/combiner_rules.inl"
#undef NINEBIT_RULE

HWY_INLINE V load(const s9* plane) {
  return hn::PromoteTo(kD, hn::LoadU(kD16, plane));
}
HWY_INLINE void store(V v, s9* plane) {
  hn::StoreU(hn::DemoteTo(kD16, v), kD16, plane);
}

// One input of one channel, decided once a batch: a plane, or one value for all lanes.
struct Source {
  const s9* plane = nullptr;
  int value = 0;
  InputMapping mapping = InputMapping::unsigned_identity;
};

HWY_INLINE V mapped(const Datapath& d, const Source& in, std::size_t lane) {
  return map_input(d, in.mapping, in.plane != nullptr ? load(in.plane + lane) : set(in.value));
}

HWY_INLINE Source source_of(const CombinerInput& in, int channel, const RegisterBatch& registers,
                            const Rgba9& constant0, const Rgba9& constant1) {
  const int component = reference::component_of(in.usage, channel);
  const auto i = static_cast<std::size_t>(component);
  switch (in.reg) {
    case Register::zero:
      return {nullptr, 0, in.mapping};
    case Register::constant0:
      return {nullptr, constant0[i], in.mapping};
    case Register::constant1:
      return {nullptr, constant1[i], in.mapping};
    default:
      return {registers(in.reg, component), 0, in.mapping};
  }
}

// The outputs of one stage before they are written: a stage reads all its inputs first.
struct StageOutputs {
  alignas(64) s9 value[3][4][kBatchSize];  // AB, CD, sum; red, green, blue, alpha
};

HWY_NOINLINE void evaluate_portion(const Datapath& d, const ProgramStage& stage, const Portion& portion, int first,
                                   int channels, const RegisterBatch& registers, std::size_t count, StageOutputs& to) {
  Source in[3][4];
  for (int c = 0; c < channels; ++c) {
    const CombinerInput* const inputs[4] = {&portion.a, &portion.b, &portion.c, &portion.d};
    for (int k = 0; k < 4; ++k) {
      in[c][k] = source_of(*inputs[k], c, registers, stage.constant0, stage.constant1);
    }
  }
  const PortionOutput& out = portion.out;
  const s9* const spare0_alpha = registers(Register::spare0, kAlpha);
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kD)) {
    V dot_ab = set(0);
    V dot_cd = set(0);
    if (out.ab_dot_product || out.cd_dot_product) {
      for (int c = 0; c < channels; ++c) {
        dot_ab = add(dot_ab, mul(mapped(d, in[c][0], lane), mapped(d, in[c][1], lane)));
        dot_cd = add(dot_cd, mul(mapped(d, in[c][2], lane), mapped(d, in[c][3], lane)));
      }
    }
    for (int c = 0; c < channels; ++c) {
      const V ab = out.ab_dot_product ? dot_ab : mul(mapped(d, in[c][0], lane), mapped(d, in[c][1], lane));
      const V cd = out.cd_dot_product ? dot_cd : mul(mapped(d, in[c][2], lane), mapped(d, in[c][3], lane));
      s9* const ab_to = to.value[0][first + c] + lane;
      s9* const cd_to = to.value[1][first + c] + lane;
      s9* const sum_to = to.value[2][first + c] + lane;
      if (out.ab != Register::discard) store(combiner_output(d, out.scale, out.bias, ab), ab_to);
      if (out.cd != Register::discard) store(combiner_output(d, out.scale, out.bias, cd), cd_to);
      if (out.sum != Register::discard) {
        const V third = out.mux_sum ? mux(d, load(spare0_alpha + lane), ab, cd) : add(ab, cd);
        store(combiner_output(d, out.scale, out.bias, third), sum_to);
      }
    }
  }
}

void write_portion(const Portion& portion, int first, int channels, const StageOutputs& from, std::size_t bytes,
                   RegisterBatch& registers) {
  const Register names[3] = {portion.out.ab, portion.out.cd, portion.out.sum};
  for (int k = 0; k < 3; ++k) {
    if (names[k] == Register::discard) continue;
    for (int c = first; c < first + channels; ++c) std::memcpy(registers(names[k], c), from.value[k][c], bytes);
  }
}

HWY_NOINLINE void evaluate_final_batch(const Program& program, const RegisterBatch& registers, std::size_t count,
                                       OutputBatch& out) {
  const Datapath& d = program.datapath;
  const FinalCombiner& f = program.final_combiner;
  const auto source = [&](const CombinerInput& in, int c) {
    // E·F and the colour sum are computed below; what source_of would read for them does not exist.
    const bool computed = in.reg == Register::e_times_f || in.reg == Register::spare0_plus_secondary;
    return computed ? Source{nullptr, 0, in.mapping}
                    : source_of(in, c, registers, program.constant0, program.constant1);
  };
  for (int c = 0; c < 3; ++c) {
    const Source e = source(f.e, c), ff = source(f.f, c);
    const CombinerInput* const inputs[4] = {&f.a, &f.b, &f.c, &f.d};
    const Source in[4] = {source(f.a, c), source(f.b, c), source(f.c, c), source(f.d, c)};
    for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kD)) {
      const V ef = e_times_f(d, mapped(d, e, lane), mapped(d, ff, lane));
      const V sum = color_sum(d, program.color_sum_clamp, load(registers(Register::spare0, c) + lane),
                              load(registers(Register::secondary, c) + lane));
      const auto value = [&](int k) HWY_ATTR {
        if (inputs[k]->reg == Register::e_times_f) return map_input(d, in[k].mapping, ef);
        if (inputs[k]->reg == Register::spare0_plus_secondary) return map_input(d, in[k].mapping, sum);
        return mapped(d, in[k], lane);
      };
      store(final_rgb(d, value(0), value(1), value(2), value(3)), out.plane[static_cast<std::size_t>(c)].data() + lane);
    }
  }
  const Source g = source(f.g, kAlpha);
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(kD)) {
    store(final_alpha(d, mapped(d, g, lane)), out.plane[kAlpha].data() + lane);
  }
}

void evaluate_batch(const Program& program, RegisterBatch& registers, std::size_t count, OutputBatch& out) {
  const std::size_t lanes = hn::Lanes(kD);
  const std::size_t bytes = (count + lanes - 1) / lanes * lanes * sizeof(s9);
  StageOutputs outputs;
  for (int i = 0; i < program.num_general_combiners; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    evaluate_portion(program.datapath, stage, stage.rgb, kRed, 3, registers, count, outputs);
    evaluate_portion(program.datapath, stage, stage.alpha, kAlpha, 1, registers, count, outputs);
    write_portion(stage.rgb, kRed, 3, outputs, bytes, registers);
    write_portion(stage.alpha, kAlpha, 1, outputs, bytes, registers);
  }
  evaluate_final_batch(program, registers, count, out);
}

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit {

HWY_EXPORT(evaluate_batch);

void evaluate(const Program& program, RegisterBatch& registers, std::size_t count, OutputBatch& out) {
  if (program.datapath.arithmetic != Arithmetic::integer) return evaluate_real_batch(program, registers, count, out);
  HWY_DYNAMIC_DISPATCH(evaluate_batch)(program, registers, count, out);
}

const char* simd_target() {
  // Highway numbers targets so that the lowest set bit is the best one.
  const std::int64_t usable = hwy::SupportedTargets() & HWY_TARGETS;
  return hwy::TargetName(usable & -usable);
}

}  // namespace ninebit
#endif

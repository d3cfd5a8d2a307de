// Running a program over one fragment by the constexpr reference, and what a batch of fragments is. batch_program.h
// runs batches by SIMD, with the same bits.
//
// Registers and colours are codes here with every arithmetic. A program whose arithmetic is not integer computes in
// real numbers from the first stage to the last; each register that it wrote and each colour then leaves as the nearest
// code, halves up. evaluate_real.h shows the numbers themselves.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/fixed9.h"

namespace NINEBIT_PUBLIC ninebit {

// The register file of one fragment. `zero` and the constants are the program's affair: what stands there is not read.
struct RegisterFile {
  std::array<Rgba9, kRegisterCount> value{};  // by Register
  constexpr Rgba9& operator[](Register r) {
    return value[static_cast<std::size_t>(r)];
  }  // one of the first kRegisterCount
  constexpr const Rgba9& operator[](Register r) const { return value[static_cast<std::size_t>(r)]; }  // likewise
  friend constexpr bool operator==(const RegisterFile&, const RegisterFile&) = default;
};

// One fragment's registers after the last general combiner, and the colour that leaves the final combiner.
struct EvaluatedFragment {
  RegisterFile registers;  // `zero` and constants as they were given
  Rgba9 color{};           // codes in [0, one]
};

// Runs a program of any arithmetic over one fragment. Not constexpr; for integer arithmetic the same as the functions
// below.
[[nodiscard]] EvaluatedFragment evaluate_fragment(const Program& program, const RegisterFile& initial);

namespace detail {
// The final combiner alone, in a program's arithmetic, on registers that are codes.
[[nodiscard]] Rgba9 evaluate_real_final(const Program& program, const RegisterFile& registers);
}  // namespace detail

namespace reference {

// The primitives of combiner_rules.inl for one lane.
using V = int;
constexpr V set(int v) {
  return v;
}
constexpr V add(V a, V b) {
  return a + b;
}
constexpr V sub(V a, V b) {
  return a - b;
}
constexpr V mul(V a, V b) {
  return a * b;
}
constexpr V min_of(V a, V b) {
  return a < b ? a : b;
}
constexpr V max_of(V a, V b) {
  return a > b ? a : b;
}
constexpr V abs_of(V a) {
  return a < 0 ? -a : a;
}
constexpr V divide(V n, int d) {
  return n / d;
}
constexpr V negate_where_negative(V sign, V x) {
  return sign < 0 ? -x : x;
}
constexpr V select_where_at_least(V v, V limit, V yes, V no) {
  return v >= limit ? yes : no;
}

// How the functions of combiner_rules.inl are declared here; not defined after this header.
#define NINEBIT_RULE constexpr
#include "ninebit/numerics/combiner_rules.inl"
#include "ninebit/numerics/visibility.h"
#undef NINEBIT_RULE

// The component of a register that portion channel `channel` reads.
constexpr int component_of(ComponentUsage usage, int channel) {
  return usage == ComponentUsage::rgb ? channel : usage == ComponentUsage::alpha ? kAlpha : kBlue;
}

// A register's components with the stage's constants and zero in place.
constexpr Rgba9 fetch(const RegisterFile& registers, Register reg, const Rgba9& constant0, const Rgba9& constant1) {
  switch (reg) {
    case Register::zero:
      return {};
    case Register::constant0:
      return constant0;
    case Register::constant1:
      return constant1;
    default:
      return registers[reg];
  }
}

// What the three outputs of one portion are, for up to three channels.
struct PortionResult {
  std::array<V, 3> ab{}, cd{}, sum{};  // register codes
};

constexpr PortionResult evaluate_portion(const Datapath& d, const ProgramStage& stage, const Portion& portion,
                                         int channels, const RegisterFile& registers) {
  const auto mapped = [&](const CombinerInput& in, int channel) {
    const Rgba9 value = fetch(registers, in.reg, stage.constant0, stage.constant1);
    return map_input(d, in.mapping, value[static_cast<std::size_t>(component_of(in.usage, channel))]);
  };
  std::array<V, 3> ab{}, cd{};
  const auto products = [&](std::array<V, 3>& wide, const CombinerInput& x, const CombinerInput& y, bool dot) {
    V total = 0;
    for (int c = 0; c < channels; ++c) {
      wide[static_cast<std::size_t>(c)] = mul(mapped(x, c), mapped(y, c));
      total += wide[static_cast<std::size_t>(c)];
    }
    if (dot) wide.fill(total);
  };
  products(ab, portion.a, portion.b, portion.out.ab_dot_product);
  products(cd, portion.c, portion.d, portion.out.cd_dot_product);

  PortionResult result;
  for (std::size_t c = 0; c < static_cast<std::size_t>(channels); ++c) {
    const V third = portion.out.mux_sum
                        ? mux(d, stage.mux_by_lowest_bit, registers[Register::spare0][kAlpha], ab[c], cd[c])
                        : add(ab[c], cd[c]);
    result.ab[c] = combiner_output(d, portion.out.scale, portion.out.bias, ab[c]);
    result.cd[c] = combiner_output(d, portion.out.scale, portion.out.bias, cd[c]);
    result.sum[c] = combiner_output(d, portion.out.scale, portion.out.bias, third);
  }
  return result;
}

constexpr void write_portion(const Portion& portion, int first, int channels, const PortionResult& result,
                             RegisterFile& registers) {
  const auto write = [&](Register reg, const std::array<V, 3>& value, bool blue_to_alpha) {
    if (reg == Register::discard) return;
    for (int c = 0; c < channels; ++c) {
      registers[reg][static_cast<std::size_t>(first + c)] = static_cast<s9>(value[static_cast<std::size_t>(c)]);
    }
    if (blue_to_alpha) registers[reg][kAlpha] = static_cast<s9>(value[kBlue]);  // rule 23
  };
  write(portion.out.ab, result.ab, portion.out.ab_blue_to_alpha);
  write(portion.out.cd, result.cd, portion.out.cd_blue_to_alpha);
  write(portion.out.sum, result.sum, false);
}

}  // namespace reference

// Runs the general combiners over one fragment's registers, in place. Each stage reads all before it writes (rule 12).
// constexpr while the arithmetic is integer.
constexpr void evaluate_general(const Program& program, RegisterFile& registers) {
  if (program.datapath.arithmetic != Arithmetic::integer) {
    registers = evaluate_fragment(program, registers).registers;
    return;
  }
  for (int i = 0; i < program.num_general_combiners; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    const auto rgb = reference::evaluate_portion(program.datapath, stage, stage.rgb, 3, registers);
    // The alpha portion has one channel; ComponentUsage rgb is illegal there.
    const auto alpha = reference::evaluate_portion(program.datapath, stage, stage.alpha, 1, registers);
    reference::write_portion(stage.rgb, kRed, 3, rgb, registers);
    reference::write_portion(stage.alpha, kAlpha, 1, alpha, registers);
  }
}

// Runs the final combiner over the registers that the general combiners left. Returns codes in [0, one]. constexpr
// while the arithmetic is integer; with another one it starts from registers that evaluate_general has rounded, unlike
// evaluate() and evaluate_fragment(), which round once at the end.
[[nodiscard]] constexpr Rgba9 evaluate_final(const Program& program, const RegisterFile& registers) {
  if (program.datapath.arithmetic != Arithmetic::integer) return detail::evaluate_real_final(program, registers);
  const Datapath& d = program.datapath;
  const FinalCombiner& f = program.final_combiner;
  const auto mapped = [&](const CombinerInput& in, int channel, const Rgba9& ef, const Rgba9& sum) -> reference::V {
    const Rgba9 value = in.reg == Register::e_times_f ? ef
                        : in.reg == Register::spare0_plus_secondary
                            ? sum
                            : reference::fetch(registers, in.reg, program.constant0, program.constant1);
    return reference::map_input(d, in.mapping,
                                value[static_cast<std::size_t>(reference::component_of(in.usage, channel))]);
  };
  Rgba9 ef{}, sum{}, out{};
  for (int c = 0; c < 3; ++c) {
    const auto i = static_cast<std::size_t>(c);
    ef[i] = static_cast<s9>(reference::e_times_f(d, mapped(f.e, c, {}, {}), mapped(f.f, c, {}, {})));
    const auto part = [&](bool inverted, Register r) {
      return reference::color_sum_part(d, inverted, registers[r][i]);
    };
    sum[i] = static_cast<s9>(reference::color_sum(d, program.color_sum_clamp,
                                                  part(program.color_sum_invert_spare0, Register::spare0),
                                                  part(program.color_sum_invert_secondary, Register::secondary)));
  }
  for (int c = 0; c < 3; ++c) {
    out[static_cast<std::size_t>(c)] = static_cast<s9>(reference::final_rgb(
        d, mapped(f.a, c, ef, sum), mapped(f.b, c, ef, sum), mapped(f.c, c, ef, sum), mapped(f.d, c, ef, sum)));
  }
  out[kAlpha] = static_cast<s9>(reference::final_alpha(d, mapped(f.g, kAlpha, ef, sum)));
  return out;
}

// Both, for one fragment: what leaves the combiners, codes in [0, one]. constexpr while the arithmetic is integer.
[[nodiscard]] constexpr Rgba9 evaluate(const Program& program, RegisterFile registers) {
  if (program.datapath.arithmetic != Arithmetic::integer) return evaluate_fragment(program, registers).color;
  evaluate_general(program, registers);
  return evaluate_final(program, registers);
}

// Fragments in a batch.
inline constexpr std::size_t kBatchSize = 512;

// Registers of up to kBatchSize fragments, planar: 64 KiB, of which a program touches the planes that it names.
struct alignas(64) RegisterBatch {
  std::array<std::array<std::array<s9, kBatchSize>, 4>, kRegisterCount> plane;  // by Register, component, fragment
  // The kBatchSize codes of one component (kRed to kAlpha) of one of the first kRegisterCount registers.
  [[nodiscard]] s9* operator()(Register r, int component) {
    return plane[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)].data();
  }
  [[nodiscard]] const s9* operator()(Register r, int component) const {
    return plane[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)].data();
  }
};

// What leaves the combiners, planar: red, green, blue, alpha codes in [0, one].
struct alignas(64) OutputBatch {
  std::array<std::array<s9, kBatchSize>, 4> plane;  // by component, fragment
};

}  // namespace ninebit

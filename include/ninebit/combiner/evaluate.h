// The constexpr reference, which runs a program over one fragment; the types of a batch of fragments. batch_program.h
// runs batches with SIMD and gives the same bits.
//
// Registers and colours are codes here, whatever the arithmetic. A program whose arithmetic is not integer computes in
// real numbers from the first stage to the last. Each register that it wrote, and each colour, is then rounded to the
// nearest code, halves up. evaluate_real.h returns the real numbers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/combiner/final_walk.h"
#include "ninebit/combiner/portion_walk.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"
#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The register file of one fragment. The entries of `zero` and the constants are not read: the program defines them.
struct RegisterFile {
  std::array<Rgba9, kRegisterCount> value{};  // by Register
  constexpr Rgba9& operator[](Register r) {
    return value[static_cast<std::size_t>(r)];
  }  // r: one of the first kRegisterCount
  constexpr const Rgba9& operator[](Register r) const { return value[static_cast<std::size_t>(r)]; }  // likewise
  friend constexpr bool operator==(const RegisterFile&, const RegisterFile&) = default;
};

// One fragment's registers after the last general combiner, and the final combiner's colour.
struct EvaluatedFragment {
  RegisterFile registers;  // `zero` and the constants are unchanged
  Rgba9 color{};           // codes in [0, one]
};

// Runs a program of any arithmetic over one fragment. Not constexpr. For integer arithmetic the result equals that of
// the functions below.
[[nodiscard]] EvaluatedFragment evaluate_fragment(const Program& program, const RegisterFile& initial);

namespace detail {
// Runs the final combiner alone, in the program's arithmetic, on registers that hold codes.
[[nodiscard]] Rgba9 evaluate_real_final(const Program& program, const RegisterFile& registers);
}  // namespace detail

namespace reference {

// The primitives of arithmetic.inl for one lane.
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

// The functions of arithmetic.inl are constexpr here. The macro is undefined again below.
#define NINEBIT_RULE constexpr
#include "ninebit/combiner/arithmetic.inl"
#undef NINEBIT_RULE

using detail::component_of;

// Returns one component of a register, of zero, or of a constant.
constexpr V fetch(const RegisterFile& registers, Register reg, int component, const Rgba9& constant0,
                  const Rgba9& constant1) {
  const auto i = static_cast<std::size_t>(component);
  switch (reg) {
    case Register::zero:
      return 0;
    case Register::constant0:
      return constant0[i];
    case Register::constant1:
      return constant1[i];
    default:
      return registers[reg][i];
  }
}

// The value domain of the reference (portion_walk.h): register codes.
class CodeDomain {
 public:
  using Input = V;
  using Wide = V;
  using Output = V;

  constexpr CodeDomain(const Datapath& d, const ProgramStage& stage, RegisterFile& registers)
      : d_(d), stage_(stage), registers_(registers) {}

  constexpr V input(const CombinerInput& in, int component) const {
    return map_input(d_, in.mapping, fetch(registers_, in.reg, component, stage_.constant0, stage_.constant1));
  }
  constexpr V product(V x, V y) const { return mul(x, y); }
  constexpr V sum(V x, V y) const { return add(x, y); }
  constexpr V mux(V ab, V cd) const {
    return reference::mux(d_, stage_.mux_by_lowest_bit, registers_[Register::spare0][kAlpha], ab, cd);
  }
  constexpr V output(const detail::Target& target, V wide) const {
    return combiner_output(d_, target.out.scale, target.out.bias, wide);
  }
  constexpr void write(Register to, int component, V code) {
    registers_[to][static_cast<std::size_t>(component)] = static_cast<s9>(code);
  }

 private:
  const Datapath d_;  // a copy: the compiler then keeps its fields in registers while steps are stored
  const ProgramStage& stage_;
  RegisterFile& registers_;
};

// The value domain of the reference's final combiner (final_walk.h): register codes.
class FinalCodes {
 public:
  using Input = V;
  using Code = V;
  static constexpr bool kEveryStep = false;

  constexpr FinalCodes(const Program& program, const RegisterFile& registers)
      : d_(program.datapath), program_(program), registers_(registers) {}

  constexpr V input(const CombinerInput& in, int component) const {
    return map(in.mapping, fetch(registers_, in.reg, component, program_.constant0, program_.constant1));
  }
  constexpr V map(InputMapping mapping, V e) const { return map_input(d_, mapping, e); }
  constexpr V product(V e, V f) const { return e_times_f(d_, e, f); }
  constexpr V sum_part(bool inverted, Register r, int component) const {
    return color_sum_part(d_, inverted, registers_[r][static_cast<std::size_t>(component)]);
  }
  constexpr V sum(bool clamp, V spare0, V secondary) const { return color_sum(d_, clamp, spare0, secondary); }
  constexpr V rgb(int, V a, V b, V c, V added) const { return final_rgb(d_, a, b, c, added); }
  constexpr V alpha(V g) const { return final_alpha(d_, g); }

 private:
  const Datapath& d_;
  const Program& program_;
  const RegisterFile& registers_;
};

}  // namespace reference

namespace detail {
// The colour of a domain of codes.
template <class Domain>
constexpr Rgba9 walk_final_codes(Domain domain, const Program& program) {
  FinalSteps<Domain> steps;
  walk_final(domain, program, steps);
  Rgba9 color{};
  for (std::size_t c = 0; c < 4; ++c) color[c] = static_cast<s9>(steps.color[c]);
  return color;
}
}  // namespace detail

// Runs the general combiners over one fragment's registers, in place. constexpr if the arithmetic is integer.
constexpr void evaluate_general(const Program& program, RegisterFile& registers) {
  if (program.datapath.arithmetic != Arithmetic::integer) {
    registers = evaluate_fragment(program, registers).registers;
    return;
  }
  for (int i = 0; i < program.num_general_combiners; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    reference::CodeDomain codes(program.datapath, stage, registers);
    detail::StageSteps<reference::CodeDomain> steps;
    detail::walk_stage(codes, stage, steps);
  }
}

// Runs the final combiner over the registers that the general combiners left. Returns codes in [0, one]. constexpr if
// the arithmetic is integer. With another arithmetic it starts from registers that evaluate_general has rounded;
// evaluate() and evaluate_fragment() round once, at the end.
[[nodiscard]] constexpr Rgba9 evaluate_final(const Program& program, const RegisterFile& registers) {
  if (program.datapath.arithmetic != Arithmetic::integer) return detail::evaluate_real_final(program, registers);
  return detail::walk_final_codes(reference::FinalCodes(program, registers), program);
}

// Runs general combiners and final combiner over one fragment. Returns codes in [0, one]. constexpr if the arithmetic
// is integer.
[[nodiscard]] constexpr Rgba9 evaluate(const Program& program, RegisterFile registers) {
  if (program.datapath.arithmetic != Arithmetic::integer) return evaluate_fragment(program, registers).color;
  evaluate_general(program, registers);
  return evaluate_final(program, registers);
}

// Fragments in a batch.
inline constexpr std::size_t kBatchSize = 512;

// Registers of up to kBatchSize fragments, planar: 64 KiB. A program touches only the planes that it names.
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

// The final combiner's colours, planar: red, green, blue, alpha codes in [0, one].
struct alignas(64) OutputBatch {
  std::array<std::array<s9, kBatchSize>, 4> plane;  // by component, fragment
};

}  // namespace ninebit

// A valid state made ready to run: normalized, immutable, comparable.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A general combiner of a program: its portions, and its constants as codes.
struct ProgramStage {
  Portion rgb, alpha;                                  // normalized
  Rgba9 constant0{}, constant1{};                      // codes
  std::array<std::optional<ConstantName>, 2> unset{};  // constants 0 and 1, if they are read and nobody set them
  bool mux_by_lowest_bit = false;  // whether muxes test the lowest bit of spare0's alpha instead of the threshold
  friend constexpr bool operator==(const ProgramStage&, const ProgramStage&) = default;
};

// A normalized state, ready to be evaluated; compile() and normalize() make it. Two states that compute the same with
// the same portions give equal programs: inputs whose product is not used, constants that nothing reads, flags without
// effect and stages past the last are set to fixed values.
struct Program {
  Datapath datapath;                                         // the arithmetic of the profile it was compiled for
  int num_general_combiners = 1;                             // that run: 1 to kMaxGeneralCombiners
  bool color_sum_clamp = true;                               // true also if nothing reads the colour sum
  bool color_sum_invert_spare0 = false;                      // whether 1 - x of spare0 goes into the colour sum
  bool color_sum_invert_secondary = false;                   // likewise of the secondary colour
  std::array<ProgramStage, kMaxGeneralCombiners> general{};  // those past the last do nothing
  FinalCombiner final_combiner{};                            // normalized
  Rgba9 constant0{}, constant1{};                            // of the final combiner, codes
  std::array<std::optional<ConstantName>, 2> unset{};        // the same as in a stage, of the final combiner
  friend constexpr bool operator==(const Program&, const Program&) = default;
};

// Whether a portion writes anything.
[[nodiscard]] constexpr bool is_live(const PortionOutput& out) {
  return out.ab != Register::discard || out.cd != Register::discard || out.sum != Register::discard;
}

namespace detail {

constexpr Portion normalize_portion(Portion p) {
  PortionOutput& out = p.out;
  const bool sum = out.sum != Register::discard;
  if (!sum) out.mux_sum = false;
  if (!sum && out.ab == Register::discard) {
    p.a = p.b = CombinerInput{};
    out.ab_dot_product = false;
  }
  if (!sum && out.cd == Register::discard) {
    p.c = p.d = CombinerInput{};
    out.cd_dot_product = false;
  }
  if (out.ab == Register::discard) out.ab_blue_to_alpha = false;
  if (out.cd == Register::discard) out.cd_blue_to_alpha = false;
  if (!is_live(out)) {
    out.scale = Scale::none;
    out.bias = Bias::none;
  }
  return p;
}

constexpr bool writes(const PortionOutput& out, Register r) {
  return out.ab == r || out.cd == r || out.sum == r;
}

// Clears the RGB portion's blue to alpha for the registers whose alpha the alpha portion writes.
constexpr void normalize_blue_to_alpha(PortionOutput& rgb, const PortionOutput& alpha) {
  if (writes(alpha, rgb.ab)) rgb.ab_blue_to_alpha = false;
  if (writes(alpha, rgb.cd)) rgb.cd_blue_to_alpha = false;
}

// For a normalized stage.
constexpr bool has_mux(const ProgramStage& stage) {
  return stage.rgb.out.mux_sum || stage.alpha.out.mux_sum;
}

constexpr bool reads(const Portion& p, Register r) {
  return p.a.reg == r || p.b.reg == r || p.c.reg == r || p.d.reg == r;
}

// Ignores E and F: only E times F reads them.
constexpr bool reads_directly(const FinalCombiner& f, Register r) {
  return f.a.reg == r || f.b.reg == r || f.c.reg == r || f.d.reg == r || f.g.reg == r;
}

constexpr FinalCombiner normalize_final(FinalCombiner f) {
  if (!reads_directly(f, Register::e_times_f)) f.e = f.f = CombinerInput{};
  return f;
}

constexpr bool stage_reads(const ProgramStage& stage, Register r) {
  return reads(stage.rgb, r) || reads(stage.alpha, r);
}

constexpr bool final_reads(const FinalCombiner& f, Register r) {
  return reads_directly(f, r) || f.e.reg == r || f.f.reg == r;
}

// Whether a portion or the final combiner reads the register.
constexpr bool program_reads(const Program& program, Register r) {
  for (int i = 0; i < program.num_general_combiners; ++i) {
    if (stage_reads(program.general[static_cast<std::size_t>(i)], r)) return true;
  }
  return final_reads(program.final_combiner, r);
}

}  // namespace detail

// The constants that the program reads and that are not set, each once.
[[nodiscard]] std::vector<ConstantName> unset_constants(const Program& program);

// Validates and normalizes. If the state is invalid, the Diagnostic holds all messages, one per line.
[[nodiscard]] Result<Program> compile(const CombinerState& state, const HardwareProfile& profile);

}  // namespace ninebit

// A valid state in the form that compile() evaluates, by constexpr functions.
#pragma once

#include <cstddef>
#include <optional>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {
namespace detail {

constexpr Rgba9 constant_codes(const HardwareProfile& profile, const ColorF& color) {
  Rgba9 codes{};
  for (std::size_t i = 0; i < 4; ++i) codes[i] = from_byte(profile, byte_of_color(color[i]));
  return codes;
}

// A portion that does nothing.
constexpr Portion dead_portion() {
  Portion p;
  p.out.sum = Register::discard;
  return p;
}

// A general combiner that runs.
constexpr ProgramStage normalize_stage(const CombinerState& state, const GeneralCombiner& from,
                                       const HardwareProfile& profile) {
  ProgramStage stage;
  stage.rgb = normalize_portion(from.rgb);
  stage.alpha = normalize_portion(from.alpha);
  normalize_blue_to_alpha(stage.rgb.out, stage.alpha.out);
  stage.mux_by_lowest_bit = state.mux_by_lowest_bit && has_mux(stage);
  const bool own = state.per_stage_constants;
  if (stage_reads(stage, Register::constant0)) {
    stage.constant0 = constant_codes(profile, own ? from.constant0 : state.constant0);
  }
  if (stage_reads(stage, Register::constant1)) {
    stage.constant1 = constant_codes(profile, own ? from.constant1 : state.constant1);
  }
  return stage;
}

// All of normalize() but `unset`.
constexpr Program normalize_combiners(const CombinerState& state, const HardwareProfile& profile) {
  Program program;
  program.datapath = datapath_of(profile);
  program.num_general_combiners = state.num_general_combiners;
  for (int i = 0; i < kMaxGeneralCombiners; ++i) {
    const auto at = static_cast<std::size_t>(i);
    if (i < state.num_general_combiners) {
      program.general[at] = normalize_stage(state, state.general[at], profile);
    } else {
      program.general[at].rgb = program.general[at].alpha = dead_portion();
    }
  }
  program.final_combiner = normalize_final(state.final_combiner);
  const FinalCombiner& f = program.final_combiner;
  if (final_reads(f, Register::constant0)) program.constant0 = constant_codes(profile, state.constant0);
  if (final_reads(f, Register::constant1)) program.constant1 = constant_codes(profile, state.constant1);
  const bool sums = final_reads(f, Register::spare0_plus_secondary);
  program.color_sum_clamp = state.color_sum_clamp || !sums;
  program.color_sum_invert_spare0 = state.color_sum_invert_spare0 && sums;
  program.color_sum_invert_secondary = state.color_sum_invert_secondary && sums;
  return program;
}

}  // namespace detail

// Returns the program of a valid state (see validate). An invalid state gives a program without meaning.
// Constants become bytes by rounding to nearest, then codes.
[[nodiscard]] constexpr Program normalize(const CombinerState& state, const HardwareProfile& profile) {
  Program program = detail::normalize_combiners(state, profile);
  const auto unset_if = [&](bool read, std::size_t place, std::size_t which) {
    return read && state.origin[place][which].unset ? std::optional(constant_name(state, place, which)) : std::nullopt;
  };
  for (std::size_t i = 0; i < program.general.size(); ++i) {
    ProgramStage& stage = program.general[i];
    stage.unset = {unset_if(detail::stage_reads(stage, Register::constant0), i, 0),
                   unset_if(detail::stage_reads(stage, Register::constant1), i, 1)};
  }
  const FinalCombiner& f = program.final_combiner;
  program.unset = {unset_if(detail::final_reads(f, Register::constant0), kFinalConstants, 0),
                   unset_if(detail::final_reads(f, Register::constant1), kFinalConstants, 1)};
  return program;
}

}  // namespace ninebit

// The conditions of a valid state, each with OpenGL's error and a sentence. Rules: NV_register_combiners, errors of
// CombinerInputNV, CombinerOutputNV, FinalCombinerInputNV, CombinerParameter*NV.
//
// src/combiner/c99/generate.py translates this file to C: no type but plain data, no lambda, no string is built here.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "ninebit/combiner/state.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::rules {

// What is wrong; kFaultTexts has a sentence for each, in this order.
enum class StateFault : std::uint8_t {
  wrong_combiner_count,
  no_stage_constants,
  no_mux_by_lowest_bit,
  no_color_sum_inverts,
  no_such_combiner,
  no_such_variable,
  not_for_general,
  no_such_unit,
  unknown_mapping,
  unknown_usage,
  blue_in_rgb,
  rgb_in_alpha,
  fog_alpha,
  unknown_scale,
  unknown_bias,
  not_writable,
  same_destination,
  dot_in_alpha,
  blue_to_alpha_in_alpha,
  no_blue_to_alpha,
  biased_scale,
  not_readable,
  mapping_not_final,
  computed_in_e_to_g,
  sum_in_a,
  rgb_in_g,
  blue_not_in_g,
  computed_alpha
};

// The error of a fault and its sentence, where these stand for what the fault is about:
// {profile}, {combiners}, {units}: of the profile; {number}, {register}, {mapping}, {scale}: what was added with it.
struct FaultText {
  GlError error;
  std::string_view text;
};
inline constexpr std::array<FaultText, 28> kFaultTexts{{
    {GlError::invalid_value, "num_general_combiners is {number}; profile {profile} has 1 to {combiners}"},
    {GlError::invalid_enum, "profile {profile} has no per-stage constants (NV_register_combiners2)"},
    {GlError::invalid_enum, "profile {profile} has no mux by the lowest bit of spare0's alpha (NV2A)"},
    {GlError::invalid_enum, "profile {profile} has no 1 - x in the colour sum (NV2A)"},
    {GlError::invalid_enum, "profile {profile} has {combiners} general combiners"},
    {GlError::invalid_enum, "a general combiner has the variables A to D"},
    {GlError::invalid_enum, "{register} cannot be read by a general combiner"},
    {GlError::invalid_enum, "{register} is beyond the {units} texture units of profile {profile}"},
    {GlError::invalid_enum, "unknown input mapping"},
    {GlError::invalid_enum, "unknown component usage"},
    {GlError::invalid_operation, "component usage blue is for alpha portions; an RGB portion takes rgb or alpha"},
    {GlError::invalid_operation, "component usage rgb is for RGB portions; an alpha portion takes alpha or blue"},
    {GlError::invalid_operation, "fog's alpha can be read by the final combiner alone"},
    {GlError::invalid_enum, "unknown scale"},
    {GlError::invalid_enum, "unknown bias"},
    {GlError::invalid_enum, "{register} cannot be written"},
    {GlError::invalid_operation, "two outputs go to {register}; each needs its own register"},
    {GlError::invalid_value, "an alpha portion has no dot product"},
    {GlError::invalid_value, "an alpha portion has no blue"},
    {GlError::invalid_enum, "profile {profile} has no blue-to-alpha outputs (NV2A)"},
    {GlError::invalid_operation, "a bias of minus one half goes with no scale or with scale_by_two, not with {scale}"},
    {GlError::invalid_enum, "{register} cannot be read"},
    {GlError::invalid_enum, "the final combiner takes unsigned_identity and unsigned_invert, not {mapping}"},
    {GlError::invalid_operation, "{register} can be read by the variables A to D alone"},
    {GlError::invalid_operation, "spare0_plus_secondary_color can be read by the variables B, C and D alone"},
    {GlError::invalid_operation, "component usage rgb is not for variable G, which takes alpha or blue"},
    {GlError::invalid_operation, "component usage blue is for variable G alone"},
    {GlError::invalid_operation, "{register} has no alpha; its component usage is rgb"},
}};

// `Findings` collects faults: add(StateFault what, int about), and the places of those that follow: at_parameter(p),
// at_variable(stage, portion, variable), at_output(stage, portion), at_final(variable).

// How many general combiners a state may have. A profile that somebody changed may say more than there is room for.
constexpr int most_combiners(const HardwareProfile& profile) {
  return profile.general_combiners < kMaxGeneralCombiners ? profile.general_combiners.value : kMaxGeneralCombiners;
}

template <class Findings>
constexpr void check_unit(Findings& findings, Register r, const HardwareProfile& profile) {
  if (is_texture(r) && texture_unit_of(r) >= profile.texture_units) {
    findings.add(StateFault::no_such_unit, static_cast<int>(r));
  }
}

template <class Findings>
constexpr void check_combiner(Findings& findings, int stage, const HardwareProfile& profile) {
  if (stage < 0 || stage >= most_combiners(profile)) findings.add(StateFault::no_such_combiner, stage);
}

// Variable A to D of a general combiner. A caller may have cast any number to the enumerations, and evaluation relies
// on their enumerators.
template <class Findings>
constexpr void check_input(Findings& findings, int stage, PortionName portion, Variable variable,
                           const CombinerInput& input, const HardwareProfile& profile) {
  findings.at_variable(stage, portion, variable);
  check_combiner(findings, stage, profile);
  if (variable > Variable::d) findings.add(StateFault::no_such_variable, 0);
  if (input.reg >= Register::e_times_f) findings.add(StateFault::not_for_general, static_cast<int>(input.reg));
  check_unit(findings, input.reg, profile);
  if (input.mapping > InputMapping::signed_negate) findings.add(StateFault::unknown_mapping, 0);
  if (input.usage > ComponentUsage::blue) findings.add(StateFault::unknown_usage, 0);
  if (portion == PortionName::rgb && input.usage == ComponentUsage::blue) findings.add(StateFault::blue_in_rgb, 0);
  if (portion == PortionName::alpha && input.usage == ComponentUsage::rgb) findings.add(StateFault::rgb_in_alpha, 0);
  if (input.reg == Register::fog && input.usage == ComponentUsage::alpha) findings.add(StateFault::fog_alpha, 0);
}

constexpr bool is_writable(Register r) {
  return r == Register::discard || r == Register::primary || r == Register::secondary || r == Register::spare0 ||
         r == Register::spare1 || is_texture(r);
}

template <class Findings>
constexpr void check_destination(Findings& findings, Register r, const HardwareProfile& profile) {
  if (!is_writable(r)) findings.add(StateFault::not_writable, static_cast<int>(r));
  check_unit(findings, r, profile);
}

template <class Findings>
constexpr void check_pair(Findings& findings, Register r, Register other) {
  if (r == other && r != Register::discard) findings.add(StateFault::same_destination, static_cast<int>(r));
}

// The outputs of a portion.
template <class Findings>
constexpr void check_output(Findings& findings, int stage, PortionName portion, const PortionOutput& output,
                            const HardwareProfile& profile) {
  findings.at_output(stage, portion);
  check_combiner(findings, stage, profile);
  if (output.scale > Scale::by_one_half) findings.add(StateFault::unknown_scale, 0);
  if (output.bias > Bias::by_negative_one_half) findings.add(StateFault::unknown_bias, 0);
  check_destination(findings, output.ab, profile);
  check_destination(findings, output.cd, profile);
  check_destination(findings, output.sum, profile);
  check_pair(findings, output.ab, output.cd);
  check_pair(findings, output.ab, output.sum);
  check_pair(findings, output.cd, output.sum);
  if (portion == PortionName::alpha && (output.ab_dot_product || output.cd_dot_product)) {
    findings.add(StateFault::dot_in_alpha, 0);
  }
  if (output.ab_blue_to_alpha || output.cd_blue_to_alpha) {
    if (portion == PortionName::alpha) findings.add(StateFault::blue_to_alpha_in_alpha, 0);
    if (!profile.blue_to_alpha) findings.add(StateFault::no_blue_to_alpha, 0);
  }
  if (output.bias != Bias::none && (output.scale == Scale::by_four || output.scale == Scale::by_one_half)) {
    findings.add(StateFault::biased_scale, static_cast<int>(output.scale));
  }
}

// Variable A to G of the final combiner.
template <class Findings>
constexpr void check_final_input(Findings& findings, Variable variable, const CombinerInput& input,
                                 const HardwareProfile& profile) {
  findings.at_final(variable);
  const bool computed = input.reg == Register::e_times_f || input.reg == Register::spare0_plus_secondary;
  if (input.reg >= Register::discard) findings.add(StateFault::not_readable, static_cast<int>(input.reg));
  check_unit(findings, input.reg, profile);
  if (input.usage > ComponentUsage::blue) findings.add(StateFault::unknown_usage, 0);
  if (input.mapping != InputMapping::unsigned_identity && input.mapping != InputMapping::unsigned_invert) {
    findings.add(StateFault::mapping_not_final, static_cast<int>(input.mapping));
  }
  if (computed && variable >= Variable::e) findings.add(StateFault::computed_in_e_to_g, static_cast<int>(input.reg));
  if (input.reg == Register::spare0_plus_secondary && variable == Variable::a) findings.add(StateFault::sum_in_a, 0);
  if (variable == Variable::g && input.usage == ComponentUsage::rgb) findings.add(StateFault::rgb_in_g, 0);
  if (variable != Variable::g && input.usage == ComponentUsage::blue) findings.add(StateFault::blue_not_in_g, 0);
  if (computed && input.usage != ComponentUsage::rgb) {
    findings.add(StateFault::computed_alpha, static_cast<int>(input.reg));
  }
}

template <class Findings>
constexpr void check_portion(Findings& findings, int stage, PortionName name, const Portion& portion,
                             const HardwareProfile& profile) {
  check_input(findings, stage, name, Variable::a, portion.a, profile);
  check_input(findings, stage, name, Variable::b, portion.b, profile);
  check_input(findings, stage, name, Variable::c, portion.c, profile);
  check_input(findings, stage, name, Variable::d, portion.d, profile);
  check_output(findings, stage, name, portion.out, profile);
}

// A whole state: the parameters, all general combiners that the chip has, the final combiner.
template <class Findings>
constexpr void check_state(Findings& findings, const CombinerState& state, const HardwareProfile& profile) {
  findings.at_parameter(StateParameter::num_general_combiners);
  if (state.num_general_combiners < 1 || state.num_general_combiners > most_combiners(profile)) {
    findings.add(StateFault::wrong_combiner_count, state.num_general_combiners);
  }
  findings.at_parameter(StateParameter::per_stage_constants);
  if (state.per_stage_constants && !profile.per_stage_constants) findings.add(StateFault::no_stage_constants, 0);
  findings.at_parameter(StateParameter::mux_by_lowest_bit);
  if (state.mux_by_lowest_bit && !profile.mux_by_lowest_bit) findings.add(StateFault::no_mux_by_lowest_bit, 0);
  findings.at_parameter(StateParameter::color_sum_inverts);
  if ((state.color_sum_invert_spare0 || state.color_sum_invert_secondary) && !profile.color_sum_inverts) {
    findings.add(StateFault::no_color_sum_inverts, 0);
  }
  for (int i = 0; i < most_combiners(profile); ++i) {
    const GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    check_portion(findings, i, PortionName::rgb, stage.rgb, profile);
    check_portion(findings, i, PortionName::alpha, stage.alpha, profile);
  }
  const FinalCombiner& f = state.final_combiner;
  check_final_input(findings, Variable::a, f.a, profile);
  check_final_input(findings, Variable::b, f.b, profile);
  check_final_input(findings, Variable::c, f.c, profile);
  check_final_input(findings, Variable::d, f.d, profile);
  check_final_input(findings, Variable::e, f.e, profile);
  check_final_input(findings, Variable::f, f.f, profile);
  check_final_input(findings, Variable::g, f.g, profile);
}

}  // namespace ninebit::rules

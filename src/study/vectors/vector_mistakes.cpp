#include "src/study/vectors/vector_mistakes.h"

#include <utility>

#include "ninebit/combiner/portion_walk.h"
#include "ninebit/study/combiner_fields.h"
#include "src/study/vectors/mistaken_codes.h"

namespace ninebit::vectors {
namespace {

// Calls change(portion, name) for every portion.
template <class Change>
void change_portions(CombinerState& state, const Change& change) {
  for (GeneralCombiner& stage : state.general) {
    change(stage.rgb, PortionName::rgb);
    change(stage.alpha, PortionName::alpha);
  }
}

void change_mux(CombinerState& state, bool by_lowest_bit) {
  state.mux_by_lowest_bit = by_lowest_bit;
}

template <class Change>
void change_inputs(CombinerState& state, PortionName of, const Change& change) {
  change_portions(state, [&](Portion& portion, PortionName name) {
    if (name != of) return;
    for (CombinerInput* const in : {&portion.a, &portion.b, &portion.c, &portion.d}) change(*in);
  });
}

// The pair of constants that each stage has.
void set_stage_constants(CombinerState& state, const ColorF& constant0, const ColorF& constant1) {
  state.per_stage_constants = true;
  for (GeneralCombiner& stage : state.general) {
    stage.constant0 = constant0;
    stage.constant1 = constant1;
  }
}

struct Edit {
  const char *name, *rules;
  void (*edit)(CombinerState&);
};

const Edit kEdits[] = {
    {"mux by the other bit of spare0's alpha", "11", [](CombinerState& s) { change_mux(s, !s.mux_by_lowest_bit); }},
    {"mux always by the lowest bit of spare0's alpha", "11", [](CombinerState& s) { change_mux(s, true); }},
    {"mux always by the threshold of spare0's alpha", "11", [](CombinerState& s) { change_mux(s, false); }},
    {"the sum instead of the mux", "11",
     [](CombinerState& s) { change_portions(s, [](Portion& p, PortionName) { p.out.mux_sum = false; }); }},
    {"no bias", "3, 4",
     [](CombinerState& s) { change_portions(s, [](Portion& p, PortionName) { p.out.bias = Bias::none; }); }},
    {"no scale", "3, 6",
     [](CombinerState& s) { change_portions(s, [](Portion& p, PortionName) { p.out.scale = Scale::none; }); }},
    {"products instead of dot products", "",
     [](CombinerState& s) {
       change_portions(s, [](Portion& p, PortionName) { p.out.ab_dot_product = p.out.cd_dot_product = false; });
     }},
    {"no blue to alpha", "23",
     [](CombinerState& s) {
       change_portions(s, [](Portion& p, PortionName) { p.out.ab_blue_to_alpha = p.out.cd_blue_to_alpha = false; });
     }},
    {"RGB portions read no alpha", "",
     [](CombinerState& s) {
       change_inputs(s, PortionName::rgb, [](CombinerInput& in) { in.usage = ComponentUsage::rgb; });
     }},
    {"alpha portions read alpha instead of blue", "",
     [](CombinerState& s) {
       change_inputs(s, PortionName::alpha, [](CombinerInput& in) { in.usage = ComponentUsage::alpha; });
     }},
    {"one general combiner", "", [](CombinerState& s) { s.num_general_combiners = 1; }},
    {"stage 0's constants in every stage", "",
     [](CombinerState& s) {
       if (!s.per_stage_constants) return;
       set_stage_constants(s, ColorF(s.general[0].constant0), ColorF(s.general[0].constant1));
     }},
    {"the final combiner's constants in every stage", "",
     [](CombinerState& s) { set_stage_constants(s, s.constant0, s.constant1); }},
    {"each stage's own constants, also where stage 0's are for all", "",
     [](CombinerState& s) {
       if (s.per_stage_constants) return;
       const ColorF first0 = s.constant0, first1 = s.constant1;
       set_stage_constants(s, {}, {});
       s.general[0].constant0 = first0;
       s.general[0].constant1 = first1;
     }},
    {"stage 0's constants in the final combiner", "",
     [](CombinerState& s) {
       if (!s.per_stage_constants) return;
       s.constant0 = s.general[0].constant0;
       s.constant1 = s.general[0].constant1;
     }},
    {"the colour sum always clamped", "13", [](CombinerState& s) { s.color_sum_clamp = true; }},
    {"the colour sum never clamped", "13", [](CombinerState& s) { s.color_sum_clamp = false; }},
    {"the colour sum never inverted", "13, 23",
     [](CombinerState& s) { s.color_sum_invert_spare0 = s.color_sum_invert_secondary = false; }},
    {"E times F is 0", "10",
     [](CombinerState& s) {
       s.final_combiner.e = {Register::zero, InputMapping::unsigned_identity};
     }},
    {"D of the final combiner is not added", "9",
     [](CombinerState& s) {
       s.final_combiner.d = {Register::zero, InputMapping::unsigned_identity};
     }},
};

struct NamedBrokenRule {
  const char *name, *rules;
  BrokenRule broken;
  bool in_general = true, in_final = true;
};

const NamedBrokenRule kBrokenRules[] = {
    {"negative inputs are not clamped to 0", "2, 14", BrokenRule::negative_inputs},
    {"outputs of general combiners are clamped to [0, 1]", "", BrokenRule::outputs_from_zero},
    {"outputs of general combiners are not clamped", "", BrokenRule::outputs_unclamped},
    {"the bias is added after the scale", "3", BrokenRule::bias_after_scale},
    {"each product is rounded before the sum", "7", BrokenRule::products_narrowed},
    {"sums are clamped before bias and scale", "22", BrokenRule::sums_clamped},
    {"the mux takes AB for CD", "11", BrokenRule::mux_swapped},
    {"the mux compares spare0's alpha by > instead of >=", "11", BrokenRule::mux_above_half},
    {"the alpha portion reads what the RGB portion wrote", "12", BrokenRule::portions_in_turn},
    {"general combiners round down", "5, 8", BrokenRule::rounded_down},
    {"general combiners round halves away from zero", "5", BrokenRule::halves_from_zero},
    {"half = 127.5", "4", BrokenRule::half_exact},
    {"a shift by 8 instead of a division by 255", "9, 10", BrokenRule::shifted},
    {"general combiners shift by 8", "5, 8", BrokenRule::shifted, true, false},
    {"the final combiner shifts by 8", "9, 10", BrokenRule::shifted, false, true},
    {"a shift by 8, bias half * 255", "4, 9, 10", BrokenRule::shifted_bias_255},
    {"general combiners shift by 8, bias half * 255", "4, 5, 8", BrokenRule::shifted_bias_255, true, false},
    {"a shift by 8 before the bias", "7, 9, 10", BrokenRule::sums_shifted},
    {"general combiners shift by 8 before the bias", "5, 7, 8", BrokenRule::sums_shifted, true, false},
    {"a shift by 8 of each product", "7, 9, 10", BrokenRule::products_shifted},
    {"general combiners shift each product by 8", "5, 7, 8", BrokenRule::products_shifted, true, false},
    {"spare0's alpha starts as 0", "", BrokenRule::spare0_alpha_zero},
};

}  // namespace

std::vector<Mistake> mistakes_of(const HardwareProfile& profile) {
  std::vector<Mistake> found;
  for (const CombinerField& field : arithmetic_fields(profile)) {
    for (std::size_t i = 1; i < field.values.size(); ++i) {
      Mistake mistake{std::string(field.name) + " = " + field.values[i].word, std::string(field.rules), profile};
      field.values[i].set(mistake.profile);
      found.push_back(std::move(mistake));
    }
  }
  const bool is_integer = profile.arithmetic.value == Arithmetic::integer;
  if (is_integer) {
    // Nothing is rounded between stages.
    for (const auto& [name, arithmetic] :
         {std::pair("arithmetic = float32", Arithmetic::float32), std::pair("arithmetic = exact", Arithmetic::exact)}) {
      found.push_back({name, "5, 8", profile});
      found.back().profile.arithmetic.value = arithmetic;
    }
    for (const NamedBrokenRule& one : kBrokenRules) {
      found.push_back({one.name, one.rules, profile, one.broken, nullptr, one.in_general, one.in_final});
    }
  }
  for (const Edit& one : kEdits) found.push_back({one.name, one.rules, profile, BrokenRule::none, one.edit});
  return found;
}

Program mistaken_program(const Mistake& mistake, const CombinerState& state) {
  if (mistake.edit == nullptr) return normalize(state, mistake.profile);
  CombinerState edited = state;
  mistake.edit(edited);
  return normalize(edited, mistake.profile);
}

Rgba9 run_mistaken(const Mistake& mistake, const Program& program, RegisterFile registers) {
  if (mistake.broken == BrokenRule::none) return evaluate(program, registers);
  if (mistake.broken == BrokenRule::spare0_alpha_zero) registers[Register::spare0][kAlpha] = 0;
  for (int i = 0; i < program.num_general_combiners; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    MistakenCodes codes(program.datapath, mistake.in_general ? mistake.broken : BrokenRule::none, stage, registers);
    detail::StageSteps<MistakenCodes> steps;
    if (mistake.broken != BrokenRule::portions_in_turn) {
      detail::walk_stage(codes, stage, steps);
      continue;
    }
    detail::compute_portion<PortionName::rgb>(codes, stage.rgb, steps);
    detail::write_portion<PortionName::rgb>(codes, stage.rgb.out, steps);
    detail::compute_portion<PortionName::alpha>(codes, stage.alpha, steps);
    detail::write_portion<PortionName::alpha>(codes, stage.alpha.out, steps);
  }
  return detail::walk_final_codes(
      MistakenFinal(program, mistake.in_final ? mistake.broken : BrokenRule::none, registers), program);
}

Bytes4 bytes_of(const HardwareProfile& profile, const Rgba9& color) {
  Bytes4 bytes{};
  for (std::size_t i = 0; i < 4; ++i) bytes[i] = to_byte(profile, color[i]);
  return bytes;
}

}  // namespace ninebit::vectors

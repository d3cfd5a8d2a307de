#include "src/study/vectors/vector_mistakes.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include "ninebit/study/combiner_fields.h"
#include "src/study/vectors/vector_groups.h"

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

void change_constants(CombinerState& state, void (*change)(ColorF&)) {
  change(state.constant0);
  change(state.constant1);
  for (GeneralCombiner& stage : state.general) {
    change(stage.constant0);
    change(stage.constant1);
  }
}

// The bits of an input in a word are 0. `usage`: the one whose bit is 0.
bool is_zero(const CombinerInput& in, ComponentUsage usage) {
  return in.reg == Register::zero && in.mapping == InputMapping::unsigned_identity && in.usage == usage;
}
bool has_zero_word(const Portion& portion, PortionName name) {
  const ComponentUsage usage = name == PortionName::rgb ? ComponentUsage::rgb : ComponentUsage::blue;
  return is_zero(portion.a, usage) && is_zero(portion.b, usage) && is_zero(portion.c, usage) &&
         is_zero(portion.d, usage);
}
void discard_all(Portion& portion) {
  portion.out.ab = portion.out.cd = portion.out.sum = Register::discard;
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
  const char *name, *rules, *group;
  void (*edit)(CombinerState&);
};

// A model makes its edits in this order: those that read words come first.
const Edit kEdits[] = {
    {"general combiners whose two input words are 0 are skipped", "", "zero-words",
     [](CombinerState& s) {
       for (GeneralCombiner& stage : s.general) {
         if (!has_zero_word(stage.rgb, PortionName::rgb) || !has_zero_word(stage.alpha, PortionName::alpha)) continue;
         discard_all(stage.rgb);
         discard_all(stage.alpha);
       }
     }},
    {"portions whose input word is 0 are skipped", "", "zero-words",
     [](CombinerState& s) {
       change_portions(s, [](Portion& p, PortionName name) {
         if (has_zero_word(p, name)) discard_all(p);
       });
     }},
    {"a final combiner whose two words are 0 shows 0", "", "final-zero-words",
     [](CombinerState& s) {
       // This is how such words are read.
       FinalCombiner shown = s.final_combiner;
       for (CombinerInput* const in : {&shown.a, &shown.b, &shown.c, &shown.e, &shown.f}) {
         if (!is_zero(*in, ComponentUsage::rgb)) return;
       }
       constexpr auto kIdentity = InputMapping::unsigned_identity;
       const bool is_spare0 = shown.d == CombinerInput{Register::spare0, kIdentity, ComponentUsage::rgb} &&
                              shown.g == CombinerInput{Register::spare0, kIdentity, ComponentUsage::alpha};
       if (is_spare0 && !s.color_sum_clamp) s.final_combiner.d = s.final_combiner.g = {};
     }},
    {"mux by the other bit of spare0's alpha", "11", "mux-threshold",
     [](CombinerState& s) { change_mux(s, !s.mux_by_lowest_bit); }},
    {"mux always by the lowest bit of spare0's alpha", "11", "mux-threshold",
     [](CombinerState& s) { change_mux(s, true); }},
    {"mux always by the threshold of spare0's alpha", "11", "mux-lowest-bit",
     [](CombinerState& s) { change_mux(s, false); }},
    {"the sum instead of the mux", "11", "mux-threshold",
     [](CombinerState& s) { change_portions(s, [](Portion& p, PortionName) { p.out.mux_sum = false; }); }},
    {"no bias", "3, 4", "bias",
     [](CombinerState& s) { change_portions(s, [](Portion& p, PortionName) { p.out.bias = Bias::none; }); }},
    {"no scale", "3, 6", "scale-by-two",
     [](CombinerState& s) { change_portions(s, [](Portion& p, PortionName) { p.out.scale = Scale::none; }); }},
    {"products instead of dot products", "", "dot-product-ab",
     [](CombinerState& s) {
       change_portions(s, [](Portion& p, PortionName) { p.out.ab_dot_product = p.out.cd_dot_product = false; });
     }},
    {"no third output beside a dot product", "", "dot-product-sum",
     [](CombinerState& s) {
       change_portions(s, [](Portion& p, PortionName) {
         if (p.out.ab_dot_product || p.out.cd_dot_product) p.out.sum = Register::discard;
       });
     }},
    {"no blue to alpha", "23", "blue-to-alpha",
     [](CombinerState& s) {
       change_portions(s, [](Portion& p, PortionName) { p.out.ab_blue_to_alpha = p.out.cd_blue_to_alpha = false; });
     }},
    {"the alpha portion is written before the RGB portion's blue to alpha", "23", "blue-to-alpha",
     [](CombinerState& s) {
       for (GeneralCombiner& stage : s.general) {
         const PortionOutput& rgb = stage.rgb.out;
         for (Register* const to : {&stage.alpha.out.ab, &stage.alpha.out.cd, &stage.alpha.out.sum}) {
           const bool is_overwritten =
               (rgb.ab_blue_to_alpha && *to == rgb.ab) || (rgb.cd_blue_to_alpha && *to == rgb.cd);
           if (is_overwritten) *to = Register::discard;
         }
       }
     }},
    {"RGB portions read no alpha", "", "component-usage",
     [](CombinerState& s) {
       change_inputs(s, PortionName::rgb, [](CombinerInput& in) { in.usage = ComponentUsage::rgb; });
     }},
    {"alpha portions read alpha instead of blue", "", "component-usage",
     [](CombinerState& s) {
       change_inputs(s, PortionName::alpha, [](CombinerInput& in) { in.usage = ComponentUsage::alpha; });
     }},
    {"one general combiner", "", "number-of-stages", [](CombinerState& s) { s.num_general_combiners = 1; }},
    {"always two general combiners or more", "", "number-of-stages",
     [](CombinerState& s) { s.num_general_combiners = std::max(s.num_general_combiners, 2); }},
    {"eight general combiners count as none", "", "number-of-stages",
     [](CombinerState& s) {
       if (s.num_general_combiners < 8) return;
       change_portions(s, [](Portion& p, PortionName) { discard_all(p); });
     }},
    {"constants as ABGR", "", "constants",
     [](CombinerState& s) { change_constants(s, [](ColorF& c) { std::swap(c[kRed], c[kBlue]); }); }},
    {"alpha of constants is 1", "", "constants",
     [](CombinerState& s) { change_constants(s, [](ColorF& c) { c[kAlpha] = 1; }); }},
    {"stage 0's constants in every stage", "", "constants-of-stages",
     [](CombinerState& s) {
       if (!s.per_stage_constants) return;
       set_stage_constants(s, ColorF(s.general[0].constant0), ColorF(s.general[0].constant1));
     }},
    {"the final combiner's constants in every stage", "", "constants-of-stages",
     [](CombinerState& s) { set_stage_constants(s, s.constant0, s.constant1); }},
    {"each stage's own constants, also where stage 0's are for all", "", "constants",
     [](CombinerState& s) {
       if (s.per_stage_constants) return;
       const ColorF first0 = s.constant0, first1 = s.constant1;
       set_stage_constants(s, {}, {});
       s.general[0].constant0 = first0;
       s.general[0].constant1 = first1;
     }},
    {"stage 0's constants in the final combiner", "", "constants-of-stages",
     [](CombinerState& s) {
       if (!s.per_stage_constants) return;
       s.constant0 = s.general[0].constant0;
       s.constant1 = s.general[0].constant1;
     }},
    {"the last stage's constants in the final combiner", "", "constants-of-stages",
     [](CombinerState& s) {
       if (!s.per_stage_constants) return;
       const GeneralCombiner& last = s.general[static_cast<std::size_t>(s.num_general_combiners - 1)];
       s.constant0 = last.constant0;
       s.constant1 = last.constant1;
     }},
    {"the colour sum always clamped", "13", "color-sum-unclamped", [](CombinerState& s) { s.color_sum_clamp = true; }},
    {"the colour sum never clamped", "13", "color-sum-clamped", [](CombinerState& s) { s.color_sum_clamp = false; }},
    {"the colour sum never inverted", "13, 23", "color-sum-inverted",
     [](CombinerState& s) { s.color_sum_invert_spare0 = s.color_sum_invert_secondary = false; }},
    {"the colour sum's two inversions exchanged", "13, 23", "color-sum-inverted",
     [](CombinerState& s) { std::swap(s.color_sum_invert_spare0, s.color_sum_invert_secondary); }},
    {"E times F is 0", "10", "final-e-times-f",
     [](CombinerState& s) {
       s.final_combiner.e = {Register::zero, InputMapping::unsigned_identity};
     }},
    {"D of the final combiner is not added", "9", "final-d",
     [](CombinerState& s) {
       s.final_combiner.d = {Register::zero, InputMapping::unsigned_identity};
     }},
};

struct NamedBrokenRule {
  const char *name, *rules, *group;
  BrokenRule broken;
  bool in_general = true, in_final = true;
};

const NamedBrokenRule kBrokenRules[] = {
    {"negative inputs are not clamped to 0", "2, 14", "negative-texels", BrokenRule::negative_inputs},
    {"mappings other than unsigned identity keep the sign", "2", "negative-texels", BrokenRule::signed_mappings},
    {"1 - x of x above 1 is negative", "2", "color-sum-unclamped", BrokenRule::invert_above_one},
    {"alpha portions read red instead of blue", "", "component-usage", BrokenRule::alpha_reads_red},
    {"outputs of general combiners are clamped to [0, 1]", "", "negative-registers", BrokenRule::outputs_from_zero},
    {"outputs of general combiners are not clamped", "", "results-below-minus-1", BrokenRule::outputs_unclamped},
    {"third outputs of general combiners are not clamped", "", "results-below-minus-1", BrokenRule::thirds_unclamped},
    {"the bias is added after the scale", "3", "bias-then-scale", BrokenRule::bias_after_scale},
    {"a sum has the bias of each of its products", "3", "bias", BrokenRule::bias_of_products},
    {"each product is rounded before the sum", "7", "sum", BrokenRule::products_narrowed},
    {"sums are clamped before bias and scale", "22", "scale-by-one-half", BrokenRule::sums_clamped},
    {"the third output beside a dot product is of the products", "", "dot-product-sum", BrokenRule::thirds_of_products},
    {"the mux takes AB for CD", "11", "mux-threshold", BrokenRule::mux_swapped},
    {"the mux compares spare0's alpha by > instead of >=", "11", "mux-threshold", BrokenRule::mux_above_half},
    {"the alpha portion reads what the RGB portion wrote", "12", "reads-before-writes", BrokenRule::portions_in_turn},
    {"C and D read what AB wrote", "12", "reads-before-writes", BrokenRule::products_in_turn},
    {"general combiners round down", "5, 8", "product", BrokenRule::rounded_down},
    {"general combiners round halves away from zero", "5", "negative-halves", BrokenRule::halves_from_zero},
    {"half = 127.5", "4", "mapping-half-bias-normal", BrokenRule::half_exact},
    {"a shift by 8 instead of a division by 255", "9, 10", "final-reads", BrokenRule::shifted},
    {"general combiners shift by 8", "5, 8", "general-reads", BrokenRule::shifted, true, false},
    {"the final combiner shifts by 8", "9, 10", "final-reads", BrokenRule::shifted, false, true},
    {"a shift by 8, bias half * 255", "4, 9, 10", "final-reads", BrokenRule::shifted_bias_255},
    {"general combiners shift by 8, bias half * 255", "4, 5, 8", "general-reads", BrokenRule::shifted_bias_255, true,
     false},
    {"a shift by 8 before the bias", "7, 9, 10", "final-reads", BrokenRule::sums_shifted},
    {"general combiners shift by 8 before the bias", "5, 7, 8", "general-reads", BrokenRule::sums_shifted, true, false},
    {"a shift by 8 of each product", "7, 9, 10", "final-reads", BrokenRule::products_shifted},
    {"general combiners shift each product by 8", "5, 7, 8", "general-reads", BrokenRule::products_shifted, true,
     false},
    {"spare0's alpha starts as 0", "", "start-registers", BrokenRule::spare0_alpha_zero},
    {"spare1's alpha starts as texture 1's", "", "start-registers", BrokenRule::spare1_alpha_tex1},
    {"spare0's RGB and spare1 keep the last fragment's values", "", "start-registers", BrokenRule::registers_kept},
    {"spare0's alpha keeps the last fragment's value", "", "start-registers", BrokenRule::spare0_alpha_kept},
    {"the colour sum adds negative registers", "13, 14", "final-negative", BrokenRule::sum_negative},
    {"E times F is not rounded", "10", "final-e-times-f", BrokenRule::e_times_f_exact},
    {"AB + (1 - A)C is not rounded before D is added", "9", "final-e-times-f", BrokenRule::mix_exact},
    {"AB and (1 - A)C are rounded one by one", "9", "final-mix", BrokenRule::mix_of_narrowed},
    {"bytes of the colour are cut, not rounded", "9", "final-ab", BrokenRule::colors_cut},
    {"red and blue of the colour are exchanged", "", "final-reads", BrokenRule::red_blue_swapped},
    {"G of the final combiner reads red instead of blue", "", "final-g", BrokenRule::g_reads_red},
};

// The groups of the fields' other values.
struct FieldGroupName {
  std::string_view field;
  const char* group;
};
constexpr FieldGroupName kFieldGroups[] = {
    {"lowest", ""},
    {"lowest_output", "results-below-minus-1"},
    {"half", "mapping-half-bias-normal"},
    {"expand_offset", "mapping-expand-normal"},
    {"general_narrowing", "product"},
    {"narrowing_point", "scale-by-two"},
    {"final_narrowing", "final-ab"},
};

std::string group_of_field(std::string_view field) {
  const auto* const found = std::find_if(std::begin(kFieldGroups), std::end(kFieldGroups),
                                         [&](const FieldGroupName& one) { return one.field == field; });
  return found == std::end(kFieldGroups) ? "" : found->group;
}

// The group in a pack of a profile: without signed texels, or where products are cut, another one fails first.
std::string group_in(const HardwareProfile& profile, const Mistake& mistake) {
  if (mistake.group == "negative-texels" && !is_nv20(profile)) return "negative-registers";
  if (profile.general_narrowing.value == Narrowing::nearest_halves_up) return mistake.group;
  const auto breaks = [&](BrokenRule rule) { return mistake.in_general[static_cast<std::size_t>(rule)]; };
  if (breaks(BrokenRule::rounded_down)) return "negative-results";
  return breaks(BrokenRule::halves_from_zero) ? "product" : mistake.group;
}

BrokenRules only(BrokenRule broken, bool is_broken) {
  BrokenRules rules;
  rules[static_cast<std::size_t>(broken)] = is_broken;
  return rules;
}

}  // namespace

std::vector<Mistake> mistakes_of(const HardwareProfile& profile) {
  std::vector<Mistake> found;
  for (const CombinerField& field : arithmetic_fields(profile)) {
    for (std::size_t i = 1; i < field.values.size(); ++i) {
      found.push_back({std::string(field.name) + " = " + field.values[i].word, std::string(field.rules),
                       group_of_field(field.name), field.values[i].set});
    }
  }
  if (profile.arithmetic.value == Arithmetic::integer) {
    // Nothing is rounded between stages.
    for (const auto& [name, arithmetic] :
         {std::pair("arithmetic = float32", Arithmetic::float32), std::pair("arithmetic = exact", Arithmetic::exact)}) {
      found.push_back({name, "5, 8", "mapping-half-bias-normal",
                       [value = arithmetic](HardwareProfile& p) { p.arithmetic.value = value; }});
    }
    found.push_back({"arithmetic = float32, and bytes of the colour are cut, not rounded",
                     "5, 8, 9",
                     "mapping-unsigned-invert",
                     [](HardwareProfile& p) { p.arithmetic.value = Arithmetic::float32; },
                     {},
                     only(BrokenRule::colors_cut, true)});
    BrokenRules when_read = only(BrokenRule::outputs_unclamped, true);
    when_read |= only(BrokenRule::identity_to_one, true);
    found.push_back({"outputs of general combiners are clamped to 1 only where they are read as unsigned identity",
                     "",
                     "results-below-minus-1",
                     {},
                     when_read,
                     only(BrokenRule::identity_to_one, true)});
    for (const NamedBrokenRule& one : kBrokenRules) {
      found.push_back(
          {one.name, one.rules, one.group, {}, only(one.broken, one.in_general), only(one.broken, one.in_final)});
    }
  }
  for (const Edit& one : kEdits) found.push_back({one.name, one.rules, one.group, {}, {}, {}, one.edit});
  for (Mistake& one : found) one.group = group_in(profile, one);
  return found;
}

}  // namespace ninebit::vectors

// Groups of combinations: two things at once, then random programs.
#include <array>

#include "src/study/vectors/vector_groups.h"

namespace ninebit::vectors {
namespace {

CombinerInput random_input(Maker& m, PortionName portion) {
  constexpr std::array kOthers{Register::zero,   Register::constant0, Register::constant1, Register::fog,
                               Register::spare0, Register::spare0,    Register::spare0,    Register::spare1};
  CombinerInput in;
  in.reg = m.random.one_in(2) ? m.random_source() : kOthers[static_cast<std::size_t>(m.random.below(8))];
  in.mapping = kInputMappings[static_cast<std::size_t>(m.random.below(8))];
  const bool alpha = in.reg != Register::fog && m.random.one_in(portion == PortionName::rgb ? 4 : 2);
  in.usage = alpha ? ComponentUsage::alpha : portion == PortionName::alpha ? ComponentUsage::blue : ComponentUsage::rgb;
  return in;
}

PortionOutput random_output(Maker& m, PortionName portion) {
  PortionOutput out;
  out.sum = m.random.one_in(4) ? Register::discard : m.random.one_in(2) ? Register::spare0 : m.random_target();
  for (Register* const to : {&out.ab, &out.cd}) {
    const Register r = m.random_target();
    if (m.random.one_in(4) && r != out.ab && r != out.cd && r != out.sum) *to = r;
  }
  if (out.sum == Register::discard && out.ab == Register::discard && out.cd == Register::discard) {
    out.sum = Register::spare0;
  }
  out.scale = m.random.one_in(2) ? Scale::none : static_cast<Scale>(m.random.below(4));
  const bool may_bias = out.scale == Scale::none || out.scale == Scale::by_two;
  if (may_bias && m.random.one_in(4)) out.bias = Bias::by_negative_one_half;
  if (portion == PortionName::rgb) {
    out.ab_dot_product = m.random.one_in(5);
    out.cd_dot_product = m.random.one_in(5);
    const bool has = m.profile.blue_to_alpha.value;
    out.ab_blue_to_alpha = has && out.ab != Register::discard && m.random.one_in(3);
    out.cd_blue_to_alpha = has && out.cd != Register::discard && m.random.one_in(3);
  }
  out.mux_sum = out.sum != Register::discard && m.random.one_in(4);
  return out;
}

void randomize_portion(Maker& m, Portion& portion, PortionName name) {
  for (CombinerInput* const in : {&portion.a, &portion.b, &portion.c, &portion.d}) *in = random_input(m, name);
  portion.out = random_output(m, name);
}

void randomize_globals(Maker& m, CombinerState& state) {
  state.constant0 = m.color();
  state.constant1 = m.color();
  state.color_sum_clamp = m.random.one_in(2);
  state.mux_by_lowest_bit = m.profile.mux_by_lowest_bit.value && m.random.one_in(2);
  state.color_sum_invert_spare0 = m.profile.color_sum_inverts.value && m.random.one_in(4);
  state.color_sum_invert_secondary = m.profile.color_sum_inverts.value && m.random.one_in(4);
}

CombinerInput random_final_input(Maker& m, Variable variable) {
  constexpr std::array kOthers{Register::zero,   Register::constant0, Register::constant1, Register::fog,
                               Register::spare0, Register::spare0,    Register::spare0,    Register::spare1};
  CombinerInput in;
  in.reg = m.random.one_in(3) ? m.random_source() : kOthers[static_cast<std::size_t>(m.random.below(8))];
  in.mapping = m.random.one_in(3) ? InputMapping::unsigned_invert : InputMapping::unsigned_identity;
  if (variable == Variable::g) {
    in.usage = m.random.one_in(2) ? ComponentUsage::alpha : ComponentUsage::blue;
    return in;
  }
  in.usage = m.random.one_in(4) ? ComponentUsage::alpha : ComponentUsage::rgb;
  if (variable <= Variable::d && m.random.one_in(4)) {
    const bool sum = variable != Variable::a && m.random.one_in(2);
    in.reg = sum ? Register::spare0_plus_secondary : Register::e_times_f;
    in.usage = ComponentUsage::rgb;
  }
  return in;
}

void randomize_final(Maker& m, FinalCombiner& f) {
  f.a = random_final_input(m, Variable::a);
  f.b = random_final_input(m, Variable::b);
  f.c = random_final_input(m, Variable::c);
  f.d = m.random.one_in(2) ? kNothing : random_final_input(m, Variable::d);
  f.e = random_final_input(m, Variable::e);
  f.f = random_final_input(m, Variable::f);
  f.g = random_final_input(m, Variable::g);
}

// One of the things that groups before test alone.
void add_thing(Maker& m, int thing, CombinerState& state) {
  GeneralCombiner& stage = state.general[0];
  Portion& portion = m.random.one_in(2) ? stage.rgb : stage.alpha;
  switch (thing) {
    case 0:
      portion.a.mapping = kInputMappings[static_cast<std::size_t>(m.random.below(8))];
      break;
    case 1:
      portion.c.mapping = kInputMappings[static_cast<std::size_t>(m.random.below(8))];
      break;
    case 2:
      portion.out.scale = static_cast<Scale>(1 + m.random.below(3));
      portion.out.bias = Bias::none;
      break;
    case 3:
      portion.out.bias = Bias::by_negative_one_half;
      if (portion.out.scale != Scale::by_two) portion.out.scale = Scale::none;
      break;
    case 4:
      portion.out.mux_sum = true;
      break;
    case 5:
      (m.random.one_in(2) ? stage.rgb.out.ab_dot_product : stage.rgb.out.cd_dot_product) = true;
      break;
    case 6:
      portion.d = portion.a;
      portion.d.mapping = InputMapping::unsigned_invert;
      break;
    default:
      state.final_combiner.a = rgb_of(m.random_source());
      state.final_combiner.b = rgb_of(m.random_source());
  }
}

CombinerState two_things(Maker& m) {
  constexpr int kThings = 8;
  CombinerState state = shows_spare0();
  set_inputs(state.general[0], rgb_of(m.random_source()), rgb_of(m.random_source()), rgb_of(m.random_source()),
             m.random.one_in(2) ? kPlusOne : rgb_of(m.random_source()));
  const int first = m.of(kThings);
  add_thing(m, first, state);
  add_thing(m, (first + 1 + m.of(kThings - 1)) % kThings, state);
  return state;
}

CombinerState random_rgb(Maker& m) {
  CombinerState state = shows_spare0();
  state.constant0 = m.color();
  randomize_portion(m, state.general[0].rgb, PortionName::rgb);
  state.general[0].rgb.out.sum = Register::spare0;
  for (Register* const to : {&state.general[0].rgb.out.ab, &state.general[0].rgb.out.cd}) {
    if (*to == Register::spare0) *to = Register::discard;
  }
  return state;
}

CombinerState random_alpha(Maker& m) {
  CombinerState state = shows_spare0();
  Portion& portion = state.general[0].alpha;
  randomize_portion(m, portion, PortionName::alpha);
  portion.out.ab = portion.out.cd = Register::discard;
  portion.out.sum = Register::spare0;
  return state;
}

CombinerState random_final(Maker& m) {
  CombinerState state;
  randomize_globals(m, state);
  set_inputs(state.general[0], rgb_of(m.random_source(), InputMapping::half_bias_normal), kPlusOne);
  randomize_final(m, state.final_combiner);
  return state;
}

CombinerState random_stages(Maker& m, int stages) {
  CombinerState state = shows_spare0();
  randomize_globals(m, state);
  state.num_general_combiners = stages;
  state.per_stage_constants = m.profile.per_stage_constants.value && m.random.one_in(2);
  for (int i = 0; i < stages; ++i) {
    GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    randomize_portion(m, stage.rgb, PortionName::rgb);
    randomize_portion(m, stage.alpha, PortionName::alpha);
    if (!state.per_stage_constants) continue;
    stage.constant0 = m.color();
    stage.constant1 = m.color();
  }
  if (m.random.one_in(2)) randomize_final(m, state.final_combiner);
  return state;
}
CombinerState random_stage(Maker& m) {
  return random_stages(m, 1);
}
CombinerState random_two_stages(Maker& m) {
  return random_stages(m, 2);
}
CombinerState random_many_stages(Maker& m) {
  return random_stages(m, 3 + m.of(m.profile.general_combiners.value - 2));
}

constexpr Group kMixedGroups[] = {
    {"two-things", "", "two things of the groups above in one stage", 300, Inputs::bytes, two_things},
    {"random-rgb", "", "a random RGB portion", 200, Inputs::bytes, random_rgb},
    {"random-alpha", "", "a random alpha portion", 120, Inputs::bytes, random_alpha},
    {"random-final", "", "a random final combiner", 160, Inputs::bytes, random_final},
    {"random-negative", "", "a random RGB portion of textures with negative codes", 120, Inputs::signed_texels,
     random_rgb, is_nv20},
    {"random-stage", "", "a random general combiner", 60, Inputs::bytes, random_stage},
    {"random-two-stages", "", "two random general combiners", 24, Inputs::bytes, random_two_stages,
     [](const HardwareProfile& p) { return p.general_combiners.value > 1; }},
    {"random-stages", "", "three and more random general combiners", 12, Inputs::signed_texels, random_many_stages,
     [](const HardwareProfile& p) { return p.general_combiners.value > 2; }},
};

}  // namespace

std::span<const Group> mixed_groups() {
  return kMixedGroups;
}

}  // namespace ninebit::vectors

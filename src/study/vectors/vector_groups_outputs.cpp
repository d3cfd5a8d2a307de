// Groups on what a general combiner computes: products, sums, dot products, outputs, scale and bias.
#include <array>

#include "src/study/vectors/vector_groups.h"

namespace ninebit::vectors {
namespace {

CombinerState product(Maker& m) {
  CombinerState state = shows_spare0();
  const Register first = m.source(), second = m.source();
  set_inputs(state.general[0], rgb_of(first), rgb_of(second));
  return state;
}

// The mappings that give a sign.
InputMapping any_signed(Maker& m) {
  constexpr std::array kSigned{InputMapping::signed_negate, InputMapping::expand_normal, InputMapping::expand_negate,
                               InputMapping::half_bias_normal, InputMapping::half_bias_negate};
  return m.of(std::span<const InputMapping>(kSigned));
}

CombinerState signed_product(Maker& m) {
  CombinerState state = shows_spare0();
  const InputMapping first = any_signed(m), second = any_signed(m);
  set_inputs(state.general[0], rgb_of(m.random_source(), first), rgb_of(m.random_source(), second));
  return state;
}

ColorF grey(int byte) {
  const float value = static_cast<float>(byte) / 255.0F;
  return {value, value, value, value};
}

// A constant at the edges times a register, in every pair of mappings; negated by stage 1 in half of the programs.
CombinerState extremes(Maker& m) {
  constexpr std::array kEdges{0, 1, 127, 128, 254, 255};
  CombinerState state = shows_spare0();
  const InputMapping first = kInputMappings[static_cast<std::size_t>(m.of(8))];
  const InputMapping second = kInputMappings[static_cast<std::size_t>(m.of(8))];
  for (float& component : state.constant0) {
    component = static_cast<float>(kEdges[static_cast<std::size_t>(m.random.below(6))]) / 255.0F;
  }
  set_inputs(state.general[0], rgb_of(Register::constant0, first), rgb_of(m.random_source(), second));
  if (m.of(2) == 0) return state;
  state.num_general_combiners = 2;
  state.general[1] = negating_stage();
  return state;
}

CombinerState sum(Maker& m) {
  CombinerState state = shows_spare0();
  const bool of_products = m.of(2) == 1;
  const Register first = m.source();
  const CombinerInput b = of_products ? rgb_of(m.random_source()) : kPlusOne;
  const CombinerInput d = of_products ? rgb_of(m.random_source()) : kPlusOne;
  set_inputs(state.general[0], rgb_of(first), b, rgb_of(m.random_source()), d);
  return state;
}

CombinerState difference(Maker& m) {
  CombinerState state = sum(m);
  GeneralCombiner& stage = state.general[0];
  stage.rgb.c.mapping = stage.alpha.c.mapping = InputMapping::signed_negate;
  return state;
}

// Results in [-2, 0]: stage 1 shows them negated.
CombinerState negative_results(Maker& m) {
  CombinerState state = m.of(2) == 0 ? product(m) : sum(m);
  state.num_general_combiners = 2;
  GeneralCombiner& stage = state.general[0];
  for (Portion* const portion : {&stage.rgb, &stage.alpha}) {
    portion->a.mapping = portion->c.mapping = InputMapping::signed_negate;
  }
  state.general[1] = negating_stage();
  return state;
}

// Stage 0 makes -1 - x, which is clamped to -1. Stage 1 shows -spare0 - c with a constant c, because -spare0 alone
// would be clamped to 1.
CombinerState results_below(Maker& m) {
  CombinerState state = shows_spare0();
  state.num_general_combiners = 2;
  state.constant0 = grey(1 + m.random.below(254));
  state.constant1 = grey(255);
  set_inputs(state.general[0], rgb_of(m.source(), InputMapping::signed_negate), kPlusOne,
             rgb_of(Register::constant1, InputMapping::signed_negate), kPlusOne);
  set_inputs(state.general[1], rgb_of(Register::spare0, InputMapping::signed_negate), kPlusOne,
             rgb_of(Register::constant0, InputMapping::signed_negate), kPlusOne);
  return state;
}

// Halves of negative codes: stage 1 shows them negated.
CombinerState negative_halves(Maker& m) {
  CombinerState state = shows_spare0();
  state.num_general_combiners = 2;
  set_inputs(state.general[0], rgb_of(m.source(), InputMapping::signed_negate), kPlusOne);
  set_scale(state.general[0], Scale::by_one_half);
  state.general[1] = negating_stage();
  return state;
}

CombinerState outputs(Maker& m) {
  constexpr std::array kTargets{Register::spare1, Register::primary, Register::secondary, Register::texture0,
                                Register::texture1};
  CombinerState state = shows_spare0();
  GeneralCombiner& stage = state.general[0];
  const int output = m.of(2);
  const Register to = m.of(std::span<const Register>(kTargets));
  const bool third = m.of(2) == 1;
  set_inputs(stage, rgb_of(m.random_source()), rgb_of(m.random_source()), rgb_of(m.random_source()), kPlusOne);
  for (PortionOutput* const out : {&stage.rgb.out, &stage.alpha.out}) {
    (output == 0 ? out->ab : out->cd) = to;
    if (!third) out->sum = Register::discard;
  }
  set_final(state, kNothing, kNothing, rgb_of(to), third && m.of(2) == 1 ? rgb_of(Register::spare0) : kNothing);
  state.final_combiner.g = alpha_of(to);
  return state;
}

CombinerState scaled(Maker& m, Scale scale, Bias bias) {
  CombinerState state;
  // Halves of negative results have a group of their own.
  switch (m.of(scale == Scale::by_one_half ? 3 : 4)) {
    case 0:
      state = shows_spare0();
      set_inputs(state.general[0], rgb_of(m.source()), kPlusOne);
      break;
    case 1:
      state = product(m);
      break;
    case 2:
      state = sum(m);
      break;
    default:
      state = negative_results(m);
  }
  set_scale(state.general[0], scale, bias);
  return state;
}

template <Scale kScale, Bias kBias>
CombinerState scale_group(Maker& m) {
  return scaled(m, kScale, kBias);
}

// Scales of one portion alone.
CombinerState portion_scales(Maker& m) {
  CombinerState state = product(m);
  GeneralCombiner& stage = state.general[0];
  (m.of(2) == 0 ? stage.rgb : stage.alpha).out.scale = static_cast<Scale>(1 + m.of(3));
  return state;
}

CombinerState dot(Maker& m, bool ab, bool cd) {
  CombinerState state = shows_spare0();
  GeneralCombiner& stage = state.general[0];
  const bool is_signed = m.of(2) == 1;
  const InputMapping mapping = is_signed ? InputMapping::expand_normal : InputMapping::unsigned_identity;
  const Register first = m.source();
  set_inputs(stage, rgb_of(first, mapping), rgb_of(m.random_source(), mapping), rgb_of(m.random_source(), mapping),
             rgb_of(m.random_source(), mapping));
  PortionOutput& out = stage.rgb.out;
  out.ab_dot_product = ab;
  out.cd_dot_product = cd;
  if (!(ab && cd)) {
    (ab ? out.ab : out.cd) = Register::spare0;
    out.sum = Register::discard;
  }
  out.scale = static_cast<Scale>(m.of(4));
  return state;
}
CombinerState dot_ab(Maker& m) {
  return dot(m, true, false);
}
CombinerState dot_cd(Maker& m) {
  return dot(m, false, true);
}
// Two dot products, or one and a product, which OpenGL's own language cannot add but the registers can.
CombinerState dot_sum(Maker& m) {
  CombinerState state = dot(m, true, true);
  if (m.random.one_in(2)) state.general[0].rgb.out.cd_dot_product = false;
  return state;
}

// A dot product above 1 is clamped to 1: stage 1 shows its half.
CombinerState dot_above(Maker& m) {
  CombinerState state = shows_spare0();
  state.num_general_combiners = 2;
  const bool ab = m.of(2) == 0;
  const CombinerInput in = rgb_of(m.source());
  GeneralCombiner& stage = state.general[0];
  set_inputs(stage, in, kPlusOne, in, kPlusOne);
  PortionOutput& out = stage.rgb.out;
  (ab ? out.ab_dot_product : out.cd_dot_product) = true;
  (ab ? out.ab : out.cd) = Register::spare0;
  out.sum = Register::discard;
  set_inputs(state.general[1], rgb_of(Register::spare0), kPlusOne);
  set_scale(state.general[1], Scale::by_one_half);
  return state;
}

constexpr Bias kNoBias = Bias::none, kMinusHalf = Bias::by_negative_one_half;

constexpr Group kOutputGroups[] = {
    {"product", "8", "spare0 = AB of two registers", 24, Inputs::bytes, product},
    {"product-signed", "8", "AB of mappings that give a sign", 24, Inputs::bytes, signed_product},
    {"product-extremes", "", "AB of 0, 1, 127, 128, 254, 255 and a register, in every pair of mappings", 24,
     Inputs::bytes, extremes, has_stages},
    {"sum", "7, 22", "AB + CD", 24, Inputs::bytes, sum},
    {"difference", "7, 22", "AB - CD", 24, Inputs::bytes, difference},
    {"negative-results", "", "results in [-2, 0], negated by stage 1", 24, Inputs::bytes, negative_results, has_stages},
    {"results-below-minus-1", "", "results in [-2, -1] are clamped to -1", 12, Inputs::bytes, results_below,
     has_stages},
    {"outputs", "", "AB and CD go to other registers, with and without the third output", 20, Inputs::bytes, outputs},
    {"scale-by-two", "6", "times 2", 16, Inputs::bytes, scale_group<Scale::by_two, kNoBias>, has_stages},
    {"scale-by-four", "6", "times 4", 16, Inputs::bytes, scale_group<Scale::by_four, kNoBias>, has_stages},
    {"scale-by-one-half", "5", "divided by 2", 16, Inputs::bytes, scale_group<Scale::by_one_half, kNoBias>, has_stages},
    {"negative-halves", "5", "negative codes divided by 2", 12, Inputs::bytes, negative_halves, has_stages},
    {"bias", "4", "minus 1/2", 16, Inputs::bytes, scale_group<Scale::none, kMinusHalf>, has_stages},
    {"bias-then-scale", "3, 4", "minus 1/2, then times 2", 16, Inputs::bytes, scale_group<Scale::by_two, kMinusHalf>,
     has_stages},
    {"scale-of-a-portion", "6", "RGB and alpha portion have scales of their own", 8, Inputs::bytes, portion_scales},
    {"dot-product-ab", "7, 22", "AB is a dot product", 20, Inputs::bytes, dot_ab},
    {"dot-product-cd", "7, 22", "CD is a dot product", 20, Inputs::bytes, dot_cd},
    {"dot-product-above-1", "", "a dot product above 1 is clamped to 1", 8, Inputs::bytes, dot_above, has_stages},
    {"dot-product-sum", "7, 22", "the sum of two dot products, or of one and a product", 20, Inputs::bytes, dot_sum},
};

}  // namespace

std::span<const Group> output_groups() {
  return kOutputGroups;
}

// Groups of combinations: two things at once, then random programs.

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
    {"random-two-stages", "", "two random general combiners", 24, Inputs::bytes, random_two_stages, has_stages},
    {"random-stages", "", "three and more random general combiners", 12, Inputs::signed_texels, random_many_stages,
     [](const HardwareProfile& p) { return p.general_combiners.value > 2; }},
};

}  // namespace

std::span<const Group> mixed_groups() {
  return kMixedGroups;
}

}  // namespace ninebit::vectors

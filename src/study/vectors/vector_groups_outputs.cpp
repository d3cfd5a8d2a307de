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
  switch (m.of(4)) {
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

constexpr Bias kNoBias = Bias::none, kMinusHalf = Bias::by_negative_one_half;
bool has_two_stages(const HardwareProfile& p) {
  return p.general_combiners.value > 1;
}

constexpr Group kOutputGroups[] = {
    {"product", "8", "spare0 = AB of two registers", 24, Inputs::bytes, product},
    {"product-signed", "8", "AB of mappings that give a sign", 24, Inputs::bytes, signed_product},
    {"product-extremes", "", "AB of 0, 1, 127, 128, 254, 255 and a register, in every pair of mappings", 24,
     Inputs::bytes, extremes, has_two_stages},
    {"sum", "7, 22", "AB + CD", 24, Inputs::bytes, sum},
    {"difference", "7, 22", "AB - CD", 24, Inputs::bytes, difference},
    {"negative-results", "", "results in [-2, 0], negated by stage 1", 24, Inputs::bytes, negative_results,
     has_two_stages},
    {"results-below-minus-1", "", "results in [-2, -1] are clamped to -1", 12, Inputs::bytes, results_below,
     has_two_stages},
    {"outputs", "", "AB and CD go to other registers, with and without the third output", 20, Inputs::bytes, outputs},
    {"scale-by-two", "6", "times 2", 16, Inputs::bytes, scale_group<Scale::by_two, kNoBias>, has_two_stages},
    {"scale-by-four", "6", "times 4", 16, Inputs::bytes, scale_group<Scale::by_four, kNoBias>, has_two_stages},
    {"scale-by-one-half", "5", "divided by 2", 16, Inputs::bytes, scale_group<Scale::by_one_half, kNoBias>,
     has_two_stages},
    {"negative-halves", "5", "negative codes divided by 2", 12, Inputs::bytes, negative_halves, has_two_stages},
    {"bias", "4", "minus 1/2", 16, Inputs::bytes, scale_group<Scale::none, kMinusHalf>, has_two_stages},
    {"bias-then-scale", "3, 4", "minus 1/2, then times 2", 16, Inputs::bytes, scale_group<Scale::by_two, kMinusHalf>,
     has_two_stages},
    {"scale-of-a-portion", "6", "RGB and alpha portion have scales of their own", 8, Inputs::bytes, portion_scales},
    {"dot-product-ab", "7, 22", "AB is a dot product", 20, Inputs::bytes, dot_ab},
    {"dot-product-cd", "7, 22", "CD is a dot product", 20, Inputs::bytes, dot_cd},
    {"dot-product-sum", "7, 22", "the sum of two dot products, or of one and a product", 20, Inputs::bytes, dot_sum},
};

}  // namespace

std::span<const Group> output_groups() {
  return kOutputGroups;
}

}  // namespace ninebit::vectors

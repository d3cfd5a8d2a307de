// Groups on stages: the mux and blue to alpha; then those on the final combiner.
#include "src/study/vectors/vector_groups.h"

namespace ninebit::vectors {
namespace {

// A mux in one portion; spare0's alpha is still that of texture 0.
CombinerState mux(Maker& m, bool by_lowest_bit) {
  CombinerState state = shows_spare0();
  state.mux_by_lowest_bit = by_lowest_bit;
  GeneralCombiner& stage = state.general[0];
  const bool of_products = m.of(3) == 2;
  set_inputs(stage, rgb_of(m.source()), of_products ? rgb_of(m.random_source()) : kPlusOne, rgb_of(m.random_source()),
             of_products ? rgb_of(m.random_source()) : kPlusOne);
  switch (m.of(3)) {
    case 0:
      stage.rgb.out.mux_sum = true;
      break;
    case 1:
      stage.alpha.out.mux_sum = true;
      break;
    default:
      stage.rgb.out.mux_sum = stage.alpha.out.mux_sum = true;
  }
  return state;
}
CombinerState mux_threshold(Maker& m) {
  return mux(m, false);
}
CombinerState mux_lowest_bit(Maker& m) {
  return mux(m, true);
}

// Stage 0 writes spare0's alpha, negative ones among it; stage 1 muxes by it.
CombinerState mux_of_results(Maker& m) {
  CombinerState state = shows_spare0();
  state.num_general_combiners = 2;
  state.mux_by_lowest_bit = m.profile.mux_by_lowest_bit.value && m.of(2) == 1;
  GeneralCombiner& first = state.general[0];
  set_inputs(first, rgb_of(m.source()), rgb_of(m.random_source()));
  if (m.of(2) == 1) first.alpha.a.mapping = InputMapping::half_bias_normal;
  GeneralCombiner& second = state.general[1];
  set_inputs(second, rgb_of(m.random_source()), kPlusOne, rgb_of(m.random_source(), InputMapping::unsigned_invert),
             kPlusOne);
  second.rgb.out.mux_sum = second.alpha.out.mux_sum = true;
  return state;
}

CombinerState blue_to_alpha(Maker& m) {
  CombinerState state = shows_spare0();
  GeneralCombiner& stage = state.general[0];
  const bool ab = m.of(2) == 0;
  const bool alpha_writes_too = m.of(3) == 2;
  set_inputs(stage, rgb_of(m.source()), rgb_of(m.random_source()), rgb_of(m.random_source()), kPlusOne);
  PortionOutput& out = stage.rgb.out;
  (ab ? out.ab : out.cd) = Register::spare0;
  (ab ? out.ab_blue_to_alpha : out.cd_blue_to_alpha) = true;
  out.sum = Register::discard;
  if (!alpha_writes_too) stage.alpha.out.sum = Register::discard;
  return state;
}

constexpr Group kStageGroups[] = {
    {"mux-threshold", "11, 22", "the mux takes CD where spare0's alpha is at least 1/2", 30, Inputs::bytes,
     mux_threshold},
    {"mux-lowest-bit", "11", "the mux takes CD where spare0's alpha is odd", 30, Inputs::bytes, mux_lowest_bit,
     [](const HardwareProfile& p) { return p.mux_by_lowest_bit.value; }},
    {"mux-of-results", "11", "stage 1 muxes by the alpha that stage 0 wrote", 24, Inputs::bytes, mux_of_results,
     has_stages},
    {"blue-to-alpha", "23", "the blue of AB or CD goes to alpha, too", 20, Inputs::bytes, blue_to_alpha,
     [](const HardwareProfile& p) { return p.blue_to_alpha.value; }},
};

}  // namespace

std::span<const Group> stage_groups() {
  return kStageGroups;
}

// Groups on the final combiner. Their general combiners pass registers or do nothing.

namespace {

// The general combiner does nothing.
CombinerState final_alone() {
  CombinerState state;
  state.general[0] = idle_stage();
  return state;
}

CombinerState final_d(Maker& m) {
  CombinerState state = final_alone();
  set_final(state, kNothing, kNothing, kNothing, rgb_of(m.source()));
  return state;
}
CombinerState final_product(Maker& m) {
  CombinerState state = final_alone();
  const Register a = m.source(), b = m.source();
  set_final(state, rgb_of(a), rgb_of(b), kNothing);
  return state;
}
CombinerState final_rest(Maker& m) {
  CombinerState state = final_alone();
  const Register a = m.source(), c = m.source();
  set_final(state, rgb_of(a), kNothing, rgb_of(c));
  return state;
}
CombinerState final_mix(Maker& m) {
  CombinerState state = final_alone();
  const Register a = m.source();
  set_final(state, rgb_of(a), rgb_of(m.random_source()), rgb_of(m.random_source()));
  return state;
}
CombinerState final_add(Maker& m) {
  CombinerState state = final_mix(m);
  state.final_combiner.d = rgb_of(m.random_source());
  return state;
}

CombinerInput& input_of(FinalCombiner& f, int variable) {
  CombinerInput* const inputs[] = {&f.a, &f.b, &f.c, &f.d};
  return *inputs[variable];
}

CombinerState final_invert(Maker& m) {
  const int variable = m.of(4);
  CombinerState state = final_add(m);
  input_of(state.final_combiner, variable).mapping = InputMapping::unsigned_invert;
  return state;
}
CombinerState final_usage(Maker& m) {
  const int variable = m.of(4);
  CombinerState state = final_add(m);
  input_of(state.final_combiner, variable).usage = ComponentUsage::alpha;
  return state;
}
CombinerState final_g(Maker& m) {
  CombinerState state = final_alone();
  const InputMapping mapping = m.of(2) == 0 ? InputMapping::unsigned_identity : InputMapping::unsigned_invert;
  const bool blue = m.of(2) == 1;
  const Register reg = m.of(4) == 3 ? Register::fog : m.source();
  state.final_combiner.g = blue ? blue_of(reg, mapping) : alpha_of(reg, mapping);
  return state;
}

CombinerState e_times_f(Maker& m) {
  CombinerState state = final_alone();
  const int place = m.of(4);
  const Register e = m.source();
  state.final_combiner.e = rgb_of(e, m.of(2) == 0 ? InputMapping::unsigned_identity : InputMapping::unsigned_invert);
  state.final_combiner.f = rgb_of(m.random_source());
  // As C, as D, as A and as B of a mix.
  switch (place) {
    case 0:
      set_final(state, kNothing, kNothing, rgb_of(Register::e_times_f));
      break;
    case 1:
      set_final(state, kNothing, kNothing, kNothing, rgb_of(Register::e_times_f));
      break;
    case 2:
      set_final(state, rgb_of(Register::e_times_f), rgb_of(m.random_source()), rgb_of(m.random_source()));
      break;
    default:
      set_final(state, rgb_of(m.random_source()), rgb_of(Register::e_times_f), rgb_of(m.random_source()));
  }
  return state;
}

// spare0 is a register times 1, or a product; the sum is shown as it is, or times A, which halves what passes 1.
CombinerState color_sum(Maker& m, bool clamp) {
  CombinerState state;
  state.color_sum_clamp = clamp;
  const bool times_a = m.of(2) == 1;
  const Register reg = m.source();
  set_inputs(state.general[0], rgb_of(reg), m.of(2) == 0 ? kPlusOne : rgb_of(m.random_source()));
  // 1 - the sum: with D, because it is 0 at the least.
  const bool is_inverted = m.random.one_in(3);
  const InputMapping mapping = is_inverted ? InputMapping::unsigned_invert : InputMapping::unsigned_identity;
  set_final(state, times_a ? rgb_of(m.random_source()) : kPlusOne, rgb_of(Register::spare0_plus_secondary, mapping),
            kNothing, is_inverted ? rgb_of(m.random_source()) : kNothing);
  return state;
}
CombinerState color_sum_clamped(Maker& m) {
  return color_sum(m, true);
}
CombinerState color_sum_unclamped(Maker& m) {
  return color_sum(m, false);
}
CombinerState color_sum_inverted(Maker& m) {
  const int which = 1 + m.of(3);
  CombinerState state = color_sum(m, m.of(2) == 0);
  state.color_sum_invert_spare0 = (which & 1) != 0;
  state.color_sum_invert_secondary = (which & 2) != 0;
  return state;
}

CombinerState final_fog(Maker& m) {
  CombinerState state;
  state.color_sum_clamp = m.of(2) == 0;
  set_inputs(state.general[0], rgb_of(m.source()), rgb_of(m.random_source()));
  return state;
}

// Negative spare0 and spare1 enter every variable.
CombinerState final_negative(Maker& m) {
  CombinerState state;
  GeneralCombiner& stage = state.general[0];
  const int where = m.of(5);
  set_inputs(stage, rgb_of(m.source(), InputMapping::half_bias_normal), kPlusOne);
  const CombinerInput in =
      rgb_of(Register::spare0, m.of(2) == 0 ? InputMapping::unsigned_identity : InputMapping::unsigned_invert);
  set_final(state, rgb_of(m.random_source()), rgb_of(m.random_source()), rgb_of(m.random_source()));
  if (where < 4) {
    input_of(state.final_combiner, where) = in;
  } else {
    state.final_combiner.b = rgb_of(Register::spare0_plus_secondary);
  }
  return state;
}

// NV20 class chips show spare0 where both words of the final combiner are 0.
CombinerState final_zero_words(Maker& m) {
  CombinerState state;
  state.color_sum_clamp = false;
  set_inputs(state.general[0], rgb_of(m.source()), kPlusOne);
  set_final(state, kNothing, kNothing, kNothing, rgb_of(Register::spare0));
  return state;
}

constexpr Group kFinalGroups[] = {
    {"final-d", "14", "D", 8, Inputs::bytes, final_d},
    {"final-ab", "9", "AB", 16, Inputs::bytes, final_product},
    {"final-c", "9", "(1 - A)C", 16, Inputs::bytes, final_rest},
    {"final-mix", "9", "AB + (1 - A)C", 20, Inputs::bytes, final_mix},
    {"final-add", "9, 14", "AB + (1 - A)C + D", 20, Inputs::bytes, final_add},
    {"final-invert", "2, 9", "one of A to D inverted", 16, Inputs::bytes, final_invert},
    {"final-usage", "9", "one of A to D reads alpha", 16, Inputs::bytes, final_usage},
    {"final-g", "14", "G: alpha, blue, inverted", 12, Inputs::bytes, final_g},
    {"final-e-times-f", "10", "E times F", 24, Inputs::bytes, e_times_f},
    {"color-sum-clamped", "13", "spare0 + secondary, clamped to 1", 16, Inputs::bytes, color_sum_clamped},
    {"color-sum-unclamped", "13", "spare0 + secondary, up to 2", 16, Inputs::bytes, color_sum_unclamped},
    {"color-sum-inverted", "13, 23", "1 - spare0, 1 - secondary in the sum", 16, Inputs::bytes, color_sum_inverted,
     [](const HardwareProfile& p) { return p.color_sum_inverts.value; }},
    {"final-fog", "9, 13", "OpenGL's default: colour sum and fog", 16, Inputs::bytes, final_fog},
    {"final-negative", "14", "negative registers are 0 to the final combiner", 20, Inputs::bytes, final_negative},
    {"final-zero-words", "", "both words of the final combiner are 0: it shows spare0", 4, Inputs::bytes,
     final_zero_words, is_nv20},
};

}  // namespace

std::span<const Group> final_groups() {
  return kFinalGroups;
}

}  // namespace ninebit::vectors

// Groups on stages without arithmetic, since every input is taken times 1: what registers hold at first, the number of
// stages, what a stage reads and writes, constants.
#include <array>

#include "src/study/vectors/vector_groups.h"

namespace ninebit::vectors {
namespace {

// spare0 or spare1 is shown as it was before the program, which then writes something else there.
CombinerState start_registers(Maker& m) {
  CombinerState state;
  const Register spare = m.of(2) == 0 ? Register::spare0 : Register::spare1;
  GeneralCombiner& stage = state.general[0];
  set_inputs(stage, rgb_of(spare), kPlusOne, rgb_of(m.source()), kPlusOne);
  for (PortionOutput* const out : {&stage.rgb.out, &stage.alpha.out}) {
    out->ab = Register::primary;
    out->cd = spare;
    out->sum = Register::discard;
  }
  set_final(state, kNothing, kNothing, rgb_of(Register::primary));
  state.final_combiner.g = alpha_of(Register::primary);
  return state;
}

// Each stage writes another register's value to spare0, as would the one past the last.
CombinerState number_of_stages(Maker& m) {
  CombinerState state = shows_spare0();
  const int most = m.profile.general_combiners.value;
  const int stages = 1 + m.of(most);
  state.num_general_combiners = stages;
  Register before = Register::zero;
  for (int i = 0; i < (stages < most ? stages + 1 : stages); ++i) {
    Register reg = m.random_source();
    while (reg == before) reg = m.random_source();
    set_inputs(state.general[static_cast<std::size_t>(i)], rgb_of(reg), kPlusOne);
    before = reg;
  }
  return state;
}

// Portions of stage 1 whose input word is 0 write 0 to a register that stage 0 filled.
CombinerState zero_words(Maker& m) {
  CombinerState state = shows_spare0();
  state.num_general_combiners = 2;
  const int which = 1 + m.of(3);  // 1: the RGB portion's word, 2: the alpha portion's
  const Register zeroed = m.of(2) == 0 ? Register::spare1 : Register::spare0;
  const Register rest = zeroed == Register::spare0 ? Register::spare1 : Register::spare0;
  GeneralCombiner &first = state.general[0], &second = state.general[1];
  set_inputs(first, rgb_of(m.random_source()), kPlusOne);
  set_inputs(second, rgb_of(m.random_source()), kPlusOne);
  first.rgb.out.ab = first.alpha.out.ab = Register::spare1;
  if ((which & 1) != 0) second.rgb.a = second.rgb.b = kNothing;
  if ((which & 2) != 0) {
    second.alpha.a = second.alpha.b = second.alpha.c = second.alpha.d = blue_of(Register::zero);
  }
  second.rgb.out.sum = second.alpha.out.sum = zeroed;
  const bool shows_rgb = m.of(2) == 0;
  set_final(state, kNothing, kNothing, rgb_of(shows_rgb ? zeroed : rest));
  state.final_combiner.g = alpha_of(shows_rgb ? rest : zeroed);
  return state;
}

// A portion, or AB, writes what the other portion, or CD, reads: it must read the value from before the stage.
CombinerState reads_before_writes(Maker& m) {
  CombinerState state = shows_spare0();
  GeneralCombiner& stage = state.general[0];
  const int writer = m.of(3);
  const Register reg = m.source();
  if (writer == 2) {
    set_inputs(stage, rgb_of(m.random_source()), kPlusOne, rgb_of(reg), kPlusOne);
    for (PortionOutput* const out : {&stage.rgb.out, &stage.alpha.out}) {
      out->ab = reg;
      out->cd = Register::spare0;
      out->sum = Register::discard;
    }
    return state;
  }
  set_inputs(stage, rgb_of(m.random_source()), kPlusOne);
  if (writer == 0) {
    stage.alpha.a = blue_of(reg);
    stage.rgb.out.sum = reg;
  } else {
    stage.rgb.a = alpha_of(reg);
    stage.alpha.out.sum = reg;
  }
  set_final(state, kNothing, kNothing, rgb_of(writer == 0 ? reg : Register::spare0));
  state.final_combiner.g = alpha_of(writer == 0 ? Register::spare0 : reg);
  return state;
}

Register either_constant(Maker& m) {
  return m.of(2) == 0 ? Register::constant0 : Register::constant1;
}

// One pair of constants for all general combiners, another one for the final combiner.
CombinerState constants(Maker& m) {
  CombinerState state = shows_spare0();
  state.constant0 = m.color();
  state.constant1 = m.color();
  const Register constant = either_constant(m);
  const int stages = m.profile.general_combiners.value < 3 ? m.profile.general_combiners.value : 3;
  const int stage = m.of(stages + 1);
  state.num_general_combiners = stage == stages ? 1 : stage + 1;
  for (int i = 0; i < state.num_general_combiners; ++i) state.general[static_cast<std::size_t>(i)] = idle_stage();
  if (stage < stages) {
    set_inputs(state.general[static_cast<std::size_t>(stage)], rgb_of(constant), kPlusOne);
    state.general[static_cast<std::size_t>(stage)].rgb.out.sum = Register::spare0;
    state.general[static_cast<std::size_t>(stage)].alpha.out.sum = Register::spare0;
  } else {
    set_final(state, kNothing, kNothing, rgb_of(constant));
    state.final_combiner.g = alpha_of(constant);
  }
  return state;
}

// A pair for each stage, and another one for the final combiner; one of them is shown.
CombinerState stage_constants(Maker& m) {
  CombinerState state = shows_spare0();
  state.per_stage_constants = true;
  state.constant0 = m.color();
  state.constant1 = m.color();
  const Register constant = either_constant(m);
  const int shown = m.of(4), stages = shown < 3 ? shown + 1 : 2;
  state.num_general_combiners = stages;
  for (int i = 0; i < stages; ++i) {
    GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    stage = idle_stage();
    stage.constant0 = m.color();
    stage.constant1 = m.color();
    if (i != shown) continue;
    set_inputs(stage, rgb_of(constant), kPlusOne);
    stage.rgb.out.sum = stage.alpha.out.sum = Register::spare0;
  }
  if (shown == 3) {
    set_final(state, kNothing, kNothing, rgb_of(constant));
    state.final_combiner.g = alpha_of(constant);
  }
  return state;
}

constexpr Group kOrderGroups[] = {
    {"start-registers", "", "spare0 and spare1 before the first stage", 10, Inputs::bytes, start_registers},
    {"number-of-stages", "", "stages past the last do nothing", 16, Inputs::bytes, number_of_stages},
    {"zero-words", "", "a portion whose input word is 0 writes 0", 12, Inputs::bytes, zero_words, has_stages},
    {"reads-before-writes", "12", "a portion or product reads what another one overwrites", 16, Inputs::bytes,
     reads_before_writes},
    {"constants", "1", "one pair of constants for all stages", 20, Inputs::bytes, constants},
    {"constants-of-stages", "1", "a pair of constants for each stage and for the final combiner", 24, Inputs::bytes,
     stage_constants, [](const HardwareProfile& p) { return p.per_stage_constants.value; }},
};

}  // namespace

std::span<const Group> order_groups() {
  return kOrderGroups;
}

}  // namespace ninebit::vectors

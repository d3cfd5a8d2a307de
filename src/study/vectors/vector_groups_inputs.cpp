// Groups on what general combiners read: registers, component usages, mappings.
#include <array>

#include "src/study/vectors/vector_groups.h"

namespace ninebit::vectors {
namespace {

CombinerState final_reads(Maker& m) {
  constexpr std::array kOthers{Register::zero,   Register::fog,       Register::spare1,
                               Register::spare0, Register::constant0, Register::constant1};
  CombinerState state;
  state.general[0] = idle_stage();
  const Register reg = m.of(2) == 0 ? m.source() : m.of(std::span<const Register>(kOthers));
  set_final(state, kNothing, kNothing, rgb_of(reg));
  state.final_combiner.g = alpha_of(reg);
  state.constant0 = m.color();
  state.constant1 = m.color();
  return state;
}

CombinerState pass(Maker& m) {
  CombinerState state = shows_spare0();
  set_inputs(state.general[0], rgb_of(m.of(6) == 5 ? Register::fog : m.source()), kPlusOne);
  return state;
}

CombinerState usage(Maker& m) {
  CombinerState state = shows_spare0();
  GeneralCombiner& stage = state.general[0];
  const bool in_rgb = m.of(2) == 0;
  const Register reg = m.source();
  set_inputs(stage, rgb_of(reg), kPlusOne);
  if (in_rgb) {
    stage.rgb.a = alpha_of(reg);
  } else {
    stage.alpha.a = blue_of(reg);
  }
  return state;
}

// A register through a mapping, times 1 and, if `both_signs`, times -1.
CombinerState mapped(Maker& m, InputMapping mapping, bool both_signs) {
  CombinerState state = shows_spare0();
  const bool negated = both_signs && m.of(2) == 1;
  set_inputs(state.general[0], rgb_of(m.source(), mapping), negated ? kMinusOne : kPlusOne);
  return state;
}

template <InputMapping kMapping>
CombinerState mapping_group(Maker& m) {
  return mapped(m, kMapping, true);
}
template <InputMapping kMapping>
CombinerState positive_mapping_group(Maker& m) {
  return mapped(m, kMapping, false);
}
CombinerState signed_negate_group(Maker& m) {
  CombinerState state = mapped(m, InputMapping::signed_negate, false);
  set_inputs(state.general[0], state.general[0].rgb.a, kMinusOne);
  return state;
}

CombinerState negative_texels(Maker& m) {
  CombinerState state = shows_spare0();
  const InputMapping mapping = kInputMappings[static_cast<std::size_t>(m.of(8))];
  const bool negated = m.of(2) == 1;
  const Register reg = texture_register(m.of(m.profile.texture_units.value));
  set_inputs(state.general[0], rgb_of(reg, mapping), negated ? kMinusOne : kPlusOne);
  return state;
}

// Stage 0 makes spare0 = -x, stage 1 maps it.
CombinerState negative_registers(Maker& m) {
  CombinerState state = shows_spare0();
  state.num_general_combiners = 2;
  const InputMapping mapping = kInputMappings[static_cast<std::size_t>(m.of(8))];
  const bool negated = m.of(2) == 1;
  set_inputs(state.general[0], rgb_of(m.source(), InputMapping::signed_negate), kPlusOne);
  set_inputs(state.general[1], rgb_of(Register::spare0, mapping), negated ? kMinusOne : kPlusOne);
  return state;
}

constexpr Group kInputGroups[] = {
    {"final-reads", "", "the final combiner shows a register; the general combiner writes nothing", 10, Inputs::bytes,
     final_reads},
    {"general-reads", "1", "spare0 = a register times 1", 10, Inputs::bytes, pass},
    {"component-usage", "", "RGB portions read alpha, alpha portions read blue", 12, Inputs::bytes, usage},
    {"mapping-unsigned-identity", "2", "max(0, x)", 8, Inputs::bytes,
     positive_mapping_group<InputMapping::unsigned_identity>},
    {"mapping-unsigned-invert", "2", "1 - x", 10, Inputs::bytes, positive_mapping_group<InputMapping::unsigned_invert>},
    {"mapping-signed-identity", "2", "x", 8, Inputs::bytes, positive_mapping_group<InputMapping::signed_identity>},
    {"mapping-expand-normal", "", "2x - 1, times 1 and times -1", 14, Inputs::bytes,
     mapping_group<InputMapping::expand_normal>},
    {"mapping-expand-negate", "", "1 - 2x, times 1 and times -1", 14, Inputs::bytes,
     mapping_group<InputMapping::expand_negate>},
    {"mapping-half-bias-normal", "4", "x - 1/2, times 1 and times -1", 14, Inputs::bytes,
     mapping_group<InputMapping::half_bias_normal>},
    {"mapping-half-bias-negate", "4", "1/2 - x, times 1 and times -1", 14, Inputs::bytes,
     mapping_group<InputMapping::half_bias_negate>},
    {"mapping-signed-negate", "2", "-x, times -1", 10, Inputs::bytes, signed_negate_group},
    {"negative-texels", "2, 15", "every mapping of textures with negative codes", 40, Inputs::signed_texels,
     negative_texels, is_nv20},
    {"negative-registers", "2", "every mapping of what stage 0 made negative", 40, Inputs::bytes, negative_registers,
     [](const HardwareProfile& p) { return p.general_combiners.value > 1; }},
};

}  // namespace

std::span<const Group> input_groups() {
  return kInputGroups;
}

}  // namespace ninebit::vectors

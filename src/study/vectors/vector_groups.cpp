#include "src/study/vectors/vector_groups.h"

#include <array>

namespace ninebit::vectors {

Register Maker::source() {
  const int choice = of(2 + profile.texture_units.value);
  if (choice == 1) return Register::primary;
  if (choice == 2) return Register::secondary;
  return texture_register(choice == 0 ? 0 : choice - 2);
}

Register Maker::random_source() {
  const int choice = random.below(2 + profile.texture_units.value);
  if (choice == 0) return Register::primary;
  if (choice == 1) return Register::secondary;
  return texture_register(choice - 2);
}

Register Maker::random_target() {
  constexpr std::array kPlain{Register::spare0, Register::spare1, Register::primary, Register::secondary};
  const int choice = random.below(4 + profile.texture_units.value);
  return choice < 4 ? kPlain[static_cast<std::size_t>(choice)] : texture_register(choice - 4);
}

ColorF Maker::color() {
  constexpr std::array kEdges{0, 1, 127, 128, 254, 255};
  ColorF color{};
  for (float& component : color) {
    const int byte = random.one_in(2) ? kEdges[static_cast<std::size_t>(random.below(6))] : random.below(256);
    component = static_cast<float>(byte) / 255.0F;
  }
  return color;
}

std::vector<Group> groups_of(const HardwareProfile& profile) {
  std::vector<Group> found;
  for (const auto groups : {input_groups(), order_groups(), mapping_groups(), output_groups(), stage_groups(),
                            final_groups(), mixed_groups()}) {
    for (const Group& group : groups) {
      if (group.exists == nullptr || group.exists(profile)) found.push_back(group);
    }
  }
  return found;
}

CombinerState shows_spare0() {
  CombinerState state;
  state.final_combiner.a = kNothing;
  state.final_combiner.c = rgb_of(Register::spare0);
  return state;
}

void set_inputs(GeneralCombiner& stage, const CombinerInput& a, const CombinerInput& b, const CombinerInput& c,
                const CombinerInput& d) {
  stage.rgb.a = a;
  stage.rgb.b = b;
  stage.rgb.c = c;
  stage.rgb.d = d;
  stage.alpha.a = for_alpha(a);
  stage.alpha.b = for_alpha(b);
  stage.alpha.c = for_alpha(c);
  stage.alpha.d = for_alpha(d);
}

void set_scale(GeneralCombiner& stage, Scale scale, Bias bias) {
  for (PortionOutput* const out : {&stage.rgb.out, &stage.alpha.out}) {
    out->scale = scale;
    out->bias = bias;
  }
}

GeneralCombiner idle_stage() {
  GeneralCombiner stage;
  stage.rgb.out.sum = stage.alpha.out.sum = Register::discard;
  return stage;
}

GeneralCombiner negating_stage() {
  GeneralCombiner stage;
  set_inputs(stage, rgb_of(Register::spare0, InputMapping::signed_negate), kPlusOne);
  return stage;
}

void set_final(CombinerState& state, const CombinerInput& a, const CombinerInput& b, const CombinerInput& c,
               const CombinerInput& d) {
  state.final_combiner.a = a;
  state.final_combiner.b = b;
  state.final_combiner.c = c;
  state.final_combiner.d = d;
}

// Groups on what general combiners read: registers, component usages, mappings.

namespace {

CombinerState final_reads(Maker& m) {
  CombinerState state;
  state.general[0] = idle_stage();
  const Register reg = m.of(7) == 6 ? Register::fog : m.source();
  set_final(state, kNothing, kNothing, rgb_of(reg));
  state.final_combiner.g = alpha_of(reg);
  return state;
}

// Alpha portions read fog's blue: component-usage tests blue.
CombinerState pass(Maker& m) {
  CombinerState state = shows_spare0();
  const bool is_fog = m.of(6) == 5;
  const Register reg = m.source();
  set_inputs(state.general[0], rgb_of(is_fog ? Register::fog : reg), kPlusOne);
  if (is_fog) state.general[0].alpha.a = alpha_of(reg);
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
};

constexpr Group kMappingGroups[] = {
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
     has_stages},
};

}  // namespace

std::span<const Group> input_groups() {
  return kInputGroups;
}
std::span<const Group> mapping_groups() {
  return kMappingGroups;
}

}  // namespace ninebit::vectors

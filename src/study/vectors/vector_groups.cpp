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
  for (const auto groups : {input_groups(), output_groups(), stage_groups(), final_groups(), mixed_groups()}) {
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

}  // namespace ninebit::vectors

#include "combiner_tests/combiner/random_state.h"

#include <array>
#include <vector>

namespace ninebit::test {
namespace {

template <class T, std::size_t N>
T pick(Random& random, const std::array<T, N>& from) {
  return from[static_cast<std::size_t>(random.below(static_cast<int>(N)))];
}

// Registers that both a general combiner and the final combiner read; spare0 and textures more often, as results of
// one stage must meet in the next.
Register random_readable(Random& random, const HardwareProfile& profile) {
  constexpr std::array kPlain{Register::zero,   Register::zero,      Register::constant0, Register::constant1,
                              Register::fog,    Register::primary,   Register::primary,   Register::secondary,
                              Register::spare0, Register::spare0,    Register::spare0,    Register::spare1,
                              Register::spare1, Register::secondary, Register::spare1};
  if (random.below(4) != 0) return pick(random, kPlain);
  return texture_register(random.below(profile.texture_units));
}

Register random_writable(Random& random, const HardwareProfile& profile) {
  constexpr std::array kPlain{Register::primary, Register::secondary, Register::spare0, Register::spare0,
                              Register::spare1};
  if (random.below(4) != 0) return pick(random, kPlain);
  return texture_register(random.below(profile.texture_units));
}

ColorF random_color(Random& random) {
  ColorF color{};
  for (float& component : color) {
    switch (random.below(4)) {
      case 0:
        component = static_cast<float>(random.below(2));
        break;
      case 1:  // near the edge between two bytes
        component = static_cast<float>((random.below(255) + 0.5 + (random.below(3) - 1) * 1e-5) / 255.0);
        break;
      default:
        component = static_cast<float>(random.below(256) / 255.0);
    }
  }
  return color;
}

}  // namespace

std::vector<HardwareProfile> integer_profiles() {
  std::vector<HardwareProfile> found;
  for (const HardwareProfile& profile : hardware_profiles()) {
    if (profile.arithmetic == Arithmetic::integer) found.push_back(profile);
  }
  return found;
}

HardwareProfile random_profile(Random& random) {
  const std::vector<HardwareProfile> shipped = integer_profiles();
  HardwareProfile p = shipped[static_cast<std::size_t>(random.below(static_cast<int>(shipped.size())))];
  if (!random.one_in(4)) return p;
  if (random.one_in(2)) p.lowest.value = p.lowest_output.value = -p.one - 1;
  if (random.one_in(2)) p.expand_offset.value = p.one + 1;
  if (random.one_in(4)) p.half.value = p.half - 1;
  p.general_narrowing.value = random.one_in(2) ? Narrowing::toward_zero : Narrowing::nearest_halves_up;
  p.narrowing_point.value = random.one_in(2) ? NarrowingPoint::before_scale : NarrowingPoint::after_scale;
  p.final_narrowing.value = random.one_in(2) ? Narrowing::toward_zero : Narrowing::nearest_halves_up;
  return p;
}

HardwareProfile random_real_profile(Random& random, const HardwareProfile& base) {
  HardwareProfile p = base;
  if (!random.one_in(8)) return p;
  p.byte_shift.value = 1 + random.below(4);
  p.one.value = 255 >> p.byte_shift.value;
  p.lowest.value = p.lowest_output.value = -p.one.value;
  p.half.value = (p.one.value + 1) / 2;  // random_code picks its neighbours
  return p;
}

CombinerInput random_input(Random& random, PortionName portion, const HardwareProfile& profile) {
  CombinerInput in;
  in.reg = random_readable(random, profile);
  in.mapping = pick(random, kInputMappings);
  const bool alpha = in.reg != Register::fog && random.one_in(portion == PortionName::rgb ? 4 : 2);
  in.usage = alpha ? ComponentUsage::alpha : portion == PortionName::alpha ? ComponentUsage::blue : ComponentUsage::rgb;
  return in;
}

PortionOutput random_output(Random& random, PortionName portion, const HardwareProfile& profile) {
  PortionOutput out;
  for (Register* const to : {&out.ab, &out.cd, &out.sum}) *to = Register::discard;
  for (Register* const to : {&out.sum, &out.ab, &out.cd}) {
    if (random.one_in(3)) continue;
    const Register r = random_writable(random, profile);
    if (r != out.ab && r != out.cd && r != out.sum) *to = r;
  }
  out.scale = static_cast<Scale>(random.below(4));
  const bool may_bias = out.scale == Scale::none || out.scale == Scale::by_two;
  if (may_bias && random.one_in(3)) out.bias = Bias::by_negative_one_half;
  if (portion == PortionName::rgb) {
    out.ab_dot_product = random.one_in(4);
    out.cd_dot_product = random.one_in(4);
    out.ab_blue_to_alpha = profile.blue_to_alpha && random.one_in(3);
    out.cd_blue_to_alpha = profile.blue_to_alpha && random.one_in(3);
  }
  out.mux_sum = random.one_in(3);
  return out;
}

CombinerInput random_final_input(Random& random, Variable variable, const HardwareProfile& profile) {
  CombinerInput in;
  in.reg = random_readable(random, profile);
  in.mapping = random.one_in(3) ? InputMapping::unsigned_invert : InputMapping::unsigned_identity;
  if (variable == Variable::g) {
    in.usage = random.one_in(2) ? ComponentUsage::alpha : ComponentUsage::blue;
    return in;
  }
  in.usage = random.one_in(4) ? ComponentUsage::alpha : ComponentUsage::rgb;
  if (variable <= Variable::d && random.one_in(4)) {
    in.reg = variable != Variable::a && random.one_in(2) ? Register::spare0_plus_secondary : Register::e_times_f;
    in.usage = ComponentUsage::rgb;
  }
  return in;
}

CombinerState random_state(Random& random, const HardwareProfile& profile) {
  CombinerState state;
  // Mostly few stages, so that what a stage computes reaches the end.
  state.num_general_combiners = 1 + random.below(random.one_in(2) ? 2 : profile.general_combiners.value);
  state.color_sum_clamp = random.one_in(2);
  state.per_stage_constants = profile.per_stage_constants && random.one_in(2);
  state.mux_by_lowest_bit = profile.mux_by_lowest_bit && random.one_in(2);
  state.color_sum_invert_spare0 = profile.color_sum_inverts && random.one_in(3);
  state.color_sum_invert_secondary = profile.color_sum_inverts && random.one_in(3);
  state.constant0 = random_color(random);
  state.constant1 = random_color(random);
  for (GeneralCombiner& stage : state.general) {
    stage.constant0 = random_color(random);
    stage.constant1 = random_color(random);
    for (const PortionName name : {PortionName::rgb, PortionName::alpha}) {
      Portion& portion = name == PortionName::rgb ? stage.rgb : stage.alpha;
      for (CombinerInput* const in : {&portion.a, &portion.b, &portion.c, &portion.d}) {
        *in = random_input(random, name, profile);
      }
      portion.out = random_output(random, name, profile);
    }
  }
  FinalCombiner& f = state.final_combiner;
  f.a = random_final_input(random, Variable::a, profile);
  f.b = random_final_input(random, Variable::b, profile);
  f.c = random_final_input(random, Variable::c, profile);
  f.d = random.one_in(2) ? CombinerInput{} : random_final_input(random, Variable::d, profile);
  f.e = random_final_input(random, Variable::e, profile);
  f.f = random_final_input(random, Variable::f, profile);
  f.g = random_final_input(random, Variable::g, profile);
  return state;
}

int random_code(Random& random, const HardwareProfile& profile) {
  const int one = profile.one;
  const int half = profile.half;
  const std::array special{
      profile.lowest.value, -one, -one + 1, -half, -1, 0, 0, 1, half - 1, half, half + 1, 2, -2, one, one - 1};
  if (random.one_in(2)) return pick(random, special);
  return profile.lowest + random.below(one - profile.lowest + 1);
}

RegisterFile random_registers(Random& random, const HardwareProfile& profile) {
  RegisterFile registers;
  for (Rgba9& value : registers.value) {
    for (s9& component : value) component = static_cast<s9>(random_code(random, profile));
  }
  return registers;
}

}  // namespace ninebit::test

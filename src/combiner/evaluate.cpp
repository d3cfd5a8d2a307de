#include "ninebit/combiner/evaluate.h"

namespace ninebit {

RegisterFile initial_registers(const HardwareProfile& profile, const FragmentInputs& inputs) {
  const auto codes = [&](const FragmentInputs::Bytes& bytes) {
    Rgba9 value{};
    for (std::size_t i = 0; i < 4; ++i) value[i] = from_byte(profile, bytes[i]);
    return value;
  };
  const auto byte_code = [&](int byte) { return from_byte(profile, static_cast<std::uint8_t>(byte)); };

  RegisterFile registers;
  registers[Register::primary] = codes(inputs.primary);
  registers[Register::secondary] = codes(inputs.secondary);
  if (profile.secondary_alpha.value == SecondaryAlpha::one) {
    registers[Register::secondary][kAlpha] = static_cast<s9>(profile.one);
  }
  registers[Register::fog] = codes(inputs.fog);
  for (int unit = 0; unit < 4; ++unit) {
    const auto& texel = inputs.texture[static_cast<std::size_t>(unit)];
    registers[texture_register(unit)] =
        texel ? codes(*texel) : Rgba9{0, 0, 0, byte_code(profile.disabled_texture_alpha)};
  }
  registers[Register::spare0][kAlpha] =
      inputs.texture[0] ? registers[Register::texture0][kAlpha] : byte_code(profile.spare0_alpha_without_texture0);
  return registers;
}

}  // namespace ninebit

#include "ninebit/combiner/initial_registers.h"

#include <algorithm>

#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

Rgba9 codes_of(const HardwareProfile& profile, const Bytes4& bytes) {
  Rgba9 codes{};
  for (std::size_t i = 0; i < 4; ++i) codes[i] = from_byte(profile, bytes[i]);
  return codes;
}

s9 byte_code(const HardwareProfile& profile, int byte) {
  return from_byte(profile, static_cast<std::uint8_t>(byte));
}

}  // namespace

s9 texel_byte_code(const HardwareProfile& profile, std::uint8_t byte, bool is_signed) {
  if (!is_signed) return from_byte(profile, byte);
  const int twice = 2 * static_cast<std::int8_t>(byte);
  return static_cast<s9>(std::max(twice >> profile.byte_shift.value, profile.lowest.value));
}

Rgba9 texel_codes(const HardwareProfile& profile, const Texel& texel) {
  std::array<s9, 4> v{};
  for (std::size_t i = 0; i < 4; ++i) v[i] = texel_byte_code(profile, texel.value[i], texel.is_signed);
  const auto one = static_cast<s9>(profile.one.value);
  switch (texel.format) {
    case TextureFormat::alpha:
    case TextureFormat::dsdt_mag_intensity:
      return {0, 0, 0, v[3]};
    case TextureFormat::luminance:
      return {v[0], v[0], v[0], one};
    case TextureFormat::luminance_alpha:
      return {v[0], v[0], v[0], v[3]};
    case TextureFormat::intensity:
    case TextureFormat::depth_comparison:
      return {v[0], v[0], v[0], v[0]};
    case TextureFormat::rgb:
      return {v[0], v[1], v[2], one};
    case TextureFormat::rgba:
      return v;
    case TextureFormat::depth:
      return {0, 0, 0, v[0]};
    case TextureFormat::hilo:
    case TextureFormat::dsdt:
    case TextureFormat::dsdt_mag:
      return {};
  }
  return v;
}

RegisterFile initial_registers(const HardwareProfile& profile, const FragmentInputs& inputs) {
  RegisterFile registers;
  registers[Register::primary] = codes_of(profile, inputs.primary);
  registers[Register::secondary] = codes_of(profile, inputs.secondary);
  if (profile.secondary_alpha.value == SecondaryAlpha::one) {
    registers[Register::secondary][kAlpha] = static_cast<s9>(profile.one.value);
  }
  Rgba9& fog = registers[Register::fog];
  for (std::size_t i = 0; i < 3; ++i) fog[i] = from_byte(profile, inputs.fog_color[i]);
  fog[kAlpha] = inputs.fog_factor ? from_byte(profile, *inputs.fog_factor)
                                  : byte_code(profile, profile.fog_alpha_without_fog.value);
  for (int unit = 0; unit < 4; ++unit) {
    const auto& texel = inputs.texture[static_cast<std::size_t>(unit)];
    registers[texture_register(unit)] =
        texel ? texel_codes(profile, *texel) : Rgba9{0, 0, 0, byte_code(profile, profile.disabled_texture_alpha)};
  }
  registers[Register::spare0][kAlpha] = inputs.texture[0] ? registers[Register::texture0][kAlpha]
                                                          : byte_code(profile, profile.spare0_alpha_without_texture0);
  return registers;
}

}  // namespace ninebit

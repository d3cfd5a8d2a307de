// The registers before the first general combiner: NV_register_combiners, table of initial register values.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A texture's base internal format. The combiners read texels by a table of their own, which differs from that of the
// texture environment: alpha textures are black, not transparent to colour, and GL_DEPTH_TEXTURE_MODE is ignored.
enum class TextureFormat : std::uint8_t {
  alpha,              // (0, 0, 0, A)
  luminance,          // (L, L, L, 1)
  luminance_alpha,    // (L, L, L, A)
  intensity,          // (I, I, I, I)
  rgb,                // (R, G, B, 1)
  rgba,               // (R, G, B, A)
  depth,              // (0, 0, 0, D): GL_DEPTH_COMPONENT without a comparison
  depth_comparison,   // (D, D, D, D): with a comparison (SGIX_shadow, ARB_shadow); D is its result
  hilo,               // (0, 0, 0, 0): these and the next three are NV_texture_shader's
  dsdt,               // (0, 0, 0, 0)
  dsdt_mag,           // (0, 0, 0, 0)
  dsdt_mag_intensity  // (0, 0, 0, I)
};

// Red, green, blue, alpha as bytes.
using Bytes4 = std::array<std::uint8_t, 4>;

// A filtered texel.
struct Texel {
  Bytes4 value{};  // red, green, blue, alpha; luminance, intensity or depth is in the first, the intensity of
                   // dsdt_mag_intensity in alpha; components that the format does not have are not read
  TextureFormat format = TextureFormat::rgba;  // selects the register components that the value fills
  bool is_signed = false;  // NV_texture_shader: each byte is a two's complement number; NV20 class only
};

// Returns the code of a texel's byte, which may be a two's complement number (rules 1 and 15).
[[nodiscard]] s9 texel_byte_code(const HardwareProfile& profile, std::uint8_t byte, bool is_signed);

// Returns the codes that a texel puts into its register. A signed byte s becomes 2 s, at least the profile's `lowest`
// (rule 15, measured on NV2A for s >= 0; the rest is assumed).
[[nodiscard]] Rgba9 texel_codes(const HardwareProfile& profile, const Texel& texel);

// The combiners' inputs for one fragment, as bytes: red, green, blue, alpha.
struct FragmentInputs {
  Bytes4 primary{};                               // the primary colour
  Bytes4 secondary{};                             // its alpha is read if the profile's `secondary_alpha` is as_given
  std::array<std::uint8_t, 3> fog_color{};        // GL_FOG_COLOR, also if fog is disabled
  std::optional<std::uint8_t> fog_factor{};       // 255: no fog at this fragment; empty: GL_FOG is disabled
  std::array<std::optional<Texel>, 4> texture{};  // empty: the unit is off
};

// Returns the registers before the first general combiner. Values that the extension leaves undefined are 0, or as the
// profile says.
[[nodiscard]] RegisterFile initial_registers(const HardwareProfile& profile, const FragmentInputs& inputs);

}  // namespace ninebit

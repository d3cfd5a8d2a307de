#include "ninebit/numerics/fixed9.h"

#include <bit>

namespace ninebit {

std::uint8_t byte_of_vertex_color(const HardwareProfile& profile, float component) {
  if (!(component > 0.0F)) return 0;
  if (component >= 1.0F) return 255;
  const int dropped = 23 - profile.vertex_color_mantissa_bits;
  const std::uint32_t cut = std::bit_cast<std::uint32_t>(component) & ~((1U << dropped) - 1U);
  return static_cast<std::uint8_t>(static_cast<double>(std::bit_cast<float>(cut)) * 255.0 + 0.5);
}

}  // namespace ninebit

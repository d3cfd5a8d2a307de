#include "src/raster/fragment/fog.h"

namespace ninebit {

std::uint8_t fog_byte(const HardwareProfile& profile, const Fog& fog, float x) {
  std::uint8_t byte = 0;
  with_fog_function(fog.function, [&](auto function) { byte = fog_byte_of<function()>(profile, fog, x); });
  return byte;
}

}  // namespace ninebit

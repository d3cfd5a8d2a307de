// What a technique costs a graphics card: texture units, passes, memory.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "ninebit/shadow/technique.h"

namespace ninebit::tools {

struct TechniqueCosts {
  // The texture units that the comparison reads; empty if it is computed in floats, beyond the hardware.
  std::optional<std::uint64_t> texture_units;
  // How often the scene, its shadow volumes or a rectangle of the picture's size are drawn.
  std::uint64_t passes = 0;
  // Bytes of the light's maps as textures; three components take four bytes, 24 bits of depth as well. The depth
  // buffer that drawing a map takes is not counted, nor is the picture of a light cookie.
  std::uint64_t map_bytes = 0;
};

// The costs of a rendering that was made with these settings.
[[nodiscard]] TechniqueCosts costs_of(const std::string& technique, const RenderSettings& settings,
                                      const Rendering& rendering);

}  // namespace ninebit::tools

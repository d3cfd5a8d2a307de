// The order that gathers the set lanes of a mask at the front.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ninebit {

// For each byte the numbers of its bits: first those that are set, ascending, then the others.
inline constexpr auto kLanesOfBits = [] {
  std::array<std::array<std::uint8_t, 8>, 256> lanes{};
  for (unsigned bits = 0; bits < 256; ++bits) {
    std::size_t count = 0;
    for (const unsigned wanted : {1U, 0U}) {
      for (unsigned i = 0; i < 8; ++i) {
        if (((bits >> i) & 1U) == wanted) lanes[bits][count++] = static_cast<std::uint8_t>(i);
      }
    }
  }
  return lanes;
}();

}  // namespace ninebit

// The bits of colours that a surface stores (rule 43), in words of RGBA: red in the lowest byte, alpha in the highest.
#pragma once

#include <cstdint>

namespace ninebit {

struct ColorMasks {
  std::uint32_t kept = 0xFFFFFFFF;  // bits that are stored
  std::uint32_t set = 0;            // bits of components that are not stored
  // The low bits of components of 5, 6 and 7 bits, which repeat the high ones.
  std::uint32_t low_of_5 = 0, low_of_6 = 0, low_of_7 = 0;
};

}  // namespace ninebit

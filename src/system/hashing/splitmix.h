// SplitMix64: the same numbers with every compiler and library.
#pragma once

#include <cstdint>

namespace ninebit {

inline constexpr std::uint64_t kSplitMixStep = 0x9E3779B97F4A7C15U;

// The number that a generator in state `x` gives; its next state is x + kSplitMixStep.
[[nodiscard]] constexpr std::uint64_t splitmix(std::uint64_t x) {
  x += kSplitMixStep;
  x = (x ^ (x >> 30U)) * 0xBF58476D1CE4E5B9U;
  x = (x ^ (x >> 27U)) * 0x94D049BB133111EBU;
  return x ^ (x >> 31U);
}

}  // namespace ninebit

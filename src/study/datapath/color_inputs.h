// Which inputs of a program each component of its colour depends on.
#pragma once

#include <array>
#include <bitset>
#include <cstddef>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"

namespace ninebit {

// Components of registers and constants before the first stage: bit 4 · register + component.
using InputSet = std::bitset<4 * kRegisterCount>;

[[nodiscard]] constexpr std::size_t input_bit(Register reg, int component) {
  return 4 * static_cast<std::size_t>(reg) + static_cast<std::size_t>(component);
}

// For each component of the colour, all inputs that can change it, on the program's chip, in exact numbers, and with
// any number of stages exact. An input outside of the set never changes it; one within may not either. A factor of zero
// removes the other factor. `own_alpha`: whether spare0's alpha is an input of its own, and not texture 0's alpha.
[[nodiscard]] std::array<InputSet, 4> inputs_of_color(const Program& program, bool own_alpha);

}  // namespace ninebit

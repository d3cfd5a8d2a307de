// The registers and constants of a fragment that somebody gives, where no draw makes them.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {  // the library above this room calls it

// The registers before any is given: those of a fragment whose bytes are 0, with fog and all texture units off, as the
// profile defines them. A caller that is given texture 0's alpha, but not spare0's, copies it there.
[[nodiscard]] RegisterFile default_registers(const HardwareProfile& profile);

// Gives a constant's component a code, in all general combiners and in the final combiner.
void replace_constant(Program& program, Register constant, int component, s9 code);

// A component of a constant that the program reads and that is not set.
struct UnsetComponent {
  ConstantName name = 0;
  Register reg = Register::constant0;  // the constant of the combiners that it is
  int component = kRed;                // kRed to kAlpha
  friend bool operator==(const UnsetComponent&, const UnsetComponent&) = default;
};
// All of them, each once, by the inputs that are used.
[[nodiscard]] std::vector<UnsetComponent> unset_components(const Program& program);

// Which constants that are not set are constant 0 and 1 in every combiner that reads these; nothing if combiners read
// different ones, or some that are set.
[[nodiscard]] std::optional<std::array<std::optional<ConstantName>, 2>> varying_constants(const Program& program);

// Gives a component of a constant that is not set a code, wherever it is read.
void replace_unset_constant(Program& program, ConstantName name, int component, s9 code);

}  // namespace ninebit

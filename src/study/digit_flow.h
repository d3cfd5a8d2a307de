// Which digits each register component depends on after the first stage, and what is read later.
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"

namespace ninebit {

// A value for each component of each register.
template <class T>
using ByComponent = std::array<std::array<T, 4>, kRegisterCount>;

// Sets of digits, a bit for each, that the registers' components depend on after the first stage, given what they
// depend on before it.
[[nodiscard]] ByComponent<unsigned> digits_after_first_stage(const Program& program,
                                                             const ByComponent<unsigned>& before);

// The components that a stage from number `first` on, or the final combiner, reads: at least those that matter.
[[nodiscard]] ByComponent<bool> read_from_stage(const Program& program, int first);

}  // namespace ninebit

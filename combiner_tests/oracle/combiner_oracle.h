// A slow and naive model of the register combiners in exact fractions. Its only job is to judge the library.
//
// It is written from the text of NV_register_combiners and from the table of datapath choices in docs/numerics.md alone
// and shares no code with what it judges. Of the library's headers it includes three, which hold plain data:
// registers.h and state.h as the question, hardware_profile.h as the description of the hardware. A test reads its
// include lines.
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/combiner/registers.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::oracle {

// An exact fraction with a positive denominator. It is never reduced, but a sum keeps a denominator that the other one
// divides: between two narrowings every denominator divides 2 · one³, so that 64 bits hold all.
struct Fraction {
  std::int64_t num = 0;
  std::int64_t den = 1;
};

[[nodiscard]] Fraction plus(Fraction x, Fraction y);
[[nodiscard]] Fraction minus(Fraction x, Fraction y);
[[nodiscard]] Fraction times(Fraction x, Fraction y);
[[nodiscard]] bool less(Fraction x, Fraction y);

// Red, green, blue, alpha register codes.
using Codes = std::array<int, 4>;
using Registers = std::array<Codes, kRegisterCount>;

// The real number that a register code stands for.
[[nodiscard]] Fraction real(const HardwareProfile& profile, int code);

// The mapping functions, from real number to real number.
[[nodiscard]] Fraction mapped(const HardwareProfile& profile, InputMapping mapping, Fraction e);

// The value that a general combiner writes for a product, sum or dot product, all as real numbers.
[[nodiscard]] int general_output(const HardwareProfile& profile, Scale scale, Bias bias, Fraction value);

// The code of a GL colour component in [0, 1] (others are clamped) when it enters a register.
[[nodiscard]] int constant_code(const HardwareProfile& profile, float component);

struct Outcome {
  Registers registers;  // after the last general combiner
  Codes color;          // what leaves the final combiner
};

// Runs a valid state over one fragment. What stands in `initial` for zero and the constants is not read and stays.
[[nodiscard]] Outcome run(const CombinerState& state, const HardwareProfile& profile, const Registers& initial);

}  // namespace ninebit::oracle

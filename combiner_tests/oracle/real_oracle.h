// Slow and naive models of the register combiners in real numbers, exact and in 32-bit floats. Their only job is to
// judge the library.
//
// Written from the text of NV_register_combiners and from docs/numerics.md alone, like combiner_oracle.h, and in
// another way than what they judge. Exact: after each general combiner all registers are brought to one common
// denominator, a fixed function of the stage's number; nothing is ever reduced. Floats: each operation is done in
// doubles and then rounded to a float, which gives the same as doing it in floats, since a double has more than twice
// the digits and two.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "combiner_tests/oracle/combiner_oracle.h"

namespace ninebit::oracle {

// A whole number of any size: 64-bit digits, the lowest first, and a sign.
struct Whole {
  std::vector<std::uint64_t> digits;  // the last one is not zero
  bool negative = false;

  Whole() = default;
  Whole(int n);
};
[[nodiscard]] Whole plus(const Whole& x, const Whole& y);
[[nodiscard]] Whole minus(const Whole& x, const Whole& y);
[[nodiscard]] Whole times(const Whole& x, const Whole& y);
[[nodiscard]] Whole times(int n, const Whole& x);
[[nodiscard]] bool less(const Whole& x, const Whole& y);

struct Ratio {
  Whole num;
  Whole den = 1;  // positive
};

// The nearest code, halves up, of a number in [-2, 2].
[[nodiscard]] int nearest_code(const HardwareProfile& profile, const Ratio& x);

// Whether no double is nearer to x; of two equally near ones, whether it is the even one.
[[nodiscard]] bool is_nearest_double(const Ratio& x, double d);

struct ExactOutcome {
  std::array<std::array<Ratio, 4>, kRegisterCount> registers;  // after the last general combiner
  std::array<Ratio, 4> color;                                  // what leaves the final combiner
};
[[nodiscard]] ExactOutcome run_exact(const CombinerState& state, const HardwareProfile& profile,
                                     const Registers& initial);

struct FloatOutcome {
  std::array<std::array<float, 4>, kRegisterCount> registers;
  std::array<float, 4> color;
};
[[nodiscard]] FloatOutcome run_float(const CombinerState& state, const HardwareProfile& profile,
                                     const Registers& initial);

// The codes that the registers and the colour leave as, by the profile's arithmetic (exact or float32).
[[nodiscard]] Outcome run_real(const CombinerState& state, const HardwareProfile& profile, const Registers& initial);

}  // namespace ninebit::oracle

// Makes the three ways of a trace's values, and computes with the numbers that evaluate_real reports.
#pragma once

#include <cmath>

#include "ninebit/combiner/trace.h"

namespace ninebit {

class TraceValues {
 public:
  explicit TraceValues(const Datapath& d) : arithmetic_(d.arithmetic), one_(d.one) {}

  [[nodiscard]] bool integer() const { return arithmetic_ == Arithmetic::integer; }

  // A code that is known with any arithmetic. `real` is used if the arithmetic is not integer.
  [[nodiscard]] TracedCode known_code(int code, double real, double ideal) const {
    return {code, integer() ? code / one_ : real, ideal};
  }
  // `code` is used if the arithmetic is integer, `real` if not.
  [[nodiscard]] TracedCode code(int code, double real, double ideal) const {
    return known_code(integer() ? code : static_cast<int>(nearest(real * one_)), real, ideal);
  }
  // The same for a wide value, given in halves of its unit.
  [[nodiscard]] TracedWide halves(int twice, double real, double ideal) const {
    if (!integer()) return {nearest(real * one_ * one_), real, ideal};
    return {twice / 2.0, twice / (2.0 * one_ * one_), ideal};
  }
  [[nodiscard]] TracedWide wide(int units, double real, double ideal) const { return halves(2 * units, real, ideal); }

  // The number of a code if the arithmetic is not integer.
  [[nodiscard]] double real_of_code(int code) const {
    return float32() ? static_cast<double>(static_cast<float>(code) / static_cast<float>(one_)) : code / one_;
  }
  [[nodiscard]] double ideal_of_code(int code) const { return code / one_; }

  // Compute in the arithmetic of the `real` numbers: rounded to floats if these are floats.
  [[nodiscard]] double add(double x, double y) const { return rounded(x + y); }
  [[nodiscard]] double sub(double x, double y) const { return rounded(x - y); }
  [[nodiscard]] double mul(double x, double y) const { return rounded(x * y); }

 private:
  [[nodiscard]] bool float32() const { return arithmetic_ == Arithmetic::float32; }
  // A sum or product of two floats, computed in double and then rounded, equals the float result.
  [[nodiscard]] double rounded(double x) const { return float32() ? static_cast<double>(static_cast<float>(x)) : x; }
  static double nearest(double x) { return std::floor(x + 0.5); }

  Arithmetic arithmetic_;
  double one_;
};

// Traces the final combiner. `before` are the registers after the general combiners.
[[nodiscard]] TracedFinal trace_final(const Program& program, const TracedRegisters& before, const RealEvaluation& real,
                                      const RealEvaluation& ideal);

}  // namespace ninebit

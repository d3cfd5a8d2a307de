// How a trace says one value three ways, and the operations between the numbers that evaluate_real reports.
#pragma once

#include <cmath>

#include "ninebit/combiner/trace.h"

namespace ninebit {

class TraceValues {
 public:
  explicit TraceValues(const Datapath& d) : arithmetic_(d.arithmetic), one_(d.one) {}

  [[nodiscard]] bool integer() const { return arithmetic_ == Arithmetic::integer; }

  // A code that is known whatever the arithmetic; `real` counts where that is not integer.
  [[nodiscard]] TracedCode known_code(int code, double real, double ideal) const {
    return {code, integer() ? code / one_ : real, ideal};
  }
  // `code` counts where the arithmetic is integer, `real` where it is not.
  [[nodiscard]] TracedCode code(int code, double real, double ideal) const {
    return known_code(integer() ? code : static_cast<int>(nearest(real * one_)), real, ideal);
  }
  // The same for a wide value, given in halves of its unit.
  [[nodiscard]] TracedWide halves(int twice, double real, double ideal) const {
    if (!integer()) return {nearest(real * one_ * one_), real, ideal};
    return {twice / 2.0, twice / (2.0 * one_ * one_), ideal};
  }
  [[nodiscard]] TracedWide wide(int units, double real, double ideal) const { return halves(2 * units, real, ideal); }

  // The number that a code is where the arithmetic is not integer.
  [[nodiscard]] double real_of_code(int code) const {
    return float32() ? static_cast<double>(static_cast<float>(code) / static_cast<float>(one_)) : code / one_;
  }
  [[nodiscard]] double ideal_of_code(int code) const { return code / one_; }

  // In the arithmetic of the `real` numbers: to floats where that is what they are.
  [[nodiscard]] double add(double x, double y) const { return rounded(x + y); }
  [[nodiscard]] double sub(double x, double y) const { return rounded(x - y); }
  [[nodiscard]] double mul(double x, double y) const { return rounded(x * y); }

 private:
  [[nodiscard]] bool float32() const { return arithmetic_ == Arithmetic::float32; }
  // A sum or product of two floats, made in doubles and then rounded, is the one that floats give.
  [[nodiscard]] double rounded(double x) const { return float32() ? static_cast<double>(static_cast<float>(x)) : x; }
  static double nearest(double x) { return std::floor(x + 0.5); }

  Arithmetic arithmetic_;
  double one_;
};

// The final combiner of a trace. `before` are the registers that the general combiners left.
[[nodiscard]] TracedFinal trace_final(const Program& program, const TracedRegisters& before, const RealEvaluation& real,
                                      const RealEvaluation& ideal);

}  // namespace ninebit

// One fragment in real numbers: the equations of NV_register_combiners step by step, without narrowing.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Red, green, blue, alpha as real numbers; 1.0 is full intensity.
using RealColor = std::array<double, 4>;

// Every register's components as real numbers.
struct RealRegisters {
  std::array<RealColor, kRegisterCount> value{};  // by Register
  RealColor& operator[](Register r) {
    return value[static_cast<std::size_t>(r)];
  }  // r: one of the first kRegisterCount
  const RealColor& operator[](Register r) const { return value[static_cast<std::size_t>(r)]; }  // likewise
};

// One of the three outputs of a portion, in one channel.
struct RealOutput {
  double wide = 0;     // AB, CD: the product or dot product; third: the sum or the mux's choice
  double scaled = 0;   // (wide + bias) · scale; 0 for an output that is discarded
  double written = 0;  // `scaled` clamped to [-1, 1]; 0 for an output that is discarded
};

// A portion in one channel.
struct RealChannel {
  std::array<double, 4> input{};  // A to D, fetched and mapped
  RealOutput ab, cd, third;       // third.wide is 0 if the third output is discarded
};

// A general combiner: its products, its outputs, and the registers after it.
struct RealStage {
  bool takes_cd = false;             // whether a mux takes CD: spare0's alpha, as it enters the stage, is at least 1/2
                                     // or, by the lowest bit, its nearest code is odd
  std::array<RealChannel, 3> rgb{};  // all 0 if the RGB portion writes nothing
  RealChannel alpha{};               // likewise
  RealRegisters after;               // the registers with the stage's outputs
  RegisterFile codes;                // the nearest codes of these, chosen as in RealEvaluation::codes
};

// The final combiner: its mapped inputs and its results.
struct RealFinal {
  std::array<RealColor, 6> input{};  // A to F, mapped; no alpha
  double g = 0;                      // mapped
  RealColor e_times_f{};             // no alpha
  RealColor color_sum{};             // spare0 + secondary, inverted and clamped as the program says; no alpha
  RealColor unclamped{};             // A·B + (1 - A)·C + D, and G
};

// A fragment's way through a program, in real numbers.
struct RealEvaluation {
  RealRegisters before;          // the numbers of the codes; zero and the constants are not read and stay
  std::vector<RealStage> stage;  // one for each general combiner
  RealFinal final_combiner;      // the final combiner's values
  RealColor color{};             // clamped to [0, 1]

  // The nearest codes, halves up. They are rounded from the exact real numbers, not from the doubles reported here.
  EvaluatedFragment codes;

  // The registers after the last general combiner.
  [[nodiscard]] const RealRegisters& registers() const { return stage.empty() ? before : stage.back().after; }
};

// Runs a program over one fragment in real numbers, whatever the program's arithmetic. Registers and constants
// start as code / program.datapath.one.
//
// `exact`: all numbers are exact, and so are the mux's choices. Only the doubles above are rounded, each to nearest.
// `float32`: 32-bit floats. Each operation is rounded, in the order in which the equations are written: dot products
// (r + g) + b, outputs (wide - 1/2) · scale, the final combiner (A·B + (1 - A)·C) + D. `integer` counts as exact.
//
// To compare with an integer trace, pass that trace's program and registers, and Arithmetic::exact.
[[nodiscard]] RealEvaluation evaluate_real(const Program& program, const RegisterFile& initial,
                                           Arithmetic arithmetic = Arithmetic::exact);

}  // namespace ninebit
